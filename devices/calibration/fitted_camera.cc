#include "devices/calibration/fitted_camera.h"

#include <cmath>

#include "base/scaled_camera.h"

namespace pleinair::devices {
namespace {

/// Rounded sides of one shape differ by less, from 500 pixels on.
constexpr double kSameShape = 0.002;

bool HaveOneShape(ImageSize a, ImageSize b) {
  const double shape = static_cast<double>(a.width) / a.height;
  return std::abs(static_cast<double>(b.width) / b.height / shape - 1.0) <= kSameShape;
}

std::string Text(ImageSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

CameraModel QuarterTurned(const CameraModel& camera) {
  CameraModel turned = camera;
  turned.width = camera.height;
  turned.height = camera.width;
  turned.fx = camera.fy;
  turned.fy = camera.fx;
  turned.cx = camera.height - 1 - camera.cy;
  turned.cy = camera.cx;
  // (x, y) becomes (-y, x), so the tangential terms change places.
  if (camera.distortion_model == DistortionModel::kBrownConrady) {
    turned.distortion[2] = camera.distortion[3];
    turned.distortion[3] = -camera.distortion[2];
  }
  return turned;
}

}  // namespace

CameraModel TurnCamera(const CameraModel& camera, int quarters) {
  CameraModel turned = camera;
  for (int i = 0; i < quarters; ++i) turned = QuarterTurned(turned);
  return turned;
}

Result<FittedCamera> FitCamera(const CameraModel& camera, ImageSize film, int clockwise_deg,
                               const std::string& name) {
  const ImageSize calibrated{camera.width, camera.height};
  if (calibrated == film) return FittedCamera{camera, {}};
  constexpr const char* kPart = ". That is right if both show the same part of the sensor.";
  if (HaveOneShape(calibrated, film)) {
    return FittedCamera{
        ScaleCamera(camera, film),
        "The calibration for " + Text(calibrated) + " pixels was scaled to " + Text(film) + kPart};
  }
  const int quarters = clockwise_deg / 90;
  const bool is_turned = quarters % 2 != 0;
  if (is_turned && HaveOneShape(calibrated, {film.height, film.width})) {
    return FittedCamera{ScaleCamera(TurnCamera(camera, quarters), film),
                        "The calibration for " + Text(calibrated) + " pixels was turned by " +
                            std::to_string(clockwise_deg) + " degrees, as the film is, to " +
                            Text(film) + kPart};
  }
  return InputError(name,
                    "has " + Text(film) + " pixels, but the calibration is for " +
                        Text(calibrated) + ", another shape",
                    "use the calibration of this camera at this size: pleinair calibrate " + name +
                        " --marker sg -o camera.json");
}

}  // namespace pleinair::devices
