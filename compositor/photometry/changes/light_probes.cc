#include "compositor/photometry/changes/light_probes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/parallel_for.h"
#include "compositor/light/sampling.h"
#include "compositor/light/scaled_sky.h"
#include "compositor/photometry/linear_sampling.h"

namespace pleinair::compositor {
namespace {

constexpr std::uint32_t kPaths = 256;  // Per probe and source of light.
// Probes per frame, and at most in a recording: their noise is far below that of the model.
constexpr double kProbesPerFrame = 450.0;
constexpr std::size_t kMaxProbes = 4000;
// Pixel values beyond which a value is clipped or mostly noise.
constexpr int kClippedCode = 250, kDarkCode = 5;
// Half the edge of the square over which a probe averages, pixels.
constexpr double kReach_px = 1.0, kReachInBand_px = 0.25;  // The black band is narrow.
// Cosine between line of sight and normal below which a footprint is too long.
constexpr double kGrazing = 0.1;
// Width of the marker's black band below which the white around it brightens its middle.
constexpr double kMinBand_px = 4.5;
constexpr double kMargin_m = 0.02;  // Around the marker's white margin.
constexpr int kMarkerProbesPerSide = 8;
// Steps per unit of a normal's coordinates. Probes with one rounded normal are lit together.
constexpr double kNormalSteps = 8.0;

}  // namespace

LightProbes::LightProbes(const PhantomRays& phantoms, const CameraModel& camera,
                         const CameraResponse& response, std::size_t max_readings)
    : phantoms_(phantoms), camera_(camera), response_(response), max_readings_(max_readings) {}

void LightProbes::AddMarker(const scene::MarkerReflectance& marker) {
  // The middle of the white margin, or of the quiet zone, and that of the black band.
  const double half = marker.size_m / 2;
  const double margin_m = (marker.board_size_m - marker.size_m) / 2;
  const double outwards = (margin_m > 0.0 ? margin_m : marker.black_band_m) / 2;
  const LinearRgb white = LinearRgb{1, 1, 1} * marker.albedo_white;
  const LinearRgb black = LinearRgb{1, 1, 1} * marker.albedo_black;
  for (int side = 0; side < 4; ++side) {
    const double c = std::array{1.0, 0.0, -1.0, 0.0}[side];
    const double s = std::array{0.0, 1.0, 0.0, -1.0}[side];
    for (int i = 0; i < kMarkerProbesPerSide; ++i) {
      const double x = half * (2.0 * (i + 0.5) / kMarkerProbesPerSide - 1.0);
      const auto add = [&](double along, double y, int surface, LinearRgb albedo, double width_m) {
        probes_.push_back({{{c * along - s * y, s * along + c * y, 0.0}},
                           {0.0, 0.0, 1.0},
                           surface,
                           albedo,
                           width_m});
      };
      add(x, half + outwards, kMarkerWhite, white, 0.0);
      if (marker.black_band_m <= 0.0) continue;
      const double inside = half - marker.black_band_m / 2;
      add(x * inside / half, inside, kMarkerBlack, black, marker.black_band_m);
    }
  }
}

bool LightProbes::Observe(CameraImageView image, const Transform<Camera, Marker>& pose,
                          std::uint32_t probe, Vec2* pixel, ProbedFrame* frame) const {
  const Point<Marker>& point = probes_[probe].point;
  const Vec3 normal = probes_[probe].normal;
  const Point<Camera> in_camera = pose * point;
  const Vec3 eye = pose.Inverse().translation_m;
  const Vec3 to_eye = eye - point.xyz;
  const double distance = Norm(to_eye);
  if (in_camera.xyz.z <= 0.0 || Dot(normal, to_eye) < kGrazing * distance) return false;
  *pixel = ProjectToPixel(camera_, in_camera);
  const double footprint_m = distance / std::max(1.0, std::min(camera_.fx, camera_.fy));
  const double width_m = probes_[probe].width_m;
  const double seen_m = width_m * Dot(normal, to_eye) / distance;
  const bool blurred = width_m > 0.0 && seen_m < kMinBand_px * footprint_m;
  if (blurred || !Keeps(probe, frames_.size())) {
    return pixel->x >= 0.0 && pixel->y >= 0.0 && pixel->x < image.width() &&
           pixel->y < image.height();
  }
  std::array<double, 3> sum{};
  for (int i = 0; i < 4; ++i) {
    const double reach_px = width_m > 0.0 ? kReachInBand_px : kReach_px;
    const Vec2 aside{(i & 1) == 0 ? -reach_px : reach_px, (i & 2) == 0 ? -reach_px : reach_px};
    const auto linear = SampleLinear(image, *pixel + aside, response_);
    if (!linear) return false;
    for (int c = 0; c < 3; ++c) {
      const auto& light = response_.Linear(c);
      if ((*linear)[c] >= light[kClippedCode] || (*linear)[c] <= light[kDarkCode]) return true;
      sum[c] += (*linear)[c] / 4;
    }
  }
  const auto seen = phantoms_.First({eye}, to_eye * (-1.0 / distance));
  if (seen && Norm(seen->point.xyz - eye) < distance - 3 * footprint_m - 0.01) return true;
  frame->probes.push_back(probe);
  frame->linear.push_back(
      {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])});
  return true;
}

void LightProbes::AddFrame(CameraImageView image, const Transform<Camera, Marker>& pose,
                           const scene::MarkerReflectance& marker, std::int64_t frame_index,
                           std::int64_t timestamp_ns) {
  ProbedFrame frame{frame_index, timestamp_ns, {}, {}};
  if (probes_.empty() && marker.size_m > 0.0) AddMarker(marker);
  const int step = std::max(2, static_cast<int>(std::sqrt(static_cast<double>(image.width()) *
                                                          image.height() / kProbesPerFrame)));
  const int columns = image.width() / step, rows = image.height() / step;
  std::vector<std::uint8_t> taken(static_cast<std::size_t>(columns) * rows);
  for (std::uint32_t probe = 0; probe < probes_.size(); ++probe) {
    Vec2 pixel;
    if (!Observe(image, pose, probe, &pixel, &frame)) continue;
    const int x = static_cast<int>(pixel.x) / step, y = static_cast<int>(pixel.y) / step;
    if (x < columns && y < rows) taken[static_cast<std::size_t>(y) * columns + x] = 1;
  }
  const auto marker_from_camera = pose.Inverse();
  const Point<Marker> eye{marker_from_camera.translation_m};
  const double half = marker.board_size_m / 2 + kMargin_m;
  for (std::size_t cell = 0; cell < taken.size() && probes_.size() < kMaxProbes; ++cell) {
    if (taken[cell] != 0) continue;
    const auto column = static_cast<int>(cell) % columns, row = static_cast<int>(cell) / columns;
    const Vec2 ray = UndistortPixel(camera_, {column * step + step / 2.0, row * step + step / 2.0});
    const auto seen =
        phantoms_.First(eye, Normalized(marker_from_camera.rotation * Vec3{ray.x, ray.y, 1.0}));
    if (!seen || seen->is_foliage) continue;
    const Vec3 p = seen->point.xyz;
    if (std::max({std::fabs(p.x), std::fabs(p.y), 4 * std::fabs(p.z)}) < half) continue;
    probes_.push_back(
        {seen->point, seen->normal, seen->surface, seen->albedo, 0.0,
         Norm(seen->point.xyz - eye.xyz) / std::max(1.0, std::min(camera_.fx, camera_.fy))});
    Vec2 pixel;
    Observe(image, pose, static_cast<std::uint32_t>(probes_.size() - 1), &pixel, &frame);
  }
  readings_ += frame.probes.size();
  frames_.push_back(std::move(frame));
  if (readings_ > max_readings_) ThinOut();
}

ProbedFrame LightProbes::TakeFrame() {
  ProbedFrame frame = std::move(frames_.back());
  frames_.pop_back();
  readings_ -= frame.probes.size();
  return frame;
}

void LightProbes::SetResponse(const CameraResponse& response) {
  const auto decoded = [&](double code, int c) {
    const auto& linear = response.Linear(c);
    const double at = std::clamp(code, 0.0, 1.0) * 255.0;
    const int below = std::min(static_cast<int>(at), 254);
    return linear[below] + (at - below) * (linear[below + 1] - linear[below]);
  };
  for (ProbedFrame& frame : frames_) {
    for (auto& linear : frame.linear) {
      for (int c = 0; c < 3; ++c) {
        linear[c] = static_cast<float>(decoded(response_.Encoded(linear[c], c), c));
      }
    }
  }
  response_ = response;
}

bool LightProbes::Keeps(std::uint32_t probe, std::size_t frame) const {
  // The marker has few.
  if (probes_[probe].surface < 0) return true;
  return Hash(probe, static_cast<std::uint32_t>(frame)) % thinning_ == 0;
}

void LightProbes::ThinOut() {
  thinning_ *= 2;
  readings_ = 0;
  for (std::size_t t = 0; t < frames_.size(); ++t) {
    ProbedFrame& frame = frames_[t];
    std::size_t kept = 0;
    for (std::size_t k = 0; k < frame.probes.size(); ++k) {
      if (!Keeps(frame.probes[k], t)) continue;
      frame.probes[kept] = frame.probes[k];
      frame.linear[kept++] = frame.linear[k];
    }
    frame.probes.resize(kept);
    frame.linear.resize(kept);
    frame.probes.shrink_to_fit();
    frame.linear.shrink_to_fit();
    readings_ += kept;
  }
}

std::vector<ProbeLight> LightOn(std::span<const LightProbe> probes, const PhantomRays& phantoms,
                                const sky::SkyModel& day, const Mat3& marker_from_world) {
  std::vector<ProbeLight> lights(probes.size());
  const Vec3 to_sun = Normalized(marker_from_world * day.ToSun().xyz);
  const LinearRgb sun = day.SunNormalIrradiance();
  ParallelFor(probes.size(), 0, [&](std::size_t i) {
    lights[i].direct = sun * std::max(0.0, Dot(probes[i].normal, to_sun));
    if (lights[i].direct.g <= 0.0) return;
    lights[i].sun_visibility = phantoms.SunVisibility(probes[i].point, to_sun);
  });
  std::map<std::array<int, 3>, std::vector<std::size_t>> by_normal;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const auto step = [](double value) {
      return static_cast<int>(std::lround(value * kNormalSteps));
    };
    const Vec3 n = probes[i].normal;
    by_normal[{step(n.x), step(n.y), step(n.z)}].push_back(i);
  }
  const ScaledSky sky_alone(day, {1, 1, 1}, {}), sun_alone(day, {}, {1, 1, 1});
  for (const auto& [key, members] : by_normal) {
    std::vector<Point<Marker>> points;
    Vec3 normal;
    for (const std::size_t i : members) {
      points.push_back(probes[i].point);
      normal = normal + probes[i].normal;
    }
    normal = Normalized(normal);
    const auto sky = phantoms.Ambient(points, normal, sky_alone, marker_from_world, kPaths);
    const auto reflected = phantoms.Ambient(points, normal, sun_alone, marker_from_world, kPaths);
    for (std::size_t k = 0; k < members.size(); ++k) {
      lights[members[k]].sky = sky[k];
      lights[members[k]].reflected = reflected[k];
    }
  }
  return lights;
}

}  // namespace pleinair::compositor
