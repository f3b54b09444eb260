#include "export/trajectories/colmap_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

namespace pleinair::exports {
namespace {

/// The number that ends an image's name before its extension.
std::optional<std::int64_t> NumberIn(const std::string& picture) {
  const std::string stem = std::filesystem::path(picture).stem().string();
  const std::size_t last_other = stem.find_last_not_of("0123456789");
  const char* first = stem.data() + (last_other == std::string::npos ? 0 : last_other + 1);
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(first, stem.data() + stem.size(), number);
  constexpr std::int64_t kMax = 1'000'000'000;
  if (error != std::errc() || number > kMax) return std::nullopt;
  return number;
}

/// Errors: the images have several cameras, or a missing one.
Result<CameraModel> CameraOf(const ColmapModel& model) {
  const std::int64_t id = model.pictures.front().camera_id;
  for (const ColmapPicture& picture : model.pictures) {
    if (picture.camera_id != id) {
      return InputError(picture.where, "was taken with another camera than the first image",
                        "leave the images of one camera in the model, or reconstruct with "
                        "--ImageReader.single_camera 1");
    }
  }
  const auto camera = model.cameras.find(id);
  if (camera == model.cameras.end()) {
    return InputError(model.pictures.front().where,
                      fmt::format("was taken with camera {}, which the model has not", id),
                      "get whole copies of its files");
  }
  return camera->second;
}

}  // namespace

Result<CameraTrajectory> TrajectoryFromColmap(ColmapModel model, double frame_rate_hz) {
  if (model.pictures.empty()) {
    return InputError(model.images_file, "holds no images", "get a whole copy of it");
  }
  CameraTrajectory path;
  PLEINAIR_ASSIGN_OR_RETURN(path.camera, CameraOf(model));
  path.points = std::move(model.points);
  struct Numbered {
    std::optional<std::int64_t> number;
    ColmapPicture* picture;
  };
  std::vector<Numbered> pictures;
  pictures.reserve(model.pictures.size());
  for (ColmapPicture& picture : model.pictures) {
    pictures.push_back({NumberIn(picture.name), &picture});
  }
  const bool numbered = std::all_of(pictures.begin(), pictures.end(),
                                    [](const Numbered& entry) { return entry.number; });
  std::stable_sort(pictures.begin(), pictures.end(), [&](const Numbered& a, const Numbered& b) {
    return numbered ? *a.number < *b.number : a.picture->name < b.picture->name;
  });
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    ColmapPicture& picture = *pictures[i].picture;
    // Names are moved only after all comparisons.
    if (i > 0 && (numbered ? pictures[i].number == pictures[i - 1].number
                           : picture.name == pictures[i - 1].picture->name)) {
      return InputError(picture.where,
                        "has the number or name of another image, so their times are ambiguous",
                        "leave one of them in the model");
    }
    TrajectoryPose pose;
    const double index =
        numbered ? static_cast<double>(*pictures[i].number) : static_cast<double>(i);
    constexpr double kMaxTime_s = 9e9;
    if (!(index / frame_rate_hz <= kMaxTime_s)) {
      return InputError(picture.where, "lies centuries after the first image",
                        "give the frame rate that the images were taken with");
    }
    pose.timestamp_ns = std::llround(index / frame_rate_hz * 1e9);
    pose.reference_from_camera = picture.camera_from_reference.Inverse();
    pose.picture = picture.name;
    if (numbered) pose.frame = pictures[i].number;
    PLEINAIR_RETURN_IF_ERROR(AddPose(picture.where, std::move(pose), &path));
  }
  return path;
}

Result<ColmapModel> ColmapFromTrajectory(const CameraTrajectory& path) {
  if (!path.camera) {
    return InputError("",
                      "a COLMAP model needs the camera's calibration, which the trajectory lacks",
                      "give it with --calibration");
  }
  ColmapModel model;
  constexpr std::int64_t kCamera = 1;
  model.cameras.emplace(kCamera, *path.camera);
  model.points = path.points;
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const TrajectoryPose& pose = path.poses[i];
    ColmapPicture picture;
    picture.name = pose.picture.empty() ? fmt::format("frames/{:04}.png", i) : pose.picture;
    picture.camera_id = kCamera;
    picture.camera_from_reference = pose.reference_from_camera.Inverse();
    model.pictures.push_back(std::move(picture));
  }
  return model;
}

}  // namespace pleinair::exports
