#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"

namespace pleinair::exports {

/// A camera as COLMAP's cameras.txt has it: the model's name and its parameters in COLMAP's order
/// (its sensor/models.h). Pixel centres lie at .5.
struct ColmapCamera {
  std::string model;
  std::int64_t width = 0, height = 0;
  std::vector<double> parameters;
};

/// The name of the model that binary files tell by a number (COLMAP's sensor/models.h); "number 99"
/// where there is none.
std::string ColmapModelName(int id);
/// The number of a model that ColmapFromCamera gives.
int ColmapModelId(const std::string& name);
/// How many parameters a model has; 0 of models whose formulae we do not know.
std::size_t ColmapParameterCount(const std::string& name);

/// Our model of it. SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, FULL_OPENCV,
/// OPENCV_FISHEYE, SIMPLE_RADIAL_FISHEYE and RADIAL_FISHEYE are the same formulae with fewer or
/// more terms. Errors: other models (FOV, THIN_PRISM_FISHEYE …), another number of parameters, one
/// that is not finite, a focal length that is not greater than zero, a size outside 1…100000.
Result<CameraModel> CameraFromColmap(const ColmapCamera& camera, const std::string& where);

/// The smallest of COLMAP's models that holds ours: PINHOLE, OPENCV, FULL_OPENCV, OPENCV_FISHEYE.
ColmapCamera ColmapFromCamera(const CameraModel& camera);

}  // namespace pleinair::exports
