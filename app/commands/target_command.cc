#include "app/commands/target_command.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/options/located_error.h"
#include "base/atomic_file.h"
#include "base/units.h"
#include "devices/images/image_file.h"
#include "export/images/image_writer.h"
#include "tracker/picture_target/target_file.h"
#include "tracker/picture_target/target_making.h"
#include "tracker/picture_target/target_quality.h"
#include "tracker/picture_target/target_views.h"

namespace pleinair::app {
namespace {

constexpr const char* kTargetExamples =
    "Examples:\n"
    "  pleinair target poster.jpg --width-mm 420 -o poster.target\n"
    "  pleinair target poster.jpg --width-mm 420 -o poster.target --preview features.png --json\n"
    "  pleinair detect photo.jpg --calibration camera.yaml --target poster.target\n"
    "The width is that of the printed picture, without the paper's margin. Crop the picture to\n"
    "what is printed; it must lie flat. docs/guide/picture-targets.md explains which pictures are "
    "good.\n";

const char* RatingWord(int score) { return score >= 60 ? "good" : score >= 30 ? "fair" : "poor"; }

std::string DescribeTarget(const tracker::PictureTarget& target,
                           const tracker::TargetQuality& quality,
                           const TargetArguments& arguments) {
  if (arguments.json) {
    nlohmann::ordered_json object{{"file", arguments.output},
                                  {"name", target.name},
                                  {"width_mm", target.width_m * 1e3},
                                  {"height_mm", target.height_m * 1e3},
                                  {"score", quality.score},
                                  {"rating", RatingWord(quality.score)},
                                  {"features", quality.features},
                                  {"coverage", quality.coverage},
                                  {"contrast", quality.contrast},
                                  {"repetition", quality.repetition},
                                  {"turned_likeness", quality.turned_likeness},
                                  {"advice", quality.advice}};
    return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  }
  std::string text = fmt::format(
      "{}: \"{}\", {:.1f} x {:.1f} mm, {} of 100 ({})\n"
      "  {} features over {:.0f} % of the picture, {:.0f} % of them repeat; contrast in {:.0f} %\n",
      arguments.output, target.name, target.width_m * 1e3, target.height_m * 1e3, quality.score,
      RatingWord(quality.score), quality.features, 100.0 * quality.coverage,
      100.0 * quality.repetition, 100.0 * quality.contrast);
  for (const std::string& advice : quality.advice) text += "  " + advice + "\n";
  return text;
}

void Paint(int x, int y, RgbImage* picture) {
  if (x < 0 || y < 0 || x >= picture->width() || y >= picture->height()) return;
  constexpr std::uint8_t kGreen[3] = {0, 230, 60};
  for (int channel = 0; channel < 3; ++channel) (*picture)(x, y, channel) = kGreen[channel];
}

}  // namespace

RgbImage DrawTargetFeatures(const tracker::PictureTarget& target) {
  const int width = target.picture.width(), height = target.picture.height();
  RgbImage picture(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        picture(x, y, channel) = target.picture(x, y);
      }
    }
  }
  const double view_px = tracker::kTargetSide * target.views[tracker::kFrontalView].from_target[0];
  const double per_view = width / view_px;  // Image pixels per pixel of the view.
  for (const tracker::TargetKeypoint& keypoint : target.keypoints) {
    if (keypoint.view != tracker::kFrontalView) continue;
    const Vec2 place = tracker::PlaceOnTarget(target, keypoint);
    const double x = place.x / tracker::kTargetSide * width - 0.5;
    const double y = place.y / tracker::kTargetSide * height - 0.5;
    // A keypoint's blob has a radius of about twice its scale.
    const double radius = std::max(2.0, 2.0 * keypoint.scale * per_view);
    const int steps = static_cast<int>(8.0 * radius) + 8;
    for (int step = 0; step < steps; ++step) {
      const double angle = 2.0 * std::numbers::pi * step / steps;
      Paint(static_cast<int>(std::lround(x + radius * std::cos(angle))),
            static_cast<int>(std::lround(y + radius * std::sin(angle))), &picture);
    }
  }
  return picture;
}

Result<void> RunTarget(const TargetArguments& arguments, std::ostream& out) {
  if (!(arguments.width_mm > 0.0) || !std::isfinite(arguments.width_mm)) {
    return InputError("--width-mm", "the width must be positive",
                      "give the width of the printed picture in millimetres");
  }
  if (arguments.output.empty()) {
    return InputError("--output", "the name is empty", "name a file, for example poster.target");
  }
  const std::string name =
      arguments.name ? *arguments.name : std::filesystem::path(arguments.picture).stem().string();
  if (!tracker::IsTargetName(name)) {
    return InputError("--name", "the name is empty, too long or no plain UTF-8",
                      fmt::format("give one of 1 to {} bytes", tracker::kMaxTargetName));
  }
  // Checked first: a typing error must not cost the seconds of creating a target.
  for (const std::filesystem::path& file :
       {std::filesystem::path(arguments.output),
        std::filesystem::path(arguments.preview.value_or(""))}) {
    std::error_code ignored;
    if (file.has_parent_path() && !std::filesystem::is_directory(file.parent_path(), ignored)) {
      return tl::make_unexpected(WriteError(file, ENOENT));
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(const devices::DecodedImage decoded,
                            devices::DecodeImageFile(arguments.picture));
  auto target =
      tracker::MakePictureTarget(decoded.grey.view(), Metres(arguments.width_mm * 1e-3), name);
  if (!target) return LocatedError(std::move(target).error(), arguments.picture);
  const tracker::TargetQuality quality = tracker::RateTarget(*target);
  // Steps that can fail come first: either both files are new in the end, or neither is.
  const std::filesystem::path preview(arguments.preview.value_or(""));
  const std::filesystem::path temporary = TemporarySibling(preview);
  if (arguments.preview) {
    auto drawn = exports::WritePng(temporary, DrawTargetFeatures(*target).view());
    if (!drawn) {
      Error error = std::move(drawn).error();
      error.where = preview.string();
      return tl::make_unexpected(std::move(error));
    }
  }
  auto written = tracker::WriteTargetFile(*target, arguments.output);
  if (arguments.preview && written) written = CommitFile(temporary, preview);
  if (!written) {
    std::error_code ignored;
    if (arguments.preview) std::filesystem::remove(temporary, ignored);
    return written;
  }
  out << DescribeTarget(*target, quality, arguments);
  return {};
}

void AddTargetCommand(CLI::App& app, CommandResult& result) {
  auto arguments = std::make_shared<TargetArguments>();
  CLI::App* command =
      app.add_subcommand("target", "Make a target of a picture, to be found by its texture");
  command->footer(kTargetExamples);
  command->add_option("PICTURE", arguments->picture, "PNG or JPEG, cropped to what is printed")
      ->required();
  command->add_option("--width-mm", arguments->width_mm, "Width of the printed picture")
      ->type_name("MM")
      ->required();
  command->add_option("-o,--output", arguments->output, "Target file to write")
      ->type_name("F")
      ->required();
  command
      ->add_option("--name", arguments->name,
                   "Name in the detections (default: the picture's file name without its ending)")
      ->type_name("NAME");
  command->add_option("--preview", arguments->preview, "PNG to write that shows the features found")
      ->type_name("F.png");
  command->add_flag("--json", arguments->json, "One JSON object on standard output");
  command->callback([arguments, &result] { result.status = RunTarget(*arguments, std::cout); });
}

}  // namespace pleinair::app
