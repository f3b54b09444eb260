#include "app/accuracy/record_json.h"

#include <array>
#include <nlohmann/json.hpp>

namespace pleinair::app {
namespace {

using Json = nlohmann::ordered_json;
using accuracy::FrameRecord;
using accuracy::MarkerRecord;
using accuracy::Outcome;
using accuracy::PoseRecord;

constexpr std::array<const char*, 3> kOutcomes{"hit", "misplaced", "missed"};

Json PointsJson(const std::array<Vec2, 4>& points) {
  Json json = Json::array();
  for (const Vec2 point : points) json.push_back({point.x, point.y});
  return json;
}

std::array<Vec2, 4> PointsOf(const Json& json) {
  std::array<Vec2, 4> points;
  for (std::size_t i = 0; i < 4; ++i) {
    points[i] = {json.at(i).at(0).get<double>(), json.at(i).at(1).get<double>()};
  }
  return points;
}

Json PoseJson(const Transform<Camera, Marker>& pose) {
  const Vec3& t = pose.translation_m;
  return {{"rotation", pose.rotation.m}, {"translation_m", {t.x, t.y, t.z}}};
}

Transform<Camera, Marker> PoseOf(const Json& json) {
  Transform<Camera, Marker> pose;
  json.at("rotation").get_to(pose.rotation.m);
  const auto t = json.at("translation_m").get<std::array<double, 3>>();
  pose.translation_m = {t[0], t[1], t[2]};
  return pose;
}

Json OptionalJson(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

std::optional<double> OptionalOf(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<double>());
}

Json MarkerJson(const MarkerRecord& marker) {
  Json json{{"number", marker.number},
            {"true_pose", PoseJson(marker.true_camera_from_marker)},
            {"true_corners", PointsJson(marker.true_corners_px)},
            {"border_covered", marker.border_covered},
            {"content_covered", marker.content_covered},
            {"outcome", kOutcomes[static_cast<std::size_t>(marker.outcome)]}};
  if (marker.outcome == Outcome::kMissed) return json;
  json["corner_error"] = PointsJson(marker.corner_error_px);
  json["visible_fraction"] = marker.visible_fraction;
  json["path"] = marker.path;
  if (!marker.pose) return json;
  const PoseRecord& pose = *marker.pose;
  json["pose"] = PoseJson(pose.camera_from_marker);
  json["rotation_error_deg"] = pose.rotation_error_deg;
  json["translation_error_m"] = pose.translation_error_m;
  json["nees"] = OptionalJson(pose.nees);
  json["ambiguity_ratio"] = pose.ambiguity_ratio;
  json["alternative_error_deg"] = OptionalJson(pose.alternative_error_deg);
  return json;
}

MarkerRecord MarkerOf(const Json& json) {
  MarkerRecord marker;
  json.at("number").get_to(marker.number);
  marker.true_camera_from_marker = PoseOf(json.at("true_pose"));
  marker.true_corners_px = PointsOf(json.at("true_corners"));
  json.at("border_covered").get_to(marker.border_covered);
  json.at("content_covered").get_to(marker.content_covered);
  const std::string outcome = json.at("outcome");
  for (std::size_t i = 0; i < kOutcomes.size(); ++i) {
    if (outcome == kOutcomes[i]) marker.outcome = static_cast<Outcome>(i);
  }
  if (marker.outcome == Outcome::kMissed) return marker;
  marker.corner_error_px = PointsOf(json.at("corner_error"));
  json.at("visible_fraction").get_to(marker.visible_fraction);
  json.at("path").get_to(marker.path);
  if (!json.contains("pose")) return marker;
  PoseRecord& pose = marker.pose.emplace();
  pose.camera_from_marker = PoseOf(json.at("pose"));
  json.at("rotation_error_deg").get_to(pose.rotation_error_deg);
  json.at("translation_error_m").get_to(pose.translation_error_m);
  pose.nees = OptionalOf(json.at("nees"));
  json.at("ambiguity_ratio").get_to(pose.ambiguity_ratio);
  pose.alternative_error_deg = OptionalOf(json.at("alternative_error_deg"));
  return marker;
}

}  // namespace

std::string RecordJson(const FrameRecord& record, bool with_times) {
  Json json{{"frame", record.frame},
            {"name", record.name},
            {"sweep", record.sweep},
            {"pattern", record.pattern},
            {"level", record.level},
            {"repeat", record.repeat},
            {"detector", record.detector},
            {"markers", Json::array()},
            {"false_numbers", record.false_numbers},
            {"lost", record.lost}};
  for (const MarkerRecord& marker : record.markers) json["markers"].push_back(MarkerJson(marker));
  if (with_times) {
    for (const auto& [stage, ms] : record.stages_ms) json["stages_ms"][stage] = ms;
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<FrameRecord> ParseRecord(std::string_view line, const std::string& where) {
  try {
    const Json json = Json::parse(line);
    FrameRecord record;
    json.at("frame").get_to(record.frame);
    json.at("name").get_to(record.name);
    json.at("sweep").get_to(record.sweep);
    json.at("pattern").get_to(record.pattern);
    json.at("level").get_to(record.level);
    json.at("repeat").get_to(record.repeat);
    json.at("detector").get_to(record.detector);
    for (const Json& marker : json.at("markers")) record.markers.push_back(MarkerOf(marker));
    json.at("false_numbers").get_to(record.false_numbers);
    json.at("lost").get_to(record.lost);
    if (json.contains("stages_ms")) {
      for (const auto& [stage, ms] : json.at("stages_ms").items()) {
        record.stages_ms.emplace_back(stage, ms.get<double>());
      }
    }
    return record;
  } catch (const Json::exception&) {
    return InputError(where, "is no record of an accuracy run",
                      "run 'pleinair accuracy' again with the same -o");
  }
}

}  // namespace pleinair::app
