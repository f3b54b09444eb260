#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"

namespace pleinair::exports {

/// A camera as in COLMAP's cameras.txt: the model's name and its parameters in COLMAP's order (its
/// sensor/models.h). Pixel centres are at .5.
struct ColmapCamera {
  std::string model;
  std::int64_t width = 0, height = 0;
  std::vector<double> parameters;
};

/// Name of the model with this id in binary files (COLMAP's sensor/models.h); "number 99" if
/// unknown.
std::string ColmapModelName(int id);
/// Id of a model that ColmapFromCamera returns.
int ColmapModelId(const std::string& name);
/// Number of parameters of a model; 0 for unsupported models.
std::size_t ColmapParameterCount(const std::string& name);

/// Converts it to our camera model. SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV,
/// FULL_OPENCV, OPENCV_FISHEYE, SIMPLE_RADIAL_FISHEYE and RADIAL_FISHEYE use the same formulae with
/// fewer or more terms. Errors: other models (FOV, THIN_PRISM_FISHEYE …), a wrong number of
/// parameters, a parameter that is not finite. Also a focal length that is not positive, a size
/// outside 1…100000.
Result<CameraModel> CameraFromColmap(const ColmapCamera& camera, const std::string& where);

/// Returns the smallest COLMAP model that contains ours: PINHOLE, OPENCV, FULL_OPENCV,
/// OPENCV_FISHEYE.
ColmapCamera ColmapFromCamera(const CameraModel& camera);

}  // namespace pleinair::exports
