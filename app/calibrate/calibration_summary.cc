#include "app/calibrate/calibration_summary.h"

#include <fmt/format.h>

#include <cstddef>
#include <iostream>
#include <string>

#include "app/calibrate/calibration_drawings.h"
#include "app/calibrate/calibration_page.h"

namespace pleinair::app {

using tracker::LensCalibration;

nlohmann::ordered_json CalibrationJson(const LensCalibration& calibration,
                                       const Collection& collection,
                                       const tracker::CalibrationBoard& board) {
  const CameraModel& camera = calibration.fit.camera;
  const tracker::LensUncertainty& doubt = calibration.uncertainty;
  nlohmann::ordered_json json = {{"image_width", camera.width},
                                 {"image_height", camera.height},
                                 {"kind", NameOf(calibration.fit.kind)},
                                 {"board", board.Description()},
                                 {"fx", camera.fx},
                                 {"fy", camera.fy},
                                 {"cx", camera.cx},
                                 {"cy", camera.cy}};
  json["standard_deviations"] = {
      {"fx", doubt.fx}, {"fy", doubt.fy}, {"cx", doubt.cx}, {"cy", doubt.cy}};
  const auto names = CoefficientNames(camera);
  for (std::size_t i = 0; i < static_cast<std::size_t>(CoefficientsOf(calibration.fit.kind)); ++i) {
    json["distortion"][names[i]] = camera.distortion[i];
    json["standard_deviations"][names[i]] = doubt.distortion[i];
  }
  json["rms_px"] = calibration.rms_px;
  json["validation"] = {{"folds", calibration.validation.folds},
                        {"rms_px", calibration.validation.rms_px},
                        {"focal_px", calibration.validation.focal_px}};
  for (const tracker::TriedKind& tried : calibration.tried) {
    json["tried"].push_back({{"kind", NameOf(tried.kind)},
                             {"rms_px", tried.rms_px},
                             {"validation_rms_px", tried.validation_rms_px}});
  }
  json["pictures"] = collection.looked_at;
  for (std::size_t i = 0; i < calibration.views.size(); ++i) {
    json["views"].push_back({{"name", calibration.views[i].name},
                             {"corners", calibration.views[i].observed_px.size()},
                             {"rms_px", tracker::Rms(calibration.residuals_px[i])}});
  }
  json["left_out"] = nlohmann::json::array();
  for (const tracker::DroppedView& dropped : calibration.dropped) {
    json["left_out"].push_back({{"name", dropped.name}, {"why", dropped.why}});
  }
  json["corners_left_out"] = calibration.points_left_out;
  json["coverage"] = calibration.coverage.Share();
  for (const ResidualRegion& region : ResidualRegions(calibration)) {
    json["regions"].push_back({{"corners", region.points},
                               {"mean_px", {region.mean_px.x, region.mean_px.y}},
                               {"rms_px", region.rms_px}});
  }
  json["advice"] = calibration.judgement.advice;
  return json;
}

void PrintCalibration(const LensCalibration& calibration, const Collection& collection,
                      const tracker::CalibrationBoard& board) {
  const CameraModel& camera = calibration.fit.camera;
  const tracker::LensUncertainty& doubt = calibration.uncertainty;
  std::cout << fmt::format(
      "{}, seen in {} of {} images of {}x{}\n"
      "fx {:.2f} +- {:.2f} px, fy {:.2f} +- {:.2f} px, centre {:.2f}, {:.2f} +- {:.2f}, {:.2f} "
      "px\n",
      board.Description(), collection.views.size(), collection.looked_at, camera.width,
      camera.height, camera.fx, doubt.fx, camera.fy, doubt.fy, camera.cx, camera.cy, doubt.cx,
      doubt.cy);
  std::cout << NameOf(calibration.fit.kind) << ":";
  const auto names = CoefficientNames(camera);
  for (std::size_t i = 0; i < static_cast<std::size_t>(CoefficientsOf(calibration.fit.kind)); ++i) {
    std::cout << fmt::format(" {} {:.5f} +- {:.5f}", names[i], camera.distortion[i],
                             doubt.distortion[i]);
  }
  std::cout << fmt::format(
      "\nRMS {:.3f} px, of views left out {:.3f} px; {:.0f} % of the image covered\n",
      calibration.rms_px, calibration.validation.rms_px, 100.0 * calibration.coverage.Share());
  for (const tracker::DroppedView& dropped : calibration.dropped) {
    std::cerr << "left out " << dropped.name << ": " << dropped.why << '\n';
  }
  for (const std::string& advice : calibration.judgement.advice) {
    std::cerr << "better: " << advice << '\n';
  }
}

}  // namespace pleinair::app
