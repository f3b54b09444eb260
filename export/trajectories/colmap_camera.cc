#include "export/trajectories/colmap_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/pixel_origin.h"

namespace pleinair::exports {
namespace {

constexpr int kMaxSide = 100000;

/// Destination of a model's parameters: one or two focal lengths, cx, cy, then distortion
/// coefficients with their indices in CameraModel::distortion.
struct Formula {
  const char* name;
  int id;  ///< Id of the name in binary files.
  int focal_lengths;
  DistortionModel distortion_model;
  std::vector<std::size_t> places;
};

const std::array<Formula, 9>& Formulae() {
  using enum DistortionModel;
  static const std::array<Formula, 9> kFormulae{{
      {"SIMPLE_PINHOLE", 0, 1, kBrownConrady, {}},
      {"PINHOLE", 1, 2, kBrownConrady, {}},
      {"SIMPLE_RADIAL", 2, 1, kBrownConrady, {0}},
      {"RADIAL", 3, 1, kBrownConrady, {0, 1}},
      {"OPENCV", 4, 2, kBrownConrady, {0, 1, 2, 3}},
      {"FULL_OPENCV", 6, 2, kBrownConrady, {0, 1, 2, 3, 4, 5, 6, 7}},
      {"SIMPLE_RADIAL_FISHEYE", 8, 1, kEquidistant, {0}},
      {"RADIAL_FISHEYE", 9, 1, kEquidistant, {0, 1}},
      {"OPENCV_FISHEYE", 5, 2, kEquidistant, {0, 1, 2, 3}},
  }};
  return kFormulae;
}

const Formula* FormulaOf(const std::string& name) {
  const auto& formulae = Formulae();
  const auto found = std::find_if(formulae.begin(), formulae.end(),
                                  [&](const Formula& formula) { return name == formula.name; });
  return found == formulae.end() ? nullptr : &*found;
}

std::size_t ParameterCount(const Formula& formula) {
  return formula.focal_lengths + 2 + formula.places.size();
}

/// Unsupported models that binary files may contain.
constexpr std::array<std::pair<int, const char*>, 3> kOthers{
    {{7, "FOV"}, {10, "THIN_PRISM_FISHEYE"}, {11, "RAD_TAN_THIN_PRISM_FISHEYE"}}};

}  // namespace

std::string ColmapModelName(int id) {
  for (const Formula& formula : Formulae()) {
    if (formula.id == id) return formula.name;
  }
  for (const auto& [other, name] : kOthers) {
    if (other == id) return name;
  }
  return fmt::format("number {}", id);
}

int ColmapModelId(const std::string& name) { return FormulaOf(name)->id; }

std::size_t ColmapParameterCount(const std::string& name) {
  const Formula* formula = FormulaOf(name);
  return formula == nullptr ? 0 : ParameterCount(*formula);
}

Result<CameraModel> CameraFromColmap(const ColmapCamera& camera, const std::string& where) {
  const Formula* formula = FormulaOf(camera.model);
  if (formula == nullptr) {
    std::string known;
    for (const Formula& other : Formulae()) known += std::string(" ") + other.name;
    return InputError(
        where,
        "has the camera model \"" + camera.model.substr(0, 40) + "\", which is not supported",
        "reconstruct with one of" + known);
  }
  const std::size_t count = ParameterCount(*formula);
  if (camera.parameters.size() != count) {
    return InputError(where,
                      fmt::format("has {} parameters where {} has {}", camera.parameters.size(),
                                  camera.model, count),
                      "correct it, or get a whole copy of the file");
  }
  if (!std::all_of(camera.parameters.begin(), camera.parameters.end(),
                   [](double parameter) { return std::isfinite(parameter); })) {
    return InputError(where, "has a parameter that is not finite",
                      "correct it, or get a whole copy of the file");
  }
  if (camera.width < 1 || camera.height < 1 || camera.width > kMaxSide ||
      camera.height > kMaxSide) {
    return InputError(where, fmt::format("has an image of {}x{}", camera.width, camera.height),
                      "sides are 1 to 100000 pixels");
  }
  const double* next = camera.parameters.data();
  CameraModel ours;
  ours.width = static_cast<int>(camera.width);
  ours.height = static_cast<int>(camera.height);
  ours.fx = *next++;
  ours.fy = formula->focal_lengths == 2 ? *next++ : ours.fx;
  if (!(ours.fx > 0.0) || !(ours.fy > 0.0)) {
    return InputError(where, "has a focal length that is not greater than zero",
                      "correct it, or get a whole copy of the file");
  }
  const Vec2 centre = PixelFromCornerOrigin({next[0], next[1]});
  ours.cx = centre.x;
  ours.cy = centre.y;
  next += 2;
  ours.distortion_model = formula->distortion_model;
  for (const std::size_t place : formula->places) ours.distortion[place] = *next++;
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
  for (const std::size_t place : FormulaOf(name)->places) theirs.parameters.push_back(k[place]);
  return theirs;
}

}  // namespace pleinair::exports
