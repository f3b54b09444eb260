#include "app/paths/colmap_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/pixel_origin.h"

namespace pleinair::app {
namespace {

constexpr int kLargestSide = 100000;

/// Where a model's parameters go: one or two focal lengths, cx, cy, then distortion coefficients,
/// each to its place in CameraModel::distortion.
struct ColmapModel {
  const char* name;
  int focal_lengths;
  DistortionModel distortion_model;
  std::vector<std::size_t> places;
};

const std::array<ColmapModel, 9>& Models() {
  using enum DistortionModel;
  static const std::array<ColmapModel, 9> kModels{{
      {"SIMPLE_PINHOLE", 1, kBrownConrady, {}},
      {"PINHOLE", 2, kBrownConrady, {}},
      {"SIMPLE_RADIAL", 1, kBrownConrady, {0}},
      {"RADIAL", 1, kBrownConrady, {0, 1}},
      {"OPENCV", 2, kBrownConrady, {0, 1, 2, 3}},
      {"FULL_OPENCV", 2, kBrownConrady, {0, 1, 2, 3, 4, 5, 6, 7}},
      {"SIMPLE_RADIAL_FISHEYE", 1, kEquidistant, {0}},
      {"RADIAL_FISHEYE", 1, kEquidistant, {0, 1}},
      {"OPENCV_FISHEYE", 2, kEquidistant, {0, 1, 2, 3}},
  }};
  return kModels;
}

const ColmapModel* ModelOf(const std::string& name) {
  const auto& models = Models();
  const auto found = std::find_if(models.begin(), models.end(),
                                  [&](const ColmapModel& model) { return name == model.name; });
  return found == models.end() ? nullptr : &*found;
}

}  // namespace

Result<CameraModel> CameraFromColmap(const ColmapCamera& camera, const std::string& where) {
  const ColmapModel* model = ModelOf(camera.model);
  if (model == nullptr) {
    std::string known;
    for (const ColmapModel& other : Models()) known += std::string(" ") + other.name;
    return InputError(
        where,
        "has the camera model \"" + camera.model.substr(0, 40) + "\", which cannot be told in ours",
        "reconstruct with one of" + known);
  }
  const std::size_t count = model->focal_lengths + 2 + model->places.size();
  if (camera.parameters.size() != count) {
    return InputError(where,
                      fmt::format("has {} parameters where {} has {}", camera.parameters.size(),
                                  camera.model, count),
                      "mend the line, or get a whole copy of the file");
  }
  if (camera.width < 1 || camera.height < 1 || camera.width > kLargestSide ||
      camera.height > kLargestSide) {
    return InputError(where, fmt::format("has a picture of {}x{}", camera.width, camera.height),
                      "sides are 1 to 100000 pixels");
  }
  const double* next = camera.parameters.data();
  CameraModel ours;
  ours.width = camera.width;
  ours.height = camera.height;
  ours.fx = *next++;
  ours.fy = model->focal_lengths == 2 ? *next++ : ours.fx;
  if (!(ours.fx > 0.0) || !(ours.fy > 0.0)) {
    return InputError(where, "has a focal length that is not greater than zero", "mend the line");
  }
  const Vec2 centre = PixelFromCornerOrigin({next[0], next[1]});
  ours.cx = centre.x;
  ours.cy = centre.y;
  next += 2;
  ours.distortion_model = model->distortion_model;
  for (const std::size_t place : model->places) ours.distortion[place] = *next++;
  return ours;
}

ColmapCamera ColmapFromCamera(const CameraModel& camera) {
  const auto& k = camera.distortion;
  const auto is_zero_from = [&](std::size_t first) {
    return std::all_of(k.begin() + static_cast<std::ptrdiff_t>(first), k.end(),
                       [](double value) { return value == 0.0; });
  };
  const char* name = "FULL_OPENCV";
  if (camera.distortion_model == DistortionModel::kEquidistant) {
    name = "OPENCV_FISHEYE";
  } else if (is_zero_from(0)) {
    name = "PINHOLE";
  } else if (is_zero_from(4)) {
    name = "OPENCV";
  }
  const Vec2 centre = CornerOriginFromPixel({camera.cx, camera.cy});
  ColmapCamera theirs{
      name, camera.width, camera.height, {camera.fx, camera.fy, centre.x, centre.y}};
  for (const std::size_t place : ModelOf(name)->places) theirs.parameters.push_back(k[place]);
  return theirs;
}

}  // namespace pleinair::app
