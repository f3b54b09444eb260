#include "export/trajectories/record3d_trajectory.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "export/trajectories/frames_of_others.h"

namespace pleinair::exports {
namespace {

using Json = nlohmann::json;

constexpr const char* kWholeCopy = "get a whole copy of the file";

/// The finite numbers of an array; nothing for anything else. The parser refuses NaN and infinity,
/// but 1e999 is an infinite number for it.
std::optional<std::vector<double>> FiniteNumbers(const Json& array) {
  if (!array.is_array()) return std::nullopt;
  std::vector<double> numbers;
  numbers.reserve(array.size());
  for (const Json& entry : array) {
    if (!entry.is_number() || !std::isfinite(entry.get<double>())) return std::nullopt;
    numbers.push_back(entry.get<double>());
  }
  return numbers;
}

std::optional<double> FiniteNumber(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  const double number = found->get<double>();
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

/// The times of the poses in seconds.
Result<std::vector<double>> TimesOf(const Json& metadata, std::size_t poses,
                                    const std::string& name) {
  constexpr double kMaxTime_s = 9e9, kMaxRate_hz = 1e6;
  if (const auto stamps = metadata.find("frameTimestamps"); stamps != metadata.end()) {
    auto times = FiniteNumbers(*stamps);
    if (!times || times->size() != poses) {
      return InputError(name, "has frameTimestamps that are not one number per pose", kWholeCopy);
    }
    for (const double time_s : *times) {
      if (!(std::abs(time_s) <= kMaxTime_s)) {
        return InputError(name, "has a time stamp of more than 9e9 seconds", kWholeCopy);
      }
    }
    return *std::move(times);
  }
  const std::optional<double> rate_hz = FiniteNumber(metadata, "fps");
  if (!rate_hz || !(*rate_hz > 1e-3 && *rate_hz <= kMaxRate_hz)) {
    return InputError(name, "has neither frameTimestamps nor fps", kWholeCopy);
  }
  std::vector<double> times;
  times.reserve(poses);
  for (std::size_t i = 0; i < poses; ++i) times.push_back(static_cast<double>(i) / *rate_hz);
  return times;
}

/// Nothing unless the file has a whole lens.
std::optional<CameraModel> LensOf(const Json& metadata) {
  const auto matrix = metadata.contains("K") ? FiniteNumbers(metadata["K"]) : std::nullopt;
  const std::optional<double> width = FiniteNumber(metadata, "w");
  const std::optional<double> height = FiniteNumber(metadata, "h");
  constexpr double kMaxSize_px = 1e5;
  if (!matrix || matrix->size() != 9 || !width || !height || !(*width >= 1.0) ||
      !(*height >= 1.0) || *width > kMaxSize_px || *height > kMaxSize_px) {
    return std::nullopt;
  }
  CameraModel camera;
  camera.width = static_cast<int>(*width);
  camera.height = static_cast<int>(*height);
  camera.fx = (*matrix)[0];
  camera.fy = (*matrix)[4];
  camera.cx = (*matrix)[6] - 0.5;
  camera.cy = (*matrix)[7] - 0.5;
  if (!(camera.fx > 0.0 && camera.fy > 0.0)) return std::nullopt;
  return camera;
}

}  // namespace

Result<CameraTrajectory> ParseRecord3dMetadata(std::string_view text, const std::string& name) {
  const Json metadata = Json::parse(text, nullptr, false);
  if (!metadata.is_object()) {
    return InputError(name, "is not a JSON object, as the metadata of Record3D is",
                      "name the .r3d archive that the app shares, or a whole copy of its metadata");
  }
  const auto poses = metadata.find("poses");
  if (poses == metadata.end() || !poses->is_array() || poses->empty()) {
    return InputError(name, "holds no poses", "record with the camera's trajectory");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<double> times,
                            TimesOf(metadata, poses->size(), name));
  CameraTrajectory path;
  path.camera = LensOf(metadata);
  path.poses.reserve(poses->size());
  for (std::size_t i = 0; i < poses->size(); ++i) {
    const std::string where = fmt::format("{}: pose {}", name, i);
    const auto n = FiniteNumbers((*poses)[i]);
    if (!n || n->size() != 7) {
      return InputError(where, "is not seven numbers qx qy qz qw tx ty tz", kWholeCopy);
    }
    const Quaternion turn{.x = (*n)[0], .y = (*n)[1], .z = (*n)[2], .w = (*n)[3]};
    PLEINAIR_ASSIGN_OR_RETURN(
        const auto reference_from_gl,
        (PoseFromFile<Reference, GlCamera>(where, {(*n)[4], (*n)[5], (*n)[6]}, turn)));
    TrajectoryPose pose;
    pose.timestamp_ns = std::llround(times[i] * 1e9);
    pose.frame = static_cast<std::int64_t>(i);
    pose.reference_from_camera = reference_from_gl * kCameraFromGlCamera.Inverse();
    PLEINAIR_RETURN_IF_ERROR(AddPose(where, std::move(pose), &path));
  }
  return path;
}

}  // namespace pleinair::exports
