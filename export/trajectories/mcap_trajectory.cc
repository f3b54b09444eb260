#include "export/trajectories/mcap_trajectory.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "export/trajectories/mcap_writer.h"

namespace pleinair::exports {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr const char* kCamera = "camera";
// A marker is thin, but viewers need a positive height.
constexpr double kMarkerThickness_m = 0.001;

// JSON Schemas of the messages. Their names are those of Foxglove's published message types, which
// viewers recognize.
Json Number() { return {{"type", "number"}}; }
Json Integer() { return {{"type", "integer"}}; }
Json Text() { return {{"type", "string"}}; }
Json List(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }
Json Object(Json properties) { return {{"type", "object"}, {"properties", std::move(properties)}}; }
Json TimeSchema(const char* title) {
  return {{"type", "object"},
          {"title", title},
          {"properties",
           {{"sec", {{"type", "integer"}, {"minimum", 0}}},
            {"nsec", {{"type", "integer"}, {"minimum", 0}, {"maximum", kSecond - 1}}}}}};
}
Json VectorSchema() { return Object({{"x", Number()}, {"y", Number()}, {"z", Number()}}); }
Json TurnSchema() {
  return Object({{"x", Number()}, {"y", Number()}, {"z", Number()}, {"w", Number()}});
}
Json PoseSchema() { return Object({{"position", VectorSchema()}, {"orientation", TurnSchema()}}); }

Json CalibrationSchema() {
  return Object({{"timestamp", TimeSchema("time")},
                 {"frame_id", Text()},
                 {"width", Integer()},
                 {"height", Integer()},
                 {"distortion_model", Text()},
                 {"D", List(Number())},
                 {"K", List(Number())},
                 {"R", List(Number())},
                 {"P", List(Number())}});
}

Json TransformSchema() {
  return Object({{"timestamp", TimeSchema("time")},
                 {"parent_frame_id", Text()},
                 {"child_frame_id", Text()},
                 {"translation", VectorSchema()},
                 {"rotation", TurnSchema()}});
}

Json PoseInFrameSchema() {
  return Object({{"timestamp", TimeSchema("time")}, {"frame_id", Text()}, {"pose", PoseSchema()}});
}

Json SceneSchema() {
  const Json color = Object({{"r", Number()}, {"g", Number()}, {"b", Number()}, {"a", Number()}});
  const Json cube = Object({{"pose", PoseSchema()}, {"size", VectorSchema()}, {"color", color}});
  const Json nothing = List(Object(Json::object()));
  const Json entity = Object({{"timestamp", TimeSchema("time")},
                              {"frame_id", Text()},
                              {"id", Text()},
                              {"lifetime", TimeSchema("duration")},
                              {"frame_locked", {{"type", "boolean"}}},
                              {"metadata", nothing},
                              {"arrows", nothing},
                              {"cubes", List(cube)},
                              {"spheres", nothing},
                              {"cylinders", nothing},
                              {"lines", nothing},
                              {"triangles", nothing},
                              {"texts", nothing},
                              {"models", nothing}});
  return Object({{"deletions", nothing}, {"entities", List(entity)}});
}

Json MarkersSchema() {
  const Json marker = Object({{"family", Text()}, {"id", Integer()}});
  return Object({{"frame", Integer()},
                 {"timestamp_s", Number()},
                 {"markers", List(marker)},
                 {"lost", List(marker)}});
}

Json TimeJson(std::uint64_t ns) { return {{"sec", ns / kSecond}, {"nsec", ns % kSecond}}; }
Json VectorJson(Vec3 v) { return {{"x", v.x}, {"y", v.y}, {"z", v.z}}; }
Json TurnJson(const Quaternion& q) { return {{"x", q.x}, {"y", q.y}, {"z", q.z}, {"w", q.w}}; }

/// K as in ROS, which has the same pixel origin; distortion models named after its plug-ins.
Json CalibrationJson(const CameraModel& lens, std::uint64_t time_ns) {
  const bool fisheye = lens.distortion_model == DistortionModel::kEquidistant;
  const auto& k = lens.distortion;
  const bool rational = k[5] != 0.0 || k[6] != 0.0 || k[7] != 0.0;
  const std::size_t terms = fisheye ? 4 : (rational ? 8 : 5);
  const char* model = fisheye ? "kannala_brandt" : (rational ? "rational_polynomial" : "plumb_bob");
  return {{"timestamp", TimeJson(time_ns)},
          {"frame_id", kCamera},
          {"width", lens.width},
          {"height", lens.height},
          {"distortion_model", model},
          {"D", std::vector<double>(k.begin(), k.begin() + static_cast<std::ptrdiff_t>(terms))},
          {"K", {lens.fx, 0.0, lens.cx, 0.0, lens.fy, lens.cy, 0.0, 0.0, 1.0}},
          {"R", Mat3().m},
          {"P", {lens.fx, 0.0, lens.cx, 0.0, 0.0, lens.fy, lens.cy, 0.0, 0.0, 0.0, 1.0, 0.0}}};
}

Json SceneJson(const McapTrajectoryOptions& options, std::uint64_t time_ns) {
  const Json nothing = Json::array();
  const double size = options.marker_size_m;
  // The cube lies below the marker's surface.
  const Json pose{{"position", VectorJson({0, 0, -0.5 * kMarkerThickness_m})},
                  {"orientation", TurnJson({})}};
  const Json cube{{"pose", pose},
                  {"size", VectorJson({size, size, kMarkerThickness_m})},
                  {"color", {{"r", 0.1}, {"g", 0.1}, {"b", 0.1}, {"a", 1.0}}}};
  Json entity{
      {"timestamp", TimeJson(time_ns)}, {"frame_id", options.reference}, {"id", "marker"},
      {"lifetime", TimeJson(0)},        {"frame_locked", true},          {"metadata", nothing},
      {"cubes", Json::array({cube})}};
  for (const char* kind :
       {"arrows", "spheres", "cylinders", "lines", "triangles", "texts", "models"}) {
    entity[kind] = nothing;
  }
  return {{"deletions", nothing}, {"entities", Json::array({std::move(entity)})}};
}

}  // namespace

Result<std::string> McapFromTrajectory(const CameraTrajectory& path,
                                       const McapTrajectoryOptions& options) {
  std::int64_t first_ns = path.poses.empty() ? 0 : path.poses.front().timestamp_ns;
  if (!options.markers.empty()) {
    first_ns = path.poses.empty() ? options.markers.front().timestamp_ns
                                  : std::min(first_ns, options.markers.front().timestamp_ns);
  }
  if (first_ns + options.start_ns < 0) {
    return InputError("",
                      "an MCAP file has no times before 1970, but the trajectory begins earlier",
                      "shift its time stamps");
  }
  const auto time_of = [&](std::int64_t own) {
    return static_cast<std::uint64_t>(own + options.start_ns);
  };
  McapWriter writer;
  const auto channel = [&](const char* topic, const char* name, Json schema) {
    schema["title"] = name;
    return writer.AddChannel(topic, name, schema.dump());
  };
  const std::uint16_t transforms = channel("/tf", "foxglove.FrameTransform", TransformSchema());
  const std::uint16_t poses = channel("/camera/pose", "foxglove.PoseInFrame", PoseInFrameSchema());
  const std::uint64_t start = time_of(first_ns);
  if (path.camera) {
    const std::uint16_t lens =
        channel("/camera/calibration", "foxglove.CameraCalibration", CalibrationSchema());
    writer.AddMessage(lens, start, CalibrationJson(*path.camera, start).dump());
  }
  if (options.marker_size_m > 0.0) {
    const std::uint16_t scene = channel("/scene", "foxglove.SceneUpdate", SceneSchema());
    writer.AddMessage(scene, start, SceneJson(options, start).dump());
  }
  std::optional<std::uint16_t> markers;
  if (!options.markers.empty()) markers = channel("/markers", "pleinair.Markers", MarkersSchema());
  auto next = options.markers.begin();
  const auto add_markers_until = [&](std::int64_t own_ns) {
    for (; next != options.markers.end() && next->timestamp_ns <= own_ns; ++next) {
      writer.AddMessage(*markers, time_of(next->timestamp_ns), next->json);
    }
  };
  for (const TrajectoryPose& pose : path.poses) {
    add_markers_until(pose.timestamp_ns);
    const std::uint64_t time_ns = time_of(pose.timestamp_ns);
    const Json at = VectorJson(pose.reference_from_camera.translation_m);
    const Json turn = TurnJson(QuaternionOf(pose.reference_from_camera.rotation));
    const Json transform{{"timestamp", TimeJson(time_ns)},
                         {"parent_frame_id", options.reference},
                         {"child_frame_id", kCamera},
                         {"translation", at},
                         {"rotation", turn}};
    writer.AddMessage(transforms, time_ns, transform.dump());
    const Json placed{{"timestamp", TimeJson(time_ns)},
                      {"frame_id", options.reference},
                      {"pose", {{"position", at}, {"orientation", turn}}}};
    writer.AddMessage(poses, time_ns, placed.dump());
  }
  if (!options.markers.empty()) add_markers_until(options.markers.back().timestamp_ns);
  return writer.Finish();
}

}  // namespace pleinair::exports
