#include "devices/calibration/calibration.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <optional>
#include <vector>

#include "files/json_fields.h"
#include "files/text_file.h"

namespace pleinair::devices {
namespace {

constexpr int kMaxSide = 100'000;
constexpr const char* kRemedy =
    "see docs/guide/reference/recordings.md for the calibrations that can be read, or calibrate "
    "anew";

// Lower case, letters and digits only: "Radial-Tangential" and "radial_tangential" become equal.
std::string Canonical(const std::string& word) {
  std::string canonical;
  for (const char c : word) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) != 0) canonical += static_cast<char>(std::tolower(letter));
  }
  return canonical;
}

// Content of a file, before validation.
struct Readings {
  std::optional<int> width, height;
  std::vector<double> focal_and_centre;  // fx fy cx cy
  std::string model;                     // As the file names it; empty if absent.
  bool fisheye = false;                  // From a field other than the model's name.
  std::optional<std::vector<double>> distortion;
};

Result<DistortionModel> ModelOf(const Readings& readings, const std::string& name) {
  if (readings.fisheye) return DistortionModel::kEquidistant;
  const std::string model = Canonical(readings.model);
  for (const char* known : {"equidistant", "fisheye", "opencvfisheye", "kannalabrandt",
                            "kannalabrandt4", "kannalabrandt8", "kb4"}) {
    if (model == known) return DistortionModel::kEquidistant;
  }
  for (const char* known : {"", "none", "pinhole", "radtan", "opencvradtan", "radialtangential",
                            "plumbbob", "opencv", "opencvk1k2p1p2k3", "opencvk1k2p1p2",
                            "rationalpolynomial", "opencvrational", "rational", "brownconrady"}) {
    if (model == known) return DistortionModel::kBrownConrady;
  }
  return InputError(
      name, "has the distortion model \"" + readings.model.substr(0, 64) + "\", which is not known",
      "known are pinhole, radtan (plumb_bob, rational_polynomial) and equidistant "
      "(fisheye)");
}

// OpenCV's thin prism and tilt terms (entries 9 to 14) must be zero.
Result<std::array<double, 8>> CoefficientsOf(const Readings& readings, DistortionModel model,
                                             const std::string& name) {
  std::array<double, 8> coefficients{};
  const std::string word = Canonical(readings.model);
  if (!readings.distortion) {
    if (model == DistortionModel::kBrownConrady &&
        (word.empty() || word == "pinhole" || word == "none")) {
      return coefficients;
    }
    return InputError(name, "names a distortion model but has no distortion coefficients", kRemedy);
  }
  std::vector<double> given = *readings.distortion;
  while (given.size() > 8 && given.size() <= 14 && given.back() == 0.0) given.pop_back();
  const std::size_t count = given.size();
  const bool fits = model == DistortionModel::kEquidistant
                        ? count == 4
                        : count == 0 || count == 4 || count == 5 || count == 8;
  if (!fits) {
    return InputError(name,
                      "has " + std::to_string(count) + " distortion coefficients, but its model " +
                          (model == DistortionModel::kEquidistant ? "(equidistant) has 4"
                                                                  : "(radtan) has 4, 5 or 8"),
                      kRemedy);
  }
  std::copy(given.begin(), given.end(), coefficients.begin());
  return coefficients;
}

std::string Short(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

/// Ranges relative to the image's longer side: lenses of 0.6 to 178 degrees of view, whose axis may
/// lie outside a cropped image.
Result<void> CheckIntrinsics(const CameraModel& camera, const std::string& name) {
  constexpr double kMinFocal = 0.01, kMaxFocal = 100.0, kMaxCentre = 10.0;
  const double side = std::max(camera.width, camera.height);
  struct Intrinsic {
    const char* name;
    double value, min, max;
  };
  for (const Intrinsic& each : {Intrinsic{"fx", camera.fx, kMinFocal * side, kMaxFocal * side},
                                {"fy", camera.fy, kMinFocal * side, kMaxFocal * side},
                                {"cx", camera.cx, -kMaxCentre * side, kMaxCentre * side},
                                {"cy", camera.cy, -kMaxCentre * side, kMaxCentre * side}}) {
    if (std::isfinite(each.value) && each.value >= each.min && each.value <= each.max) continue;
    return InputError(
        name,
        std::string("has ") + each.name + " = " + Short(each.value) + ", outside " +
            Short(each.min) + " to " + Short(each.max) + " for an image of " +
            std::to_string(camera.width) + "x" + std::to_string(camera.height),
        "all four are in pixels; focal lengths are about as many as the image is wide");
  }
  return {};
}

/// The distorted radius must grow with the undistorted one, as far as the image reaches: otherwise
/// two directions share a pixel. For fisheyes, as far as the image circle or 90 degrees.
Result<void> CheckDistortion(const CameraModel& camera, const std::string& name) {
  const bool fisheye = camera.distortion_model == DistortionModel::kEquidistant;
  // Half the corner's distance: no lens draws its corners further in.
  constexpr double kMinShrink = 0.5, kMaxRadius = 60.0, kStep = 0.002;
  const double x = std::max(camera.cx, camera.width - camera.cx) / camera.fx;
  const double y = std::max(camera.cy, camera.height - camera.cy) / camera.fy;
  const double reach = fisheye ? std::min(x, y) : std::hypot(x, y);
  double radius = 0.0, distorted = 0.0;
  while (distorted < reach && radius < kMaxRadius) {
    radius += kStep * (1.0 + radius);
    double next = 0.0, across = 0.0;
    CameraModel radial = camera;
    if (!fisheye) radial.distortion[2] = radial.distortion[3] = 0.0;
    DistortNormalized(radial, radius, 0.0, &next, &across);
    if (!(next > distorted)) {
      return InputError(name,
                        "has a distortion that folds the image " + Short(distorted * camera.fx) +
                            " pixels from its center, inside the image, which reaches " +
                            Short(reach * camera.fx),
                        "calibrate again, with views that reach the corners");
    }
    distorted = next;
  }
  if (fisheye || distorted < reach || radius >= kMinShrink * reach) return {};
  return InputError(name,
                    "has a distortion that moves the corners of the image from less than half of "
                    "their distance from the center",
                    "check the coefficients, or calibrate again");
}

Result<CameraModel> Judge(const Readings& readings, const std::string& name) {
  if (!readings.width || !readings.height) {
    return InputError(name, "does not say how many pixels the image has",
                      "add image_width and image_height");
  }
  if (*readings.width < 1 || *readings.height < 1 || *readings.width > kMaxSide ||
      *readings.height > kMaxSide) {
    return InputError(name,
                      "is for an image of " + std::to_string(*readings.width) + "x" +
                          std::to_string(*readings.height) + " pixels, which cannot be",
                      "the sides must be 1 to 100000");
  }
  if (readings.focal_and_centre.size() != 4) {
    return InputError(name, "lacks one of the four intrinsics fx, fy, cx, cy", kRemedy);
  }
  CameraModel camera;
  camera.width = *readings.width;
  camera.height = *readings.height;
  camera.fx = readings.focal_and_centre[0];
  camera.fy = readings.focal_and_centre[1];
  camera.cx = readings.focal_and_centre[2];
  camera.cy = readings.focal_and_centre[3];
  PLEINAIR_RETURN_IF_ERROR(CheckIntrinsics(camera, name));
  PLEINAIR_ASSIGN_OR_RETURN(camera.distortion_model, ModelOf(readings, name));
  PLEINAIR_ASSIGN_OR_RETURN(camera.distortion,
                            CoefficientsOf(readings, camera.distortion_model, name));
  PLEINAIR_RETURN_IF_ERROR(CheckDistortion(camera, name));
  return camera;
}

// The numbers under the first of `keys` that is present: a plain list, or OpenCV's and ROS's {rows,
// cols, data}.
Result<std::optional<std::vector<double>>> Matrix(const files::JsonFields& fields,
                                                  std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    const files::Json* value = fields.Find(key);
    if (value == nullptr) continue;
    if (!value->is_object()) return fields.Numbers(key);
    const files::JsonFields matrix = fields.Object(key);
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<int> rows, matrix.Integer("rows"));
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<int> columns, matrix.Integer("cols"));
    PLEINAIR_ASSIGN_OR_RETURN(std::optional<std::vector<double>> data, matrix.Numbers("data"));
    if (!data) return fields.Fail(key, "has no \"data\"", kRemedy);
    const auto count = static_cast<double>(data->size());
    if (rows && columns && static_cast<double>(*rows) * *columns != count) {
      return fields.Fail(
          key, "has " + std::to_string(data->size()) + " numbers, not rows times columns of them",
          kRemedy);
    }
    return data;
  }
  return std::nullopt;
}

// The first of `keys` that is present, as an integer.
Result<std::optional<int>> IntegerOf(const files::JsonFields& fields,
                                     std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (fields.Has(key)) return fields.Integer(key);
  }
  return std::nullopt;
}

// Sets the image's size from a list [width, height].
Result<void> SizeFromList(const files::JsonFields& fields, std::initializer_list<const char*> keys,
                          Readings* readings) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::vector<double>> size, Matrix(fields, keys));
  if (!size) return {};
  const bool whole = std::all_of(size->begin(), size->end(), [](double side) {
    return std::trunc(side) == side && std::fabs(side) < 1e9;
  });
  if (size->size() != 2 || !whole) {
    return InputError(fields.name(), "has an image size that is not [width, height]", kRemedy);
  }
  readings->width = static_cast<int>((*size)[0]);
  readings->height = static_cast<int>((*size)[1]);
  return {};
}

// pleinair's format: {"image_width", "image_height", "model", "fx", "fy", "cx", "cy",
// "distortion_k1_k2_p1_p2_k3": […]}. A scene.json uses "dist" and has the size in "image".
Result<CameraModel> ReadOwn(const files::JsonFields& fields, Readings readings) {
  if (!readings.width) {
    PLEINAIR_ASSIGN_OR_RETURN(readings.width, IntegerOf(fields, {"image_width", "width"}));
    PLEINAIR_ASSIGN_OR_RETURN(readings.height, IntegerOf(fields, {"image_height", "height"}));
  }
  for (const char* key : {"fx", "fy", "cx", "cy"}) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> intrinsic, fields.Number(key));
    if (!intrinsic) return fields.Fail(key, "is missing", kRemedy);
    readings.focal_and_centre.push_back(*intrinsic);
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> model, fields.Text("model"));
  readings.model = model.value_or("");
  PLEINAIR_ASSIGN_OR_RETURN(
      readings.distortion,
      Matrix(fields, {"distortion_k1_k2_p1_p2_k3", "distortion_k1_k2_p1_p2_k3_k4_k5_k6",
                      "distortion_k1_k2_k3_k4", "dist", "distortion", "distortion_coefficients"}));
  return Judge(readings, fields.name());
}

// Kalibr's cam0 and EuRoC's sensor.yaml: intrinsics [fx, fy, cx, cy], resolution [w, h].
Result<CameraModel> ReadKalibr(const files::JsonFields& fields) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> camera, fields.Text("camera_model"));
  if (camera && Canonical(*camera) != "pinhole") {
    return fields.Fail("camera_model", "is \"" + camera->substr(0, 64) + "\", which is not known",
                       "calibrate with camera_model pinhole (pinhole-radtan or pinhole-equi)");
  }
  Readings readings;
  PLEINAIR_RETURN_IF_ERROR(SizeFromList(fields, {"resolution"}, &readings));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::vector<double>> intrinsics,
                            fields.Numbers("intrinsics"));
  if (!intrinsics) return fields.Fail("intrinsics", "is missing", kRemedy);
  readings.focal_and_centre = *intrinsics;
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> model,
                            fields.Text("distortion_model"));
  readings.model = model.value_or("");
  PLEINAIR_ASSIGN_OR_RETURN(readings.distortion,
                            Matrix(fields, {"distortion_coeffs", "distortion_coefficients"}));
  return Judge(readings, fields.name());
}

constexpr std::initializer_list<const char*> kMatrixKeys = {"camera_matrix",
                                                            "cameraMatrix",
                                                            "Camera_Matrix",
                                                            "CameraMatrix",
                                                            "camera_Matrix",
                                                            "K",
                                                            "k",
                                                            "intrinsic_matrix",
                                                            "intrinsics_matrix",
                                                            "mtx",
                                                            "M",
                                                            "M1"};

// OpenCV and ROS: a 3x3 camera matrix and a row or column of distortion coefficients.
Result<CameraModel> ReadMatrixForm(const files::JsonFields& fields) {
  Readings readings;
  PLEINAIR_ASSIGN_OR_RETURN(
      readings.width, IntegerOf(fields, {"image_width", "imageWidth", "image_Width", "width"}));
  PLEINAIR_ASSIGN_OR_RETURN(readings.height, IntegerOf(fields, {"image_height", "imageHeight",
                                                                "image_Height", "height"}));
  if (!readings.width) {
    PLEINAIR_RETURN_IF_ERROR(
        SizeFromList(fields, {"image_size", "imageSize", "img_size", "size"}, &readings));
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::vector<double>> matrix,
                            Matrix(fields, kMatrixKeys));
  if (!matrix || matrix->size() != 9) {
    return InputError(fields.name(), "has a camera matrix that is not 3x3", kRemedy);
  }
  const std::vector<double>& k = *matrix;
  if (k[3] != 0.0 || k[6] != 0.0 || k[7] != 0.0 || k[8] != 1.0) {
    return InputError(fields.name(),
                      "has a camera matrix that is not [fx 0 cx; 0 fy cy; 0 0 1], row by row",
                      kRemedy);
  }
  if (std::fabs(k[1]) > 1e-6 * std::fabs(k[0])) {
    return InputError(fields.name(), "has a camera matrix with skew, which is not known",
                      "calibrate without skew, as OpenCV does");
  }
  readings.focal_and_centre = {k[0], k[4], k[2], k[5]};
  for (const char* key : {"distortion_model", "camera_model", "model"}) {
    if (readings.model.empty()) readings.model = fields.TextOr(key);
  }
  for (const char* key : {"fisheye_model", "fisheye", "is_fisheye"}) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<bool> fisheye, fields.Flag(key));
    readings.fisheye = readings.fisheye || fisheye.value_or(false);
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      readings.distortion,
      Matrix(fields, {"distortion_coefficients", "distortion_coeffs", "distCoeffs", "dist_coeffs",
                      "dist_coeff", "Distortion_Coefficients", "DistortionCoefficients",
                      "distCoefs", "distortion", "dist", "D", "d", "D1"}));
  return Judge(readings, fields.name());
}

// The camera in a document of any of the formats.
Result<CameraModel> CameraFromDocument(const files::Json& document, const std::string& name) {
  const files::JsonFields fields(document, name);
  if (fields.Has("cam0")) return ReadKalibr(fields.Object("cam0"));
  if (fields.Has("calibration")) return ReadOwn(fields.Object("calibration"), {});
  if (const files::Json* intrinsics = fields.Find("intrinsics"); intrinsics != nullptr) {
    if (!intrinsics->is_object()) return ReadKalibr(fields);
    Readings readings;
    const files::JsonFields image = fields.Object("image");
    PLEINAIR_ASSIGN_OR_RETURN(readings.width, image.Integer("width"));
    PLEINAIR_ASSIGN_OR_RETURN(readings.height, image.Integer("height"));
    return ReadOwn(fields.Object("intrinsics"), readings);
  }
  for (const char* key : {"fx", "fy", "cx", "cy"}) {
    if (fields.Has(key)) return ReadOwn(fields, {});
  }
  for (const char* key : kMatrixKeys) {
    if (fields.Has(key)) return ReadMatrixForm(fields);
  }
  return InputError(name, "is no calibration: it has neither fx, fy, cx, cy nor a camera matrix",
                    "our JSON, OpenCV YAML, ROS camera_info, Kalibr and EuRoC can be read");
}

}  // namespace

Result<CameraModel> ParseCalibration(std::string_view bytes, const std::string& name) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == std::string_view::npos) {
    return InputError(name, "is empty", "get a whole copy of it");
  }
  bytes.remove_prefix(first);
  if (bytes.starts_with("<?xml")) {
    return InputError(name, "is XML", "have OpenCV write it as .yaml or .json instead");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const files::Json document, bytes.starts_with('{')
                                                            ? files::ParseJson(bytes, name)
                                                            : files::ParseYaml(bytes, name));
  return CameraFromDocument(document, name);
}

Result<CameraModel> ReadCalibration(const std::filesystem::path& file) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string bytes,
                            files::ReadWholeFile(file, files::kMaxCalibrationBytes));
  return ParseCalibration(bytes, file.string());
}

}  // namespace pleinair::devices
