#include "devices/calibration/calibration_text.h"

#include <vector>

#include "files/json_fields.h"

namespace pleinair::devices {
namespace {

using OrderedJson = nlohmann::ordered_json;

bool IsEquidistant(const CameraModel& camera) {
  return camera.distortion_model == DistortionModel::kEquidistant;
}

/// All coefficients up to the last non-zero one: 4, 5 or 8; 4 when equidistant.
std::vector<double> Coefficients(const CameraModel& camera) {
  std::size_t count = 4;
  if (!IsEquidistant(camera)) {
    if (camera.distortion[4] != 0.0) count = 5;
    for (std::size_t i = 5; i < 8; ++i) {
      if (camera.distortion[i] != 0.0) count = 8;
    }
  }
  return {camera.distortion.begin(),
          camera.distortion.begin() + static_cast<std::ptrdiff_t>(count)};
}

/// OpenCV and ROS expect at least five.
std::vector<double> FiveOrMore(const CameraModel& camera) {
  std::vector<double> coefficients = Coefficients(camera);
  if (!IsEquidistant(camera) && coefficients.size() < 5) coefficients.push_back(0.0);
  return coefficients;
}

/// The shortest decimal that reads back the same, with a decimal point: YAML 1.1 reads "1e-05" as
/// text.
std::string Number(double value) {
  std::string text = files::Json(value).dump();
  if (const std::size_t e = text.find('e'); e != std::string::npos && text.find('.') > e) {
    text.insert(e, ".0");
  }
  return text;
}

std::string List(const std::vector<double>& values) {
  std::string text = "[";
  for (std::size_t i = 0; i < values.size(); ++i) text += (i == 0 ? "" : ", ") + Number(values[i]);
  return text + "]";
}

std::vector<double> Matrix(const CameraModel& c) {
  return {c.fx, 0.0, c.cx, 0.0, c.fy, c.cy, 0.0, 0.0, 1.0};
}

std::string Own(const CameraModel& camera, const std::map<std::string, double>& notes) {
  const std::vector<double> coefficients = Coefficients(camera);
  OrderedJson json = {{"image_width", camera.width},
                      {"image_height", camera.height},
                      {"model", IsEquidistant(camera) ? "equidistant" : "opencv-radtan"},
                      {"fx", camera.fx},
                      {"fy", camera.fy},
                      {"cx", camera.cx},
                      {"cy", camera.cy}};
  const char* key = IsEquidistant(camera)      ? "distortion_k1_k2_k3_k4"
                    : coefficients.size() == 8 ? "distortion_k1_k2_p1_p2_k3_k4_k5_k6"
                                               : "distortion_k1_k2_p1_p2_k3";
  json[key] = FiveOrMore(camera);
  for (const auto& [name, value] : notes) json["quality"][name] = value;
  return json.dump(2) + "\n";
}

std::string OpenCvJson(const CameraModel& camera) {
  const std::vector<double> coefficients = FiveOrMore(camera);
  const auto matrix = [](std::size_t rows, std::size_t columns, std::vector<double> data) {
    return OrderedJson{{"type_id", "opencv-matrix"},
                       {"rows", rows},
                       {"cols", columns},
                       {"dt", "d"},
                       {"data", std::move(data)}};
  };
  return OrderedJson{{"image_width", camera.width},
                     {"image_height", camera.height},
                     {"fisheye_model", IsEquidistant(camera) ? 1 : 0},
                     {"camera_matrix", matrix(3, 3, Matrix(camera))},
                     {"distortion_coefficients", matrix(coefficients.size(), 1, coefficients)}}
             .dump(4) +
         "\n";
}

std::string OpenCvYaml(const CameraModel& camera) {
  const std::vector<double> coefficients = FiveOrMore(camera);
  const auto matrix = [](const char* name, std::size_t rows, std::size_t columns,
                         const std::vector<double>& data) {
    return std::string(name) + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
           "\n   cols: " + std::to_string(columns) + "\n   dt: d\n   data: " + List(data) + "\n";
  };
  return "%YAML:1.0\n---\nimage_width: " + std::to_string(camera.width) +
         "\nimage_height: " + std::to_string(camera.height) +
         "\nfisheye_model: " + (IsEquidistant(camera) ? "1" : "0") + "\n" +
         matrix("camera_matrix", 3, 3, Matrix(camera)) +
         matrix("distortion_coefficients", coefficients.size(), 1, coefficients);
}

std::string Ros(const CameraModel& camera) {
  const std::vector<double> coefficients = FiveOrMore(camera);
  const auto matrix = [](const char* name, std::size_t rows, std::size_t columns,
                         const std::vector<double>& data) {
    return std::string(name) + ":\n  rows: " + std::to_string(rows) +
           "\n  cols: " + std::to_string(columns) + "\n  data: " + List(data) + "\n";
  };
  const char* model = IsEquidistant(camera)      ? "equidistant"
                      : coefficients.size() == 8 ? "rational_polynomial"
                                                 : "plumb_bob";
  return "image_width: " + std::to_string(camera.width) +
         "\nimage_height: " + std::to_string(camera.height) + "\ncamera_name: camera\n" +
         matrix("camera_matrix", 3, 3, Matrix(camera)) + "distortion_model: " + model + "\n" +
         matrix("distortion_coefficients", 1, coefficients.size(), coefficients) +
         matrix("rectification_matrix", 3, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         matrix("projection_matrix", 3, 4,
                {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0});
}

/// Kalibr's cam0 and EuRoC's sensor.yaml share most fields.
Result<std::string> KalibrOrEuroc(const CameraModel& camera, bool kalibr) {
  const std::vector<double> coefficients = Coefficients(camera);
  if (coefficients.size() != 4) {
    return InputError("",
                      std::string(kalibr ? "Kalibr" : "EuRoC") +
                          "'s form has four coefficients of distortion, and this lens has " +
                          std::to_string(coefficients.size()),
                      "calibrate with --model radtan4 for it");
  }
  const std::string indent = kalibr ? "  " : "";
  const char* model = IsEquidistant(camera) ? "equidistant"
                      : kalibr              ? "radtan"
                                            : "radial-tangential";
  return (kalibr ? "cam0:\n" : "sensor_type: camera\n") + indent + "camera_model: pinhole\n" +
         indent + "intrinsics: " + List({camera.fx, camera.fy, camera.cx, camera.cy}) + "\n" +
         indent + "distortion_model: " + model + "\n" + indent +
         (kalibr ? "distortion_coeffs: " : "distortion_coefficients: ") + List(coefficients) +
         "\n" + indent + "resolution: [" + std::to_string(camera.width) + ", " +
         std::to_string(camera.height) + "]\n";
}

}  // namespace

Result<std::string> CalibrationText(const CameraModel& camera, CalibrationForm form,
                                    const std::map<std::string, double>& notes) {
  switch (form) {
    case CalibrationForm::kOwn:
      return Own(camera, notes);
    case CalibrationForm::kOpenCvYaml:
      return OpenCvYaml(camera);
    case CalibrationForm::kOpenCvJson:
      return OpenCvJson(camera);
    case CalibrationForm::kRos:
      return Ros(camera);
    case CalibrationForm::kKalibr:
    case CalibrationForm::kEuroc:
      break;
  }
  return KalibrOrEuroc(camera, form == CalibrationForm::kKalibr);
}

}  // namespace pleinair::devices
