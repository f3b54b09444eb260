#include "app/output/pose_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace pleinair::app {
namespace {

using Json = nlohmann::ordered_json;

Json PoseJson(const Transform<Camera, Marker>& pose) {
  const Vec3 t = pose.translation_m;
  return {{"rotation", pose.rotation.m}, {"translation_m", {t.x, t.y, t.z}}};
}

Json SightingJson(const tracker::MarkerObservation& observation) {
  const tracker::MarkerDetection& detection = observation.detection;
  const tracker::PoseEstimate& pose = observation.pose;
  Json corners = Json::array();
  for (const Vec2 corner : detection.corners_px) corners.push_back({corner.x, corner.y});
  Json alternative = nullptr;
  if (pose.alternative) {
    alternative = {{"camera_from_marker", PoseJson(pose.alternative->camera_from_marker)},
                   {"reprojection_rms_px", pose.alternative->reprojection_rms_px}};
  }
  Json visibility = nullptr;
  if (detection.visibility_side > 0) {
    Json values = Json::array();
    for (const float value : detection.visibility) values.push_back(std::round(value * 100) / 100);
    visibility = {{"side", detection.visibility_side}, {"values", std::move(values)}};
  }
  Json marker{{"family", detection.family},
              {"id", detection.id ? Json(*detection.id) : Json(nullptr)}};
  if (!detection.name.empty()) marker["name"] = detection.name;
  marker.update(Json{{"corners", corners},
                     {"camera_from_marker", PoseJson(pose.best.camera_from_marker)},
                     {"covariance", pose.covariance},
                     {"reprojection_rms_px", pose.best.reprojection_rms_px},
                     {"ambiguity_ratio", pose.ambiguity_ratio},
                     {"visible_fraction", detection.visible_fraction},
                     {"visibility", std::move(visibility)},
                     {"alternative", alternative},
                     {"path", tracker::TrajectoryName(detection.path)}});
  return marker;
}

}  // namespace

std::string MarkersJson(const std::vector<tracker::MarkerObservation>& observations) {
  Json markers = Json::array();
  for (const tracker::MarkerObservation& observation : observations)
    markers.push_back(SightingJson(observation));
  return markers.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string LostJson(const std::vector<tracker::LostMarker>& lost_markers) {
  Json markers = Json::array();
  for (const tracker::LostMarker& marker : lost_markers) {
    Json lost{{"family", marker.family}, {"id", marker.id}};
    if (!marker.name.empty()) lost["name"] = marker.name;
    lost["frames"] = marker.frames;
    markers.push_back(std::move(lost));
  }
  return markers.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace pleinair::app
