// The glTF 2.0 binary of draped lines, for drape_files.h.
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/drape/drape_files.h"
#include "base/little_endian.h"

namespace pleinair::app {
namespace {

using GltfJson = nlohmann::ordered_json;

// glTF 2.0, sections 3.6.2, 5.1, 5.24: enumeration values.
constexpr int kFloat = 5126, kUnsignedInt = 5125;
constexpr int kPoints = 0, kLines = 1;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;

/// Positions with what joins them.
struct LineMesh {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::uint32_t> lines, points;
};

LineMesh MeshOf(const DrapedMaps& maps, const Mat3& marker_from_world) {
  LineMesh mesh;
  for (const NumberedPiece& piece : NumberedPieces(maps)) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const content::DrapedVertex& vertex : piece.vertices()) {
      const Vec3 at = marker_from_world * vertex.at.xyz;
      mesh.positions.push_back(
          {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)});
    }
    const auto end = static_cast<std::uint32_t>(mesh.positions.size());
    if (end - first == 1) mesh.points.push_back(first);
    for (std::uint32_t i = first; i + 1 < end; ++i) {
      mesh.lines.push_back(i);
      mesh.lines.push_back(i + 1);
    }
  }
  return mesh;
}

GltfJson BoundOf(const LineMesh& mesh, bool largest) {
  GltfJson bound = GltfJson::array();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float value = mesh.positions.front()[axis];
    for (const auto& position : mesh.positions) {
      value = largest ? std::max(value, position[axis]) : std::min(value, position[axis]);
    }
    bound.push_back(value);
  }
  return bound;
}

std::string WordOf(std::size_t value) {
  std::string bytes;
  PutLittleEndian(static_cast<std::uint32_t>(value), &bytes);
  return bytes;
}

}  // namespace

std::string DrapeGlb(const DrapedMaps& maps, const Mat3& marker_from_world) {
  const LineMesh mesh = MeshOf(maps, marker_from_world);
  // A quarter turn about x, from z up to y up.
  const double half = std::sqrt(0.5);
  GltfJson gltf{{"asset", {{"version", "2.0"}, {"generator", "pleinair"}}}, {"scene", 0}};
  std::string binary;
  GltfJson primitives = GltfJson::array();
  if (!mesh.positions.empty()) {
    for (const auto& position : mesh.positions) {
      for (const float value : position) PutLittleEndian(value, &binary);
    }
    gltf["bufferViews"].push_back(
        {{"buffer", 0}, {"byteLength", binary.size()}, {"target", kArrayBuffer}});
    gltf["accessors"].push_back({{"bufferView", 0},
                                 {"componentType", kFloat},
                                 {"count", mesh.positions.size()},
                                 {"type", "VEC3"},
                                 {"min", BoundOf(mesh, false)},
                                 {"max", BoundOf(mesh, true)}});
    for (const auto& [indices, mode] :
         {std::pair(&mesh.lines, kLines), std::pair(&mesh.points, kPoints)}) {
      if (indices->empty()) continue;
      const std::size_t offset = binary.size();
      for (const std::uint32_t index : *indices) PutLittleEndian(index, &binary);
      gltf["bufferViews"].push_back({{"buffer", 0},
                                     {"byteOffset", offset},
                                     {"byteLength", binary.size() - offset},
                                     {"target", kElementArrayBuffer}});
      gltf["accessors"].push_back({{"bufferView", gltf["bufferViews"].size() - 1},
                                   {"componentType", kUnsignedInt},
                                   {"count", indices->size()},
                                   {"type", "SCALAR"}});
      primitives.push_back({{"attributes", {{"POSITION", 0}}},
                            {"indices", gltf["accessors"].size() - 1},
                            {"mode", mode}});
    }
    gltf["buffers"] = GltfJson::array({{{"byteLength", binary.size()}}});
    gltf["meshes"] = GltfJson::array({{{"name", "drape"}, {"primitives", primitives}}});
    gltf["nodes"] =
        GltfJson::array({{{"name", "drape"}, {"mesh", 0}, {"rotation", {-half, 0.0, 0.0, half}}}});
  }
  gltf["scenes"] = GltfJson::array({GltfJson::object()});
  if (!mesh.positions.empty()) gltf["scenes"][0]["nodes"] = {0};
  std::string json = gltf.dump();
  // Section 4: header, JSON and binary chunk, each padded to four bytes.
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t binary_chunk = binary.empty() ? 0 : 8 + binary.size();
  std::string glb = "glTF" + WordOf(2) + WordOf(12 + 8 + json.size() + binary_chunk) +
                    WordOf(json.size()) + "JSON" + json;
  if (!binary.empty()) glb += WordOf(binary.size()) + "BIN" + std::string(1, '\0') + binary;
  return glb;
}

}  // namespace pleinair::app
