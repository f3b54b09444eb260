#include "app/commands/doctor_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

extern "C" {
#include <libavcodec/avcodec.h>
}

#include "app/commands/command.h"
#include "base/units.h"
#include "compositor/passes/render_targets.h"
#include "devices/calibration/calibration.h"
#include "gl/egl_context.h"

namespace pleinair::app {
namespace {

using Verdict = Finding::Verdict;

constexpr const char* kDoctorExamples =
    "Examples:\n"
    "  pleinair doctor\n"
    "      whether this machine can draw, and with what\n"
    "  pleinair doctor --calibration camera.yaml\n"
    "      whether the numbers of a calibration make sense, too\n"
    "Exit code 1 when something that replay needs is missing.\n";

struct DoctorOptions {
  std::string calibration;
  bool json = false;
};

template <typename... Values>
std::string Format(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

const char* VerdictWord(Verdict verdict) {
  switch (verdict) {
    case Verdict::kGood:
      return "good";
    case Verdict::kDoubtful:
      return "doubtful";
    case Verdict::kBad:
      return "bad";
  }
  return "";
}

std::vector<Finding> ExamineOpenGl() {
  const Result<gl::EglContext> context = gl::EglContext::Create();
  if (!context) {
    return {{Verdict::kBad, "OpenGL", context.error().what + "; " + context.error().remedy}};
  }
  const gl::EglContextInfo& info = context->info();
  return {
      {Verdict::kGood, "OpenGL",
       "4.5 core without a display: " + info.renderer + ", " + info.version + " (" + info.vendor +
           ", EGL platform " + info.platform + (info.software ? ", drawn by the processor)" : ")")},
      ExamineSamples(compositor::RenderTargets::SamplesGiven())};
}

Finding ExamineVideoEncoder() {
  for (const char* name : {"libx264", "libopenh264"}) {
    if (avcodec_find_encoder_by_name(name) != nullptr) {
      return {Verdict::kGood, "video encoder", std::string("H.264 by ") + name};
    }
  }
  return {Verdict::kDoubtful, "video encoder",
          "libavcodec has no H.264 encoder, so replay can write pictures but no "
          "video; install Debian's libavcodec59 with libx264-164, or use --frames --no-video"};
}

Finding ExamineFocalLengths(const CameraModel& camera) {
  const double widths = camera.fx / camera.width;
  const double view_deg = 2.0 * std::atan(0.5 / widths) / kRadiansPerDegree;
  const std::string measured =
      Format("fx %.1f, fy %.1f px: %.1f° across before distortion", camera.fx, camera.fy, view_deg);
  // 0.2 image widths is a 136° lens, 10 widths a 5.7° one.
  if (widths < 0.2 || widths > 10.0) {
    return {Verdict::kDoubtful, "focal length",
            measured + "; unusual: is the picture size the calibration's own?"};
  }
  if (std::abs(camera.fx / camera.fy - 1.0) > 0.05) {
    return {Verdict::kDoubtful, "focal length",
            measured + "; pixels are hardly ever so far from square: calibrate again"};
  }
  return {Verdict::kGood, "focal length", measured};
}

Finding ExaminePrincipalPoint(const CameraModel& camera) {
  const double off_x = (camera.cx - 0.5 * (camera.width - 1)) / camera.width;
  const double off_y = (camera.cy - 0.5 * (camera.height - 1)) / camera.height;
  const std::string measured = Format("%.1f, %.1f px, %.1f %% and %.1f %% from the middle",
                                      camera.cx, camera.cy, 100.0 * off_x, 100.0 * off_y);
  if (std::abs(off_x) > 0.5 || std::abs(off_y) > 0.5) {
    return {Verdict::kBad, "principal point",
            measured + "; outside the picture: is the picture size the calibration's own?"};
  }
  if (std::abs(off_x) > 0.15 || std::abs(off_y) > 0.15) {
    return {Verdict::kDoubtful, "principal point",
            measured + "; far off, as in a cropped picture: calibrate again if it is not one"};
  }
  return {Verdict::kGood, "principal point", measured};
}

// Follows rays from the centre towards the edge midpoints and corners until they leave the image.
// On the way the distorted point must move outwards.
Finding ExamineDistortion(const CameraModel& camera) {
  if (!camera.HasDistortion()) return {Verdict::kGood, "distortion", "none"};
  constexpr int kDirections = 16;
  constexpr double kStep = 0.002;  // In tan(angle).
  constexpr int kSteps = 10'000;
  double largest_px = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kDirections;
    const double dx = std::cos(angle), dy = std::sin(angle);
    double previous = 0.0;
    for (int step = 1; step < kSteps; ++step) {
      const double r = kStep * step;
      double x = 0.0, y = 0.0;
      DistortNormalized(camera, r * dx, r * dy, &x, &y);
      const double outwards = x * dx + y * dy;
      const double u = camera.fx * x + camera.cx;
      const double v = camera.fy * y + camera.cy;
      if (u < -0.5 || v < -0.5 || u > camera.width - 0.5 || v > camera.height - 0.5) break;
      if (!(outwards > previous)) {
        return {Verdict::kBad, "distortion",
                Format("folds back %.0f° from the centre, inside the picture (at pixel %.0f, %.0f):"
                       " two directions share a pixel there; calibrate again with the board in the "
                       "corners too",
                       std::atan(r) / kRadiansPerDegree, u, v)};
      }
      previous = outwards;
      largest_px =
          std::max(largest_px, std::hypot(camera.fx * (x - r * dx), camera.fy * (y - r * dy)));
    }
  }
  return {Verdict::kGood, "distortion",
          Format("grows steadily over the whole picture, %.1f px at most", largest_px)};
}

Result<void> RunDoctor(const DoctorOptions& options) {
  std::vector<Finding> findings = ExamineOpenGl();
  findings.push_back(ExamineVideoEncoder());
  if (!options.calibration.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(const CameraModel camera,
                              devices::ReadCalibration(options.calibration));
    for (Finding& finding : ExamineCalibration(camera)) findings.push_back(std::move(finding));
  }
  std::optional<Finding> first_bad;
  for (const Finding& finding : findings) {
    if (finding.verdict == Verdict::kBad && !first_bad) first_bad = finding;
    if (options.json) {
      std::cout << nlohmann::json{{"subject", finding.subject},
                                  {"verdict", VerdictWord(finding.verdict)},
                                  {"text", finding.text}}
                       .dump()
                << '\n';
    } else {
      std::cout << finding.subject << ": " << VerdictWord(finding.verdict) << ": " << finding.text
                << '\n';
    }
  }
  if (!first_bad) return {};
  // A machine that cannot draw is a system error; a bad calibration is an input error.
  if (first_bad->subject == "OpenGL") return SystemError("doctor", first_bad->text);
  return InputError(options.calibration, first_bad->subject + ": " + first_bad->text);
}

}  // namespace

Finding ExamineSamples(int samples) {
  constexpr int kWanted = compositor::RenderTargets::kWantedSamples;
  if (samples >= kWanted) {
    return {Verdict::kGood, "antialiasing", Format("%d samples a pixel", samples)};
  }
  return {Verdict::kDoubtful, "antialiasing",
          Format("%d of %d samples a pixel, so edges of virtual objects are coarse; another driver "
                 "or LIBGL_ALWAYS_SOFTWARE=1 (slower) gives more",
                 samples, kWanted)};
}

std::vector<Finding> ExamineCalibration(const CameraModel& camera) {
  return {{Verdict::kGood, "picture", Format("%d×%d px", camera.width, camera.height)},
          ExamineFocalLengths(camera),
          ExaminePrincipalPoint(camera),
          ExamineDistortion(camera)};
}

void AddDoctorCommand(CLI::App& app, CommandResult& result) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App* command =
      app.add_subcommand("doctor", "Check whether this machine can draw, and check a calibration");
  command->footer(kDoctorExamples);
  command->add_option("--calibration", options->calibration,
                      "Camera calibration to examine (own JSON, OpenCV YAML, ROS, Kalibr)");
  command->add_flag("--json", options->json, "One JSON object a line");
  command->callback([options, &result] { result.status = RunDoctor(*options); });
}

}  // namespace pleinair::app
