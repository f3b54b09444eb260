#include "export/trajectories/gltf_trajectory.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/little_endian.h"
#include "files/base64.h"

namespace pleinair::exports {
namespace {

// tinygltf's writer (2.7) is unsuitable. It writes `"zfar": 0` for a perspective camera without far
// plane, which glTF forbids (section 5.14). It has no 64-bit integers for the time stamp in
// `extras`.
using Json = nlohmann::ordered_json;

// glTF 2.0, sections 3.6.2, 5.1, 5.24: enumeration values.
constexpr int kFloat = 5126, kUnsignedByte = 5121;
constexpr int kPoints = 0, kTriangleStrip = 5;
constexpr int kArrayBuffer = 34962;
constexpr double kMinDistance_m = 0.01;

/// The scene's binary data with its JSON description.
class Buffer {
 public:
  /// Adds vectors of floats; returns the accessor's index.
  int AddFloats(const std::vector<float>& values, int components, bool vertices) {
    const char* types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    const std::size_t count = values.size() / components;
    Json minimum = Json::array(), maximum = Json::array();
    for (int c = 0; c < components; ++c) {
      float low = std::numeric_limits<float>::max(), high = -low;
      for (std::size_t i = 0; i < count; ++i) {
        low = std::min(low, values[i * components + c]);
        high = std::max(high, values[i * components + c]);
      }
      minimum.push_back(low);
      maximum.push_back(high);
    }
    BeginView(values.size() * sizeof(float), vertices);
    for (const float value : values) PutLittleEndian(value, &bytes_);
    return AddAccessor({{"bufferView", views_.size() - 1},
                        {"componentType", kFloat},
                        {"count", count},
                        {"type", types[components - 1]},
                        {"min", minimum},
                        {"max", maximum}});
  }

  /// Adds colors of four bytes, as vertex attributes.
  int AddColors(const std::string& rgba) {
    BeginView(rgba.size(), true);
    bytes_ += rgba;
    return AddAccessor({{"bufferView", views_.size() - 1},
                        {"componentType", kUnsignedByte},
                        {"normalized", true},
                        {"count", rgba.size() / 4},
                        {"type", "VEC4"}});
  }

  const std::string& bytes() const { return bytes_; }
  const Json& views() const { return views_; }
  const Json& accessors() const { return accessors_; }

 private:
  // All data are a multiple of four bytes long, so that every view is aligned.
  void BeginView(std::size_t length, bool vertices) {
    Json view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", length}};
    if (vertices) view["target"] = kArrayBuffer;
    views_.push_back(std::move(view));
  }
  int AddAccessor(Json accessor) {
    accessors_.push_back(std::move(accessor));
    return static_cast<int>(accessors_.size()) - 1;
  }

  std::string bytes_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

std::vector<float> Floats(std::initializer_list<Vec3> points) {
  std::vector<float> values;
  for (const Vec3 p : points) {
    for (const double c : {p.x, p.y, p.z}) values.push_back(static_cast<float>(c));
  }
  return values;
}

/// Keyframes of the camera's node.
struct Keyframes {
  std::vector<float> times_s, places, turns;
};

Keyframes KeyframesOf(const CameraTrajectory& path, const Transform<YUpScene, Reference>& scene) {
  Keyframes keys;
  Quaternion last{0, 0, 0, 0};
  for (const TrajectoryPose& pose : path.poses) {
    const Transform<YUpScene, GlCamera> node =
        scene * pose.reference_from_camera * kCameraFromGlCamera;
    keys.times_s.push_back(static_cast<float>(
        1e-9 * static_cast<double>(pose.timestamp_ns - path.poses.front().timestamp_ns)));
    Quaternion q = QuaternionOf(node.rotation);
    // Both signs are the same rotation; the nearer one gives the shorter interpolation.
    const float sign = Dot(q, last) < 0.0 ? -1.0F : 1.0F;
    if (sign < 0.0F) q = {-q.x, -q.y, -q.z, -q.w};
    last = q;
    const Vec3 t = node.translation_m;
    for (const double c : {t.x, t.y, t.z}) keys.places.push_back(static_cast<float>(c));
    for (const double c : {q.x, q.y, q.z, q.w}) keys.turns.push_back(static_cast<float>(c));
  }
  return keys;
}

Json LensJson(const CameraModel& lens, std::int64_t first_ns) {
  Json distortion = Json::array();
  for (const double k : lens.distortion) distortion.push_back(k);
  return {{"width", lens.width},
          {"height", lens.height},
          {"fx", lens.fx},
          {"fy", lens.fy},
          {"cx", lens.cx},
          {"cy", lens.cy},
          {"distortion_k1_k2_p1_p2_k3_k4_k5_k6", std::move(distortion)},
          {"first_timestamp_ns", first_ns}};
}

Json CameraJson(const CameraModel& lens, std::int64_t first_ns) {
  const double vertical = lens.height / lens.fy, horizontal = lens.width / lens.fx;
  return {{"name", "camera"},
          {"type", "perspective"},
          {"perspective",
           {{"yfov", 2.0 * std::atan(0.5 * vertical)},
            {"aspectRatio", horizontal / vertical},
            {"znear", kMinDistance_m}}},
          {"extras", {{"pleinair", LensJson(lens, first_ns)}}}};
}

/// Adds the marker's square, front up, and the points of a reconstruction.
void AddThings(const CameraTrajectory& path, const GltfTrajectoryOptions& options, Buffer* buffer,
               Json* gltf) {
  const Transform<YUpScene, Reference> scene = SceneFromReference(options.up);
  const auto add = [&](const char* name, Json primitive) {
    Json& meshes = (*gltf)["meshes"];
    meshes.push_back({{"name", name}, {"primitives", Json::array({std::move(primitive)})}});
    (*gltf)["nodes"].push_back({{"name", name}, {"mesh", meshes.size() - 1}});
    Json& nodes = (*gltf)["scenes"][0]["nodes"];
    nodes.push_back(nodes.size());
  };
  if (options.marker_size_m > 0.0) {
    const double h = 0.5 * options.marker_size_m;
    const auto corner = [&](double x, double y) {
      return (scene * Point<Reference>{{x, y, 0}}).xyz;
    };
    const Vec3 normal = (scene * Direction<Reference>{{0, 0, 1}}).xyz;
    const int places = buffer->AddFloats(
        Floats({corner(-h, h), corner(-h, -h), corner(h, h), corner(h, -h)}), 3, true);
    const int normals = buffer->AddFloats(Floats({normal, normal, normal, normal}), 3, true);
    add("marker",
        {{"attributes", {{"POSITION", places}, {"NORMAL", normals}}}, {"mode", kTriangleStrip}});
  }
  if (path.points.empty()) return;
  std::vector<float> places;
  std::string colors;
  for (const TrajectoryPoint& point : path.points) {
    const Vec3 p = (scene * point.place).xyz;
    for (const double c : {p.x, p.y, p.z}) places.push_back(static_cast<float>(c));
    for (const std::uint8_t code : point.rgb) colors += static_cast<char>(code);
    colors += '\xFF';
  }
  add("points",
      {{"attributes",
        {{"POSITION", buffer->AddFloats(places, 3, true)}, {"COLOR_0", buffer->AddColors(colors)}}},
       {"mode", kPoints}});
}

void AppendWord(std::size_t value, std::string* bytes) {
  PutLittleEndian(static_cast<std::uint32_t>(value), bytes);
}

/// glTF 2.0, section 4: header, JSON and binary chunk, each padded to four bytes.
std::string GlbOf(std::string json, const std::string& binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string glb = "glTF";
  AppendWord(2, &glb);
  AppendWord(12 + 8 + json.size() + 8 + binary.size(), &glb);
  AppendWord(json.size(), &glb);
  glb += "JSON" + json;
  AppendWord(binary.size(), &glb);
  glb += "BIN" + std::string(1, '\0') + binary;
  return glb;
}

}  // namespace

Result<std::string> GltfFromTrajectory(const CameraTrajectory& path,
                                       const GltfTrajectoryOptions& options) {
  if (!path.camera) {
    return InputError("",
                      "a glTF camera needs the camera's calibration, which the trajectory lacks",
                      "give it with --calibration");
  }
  if (path.camera->distortion_model == DistortionModel::kEquidistant) {
    return InputError("", "a glTF camera is perspective, but the lens is a fisheye",
                      "undistort the images and calibrate those");
  }
  Buffer buffer;
  const Keyframes keys = KeyframesOf(path, SceneFromReference(options.up));
  const int times = buffer.AddFloats(keys.times_s, 1, false);
  const int places = buffer.AddFloats(keys.places, 3, false);
  const int turns = buffer.AddFloats(keys.turns, 4, false);
  const auto channel = [](int sampler, const char* what) {
    return Json{{"sampler", sampler}, {"target", {{"node", 0}, {"path", what}}}};
  };
  const auto sampler = [&](int output) {
    return Json{{"input", times}, {"output", output}, {"interpolation", "LINEAR"}};
  };
  const auto first = [](const std::vector<float>& values, std::size_t count) {
    return std::vector<float>(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
  };
  Json gltf{{"asset", {{"version", "2.0"}, {"generator", "pleinair " PLEINAIR_VERSION}}},
            {"scene", 0},
            {"scenes", Json::array({Json{{"name", "pleinair"}, {"nodes", {0}}}})},
            {"nodes", Json::array({Json{{"name", "camera"},
                                        {"camera", 0},
                                        {"translation", first(keys.places, 3)},
                                        {"rotation", first(keys.turns, 4)}}})},
            {"cameras", Json::array({CameraJson(*path.camera, path.poses.front().timestamp_ns)})},
            {"animations",
             Json::array({Json{{"name", "camera path"},
                               {"channels", {channel(0, "translation"), channel(1, "rotation")}},
                               {"samplers", {sampler(places), sampler(turns)}}}})}};
  AddThings(path, options, &buffer, &gltf);
  gltf["accessors"] = buffer.accessors();
  gltf["bufferViews"] = buffer.views();
  Json data{{"byteLength", buffer.bytes().size()}};
  if (!options.binary) {
    data["uri"] = "data:application/octet-stream;base64," +
                  files::Base64({buffer.bytes().begin(), buffer.bytes().end()});
  }
  gltf["buffers"] = Json::array({std::move(data)});
  if (!options.binary) return gltf.dump(1) + "\n";
  return GlbOf(gltf.dump(), buffer.bytes());
}

}  // namespace pleinair::exports
