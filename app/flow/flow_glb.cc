#include "app/flow/flow_glb.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/flow/speed_colors.h"
#include "base/little_endian.h"

namespace pleinair::app {
namespace {

using nlohmann::ordered_json;

// glTF 2.0, sections 3.6.2, 5.1, 5.24: enumeration values.
constexpr int kGlFloat = 5126, kGlUnsignedInt = 5125, kGlUnsignedByte = 5121, kGlLines = 1;
constexpr int kGlArrayBuffer = 34962, kGlElementBuffer = 34963;

void PadTo4(char with, std::string* bytes) { bytes->resize((bytes->size() + 3) / 4 * 4, with); }

}  // namespace

std::string FlowGlb(const FlowLines& lines) {
  constexpr double kFar = std::numeric_limits<double>::max();
  Vec3 low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
  for (const auto& points : lines.points) {
    for (const Vec3& p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  const Vec3 middle = lines.points.empty() ? Vec3{} : (low + high) * 0.5;
  const SpeedColors colors(lines);
  std::string positions, rgba, indices;
  std::array<float, 3> least{}, most{};
  std::uint32_t number = 0;
  std::size_t index_count = 0;
  for (std::size_t i = 0; i < lines.points.size(); ++i) {
    for (std::size_t n = 0; n < lines.points[i].size(); ++n, ++number) {
      const Vec3 off = lines.points[i][n] - middle;
      const std::array<float, 3> p{static_cast<float>(off.x), static_cast<float>(off.z),
                                   static_cast<float>(-off.y)};
      for (std::size_t c = 0; c < 3; ++c) {
        least[c] = number == 0 ? p[c] : std::min(least[c], p[c]);
        most[c] = number == 0 ? p[c] : std::max(most[c], p[c]);
        PutLittleEndian(p[c], &positions);
      }
      const auto color = colors.Linear8(lines.lines[i].speeds_m_s[n]);
      for (const std::uint8_t channel : color) rgba += static_cast<char>(channel);
      rgba += static_cast<char>(255);
      if (n == 0) continue;
      PutLittleEndian(number - 1, &indices);
      PutLittleEndian(number, &indices);
      index_count += 2;
    }
  }
  const std::string bytes = positions + rgba + indices;
  const auto view = [](std::size_t offset, std::size_t length, int target) {
    return ordered_json{
        {"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}, {"target", target}};
  };
  ordered_json gltf = {{"asset", {{"version", "2.0"}, {"generator", "pleinair flow"}}},
                       {"scene", 0}};
  if (number == 0) {
    gltf["scenes"] = {{{"name", "flow"}}};
  } else {
    gltf["scenes"] = {{{"nodes", {0}}}};
    gltf["nodes"] = {
        {{"name", "flow"}, {"mesh", 0}, {"translation", {middle.x, middle.z, -middle.y}}}};
    gltf["meshes"] = {{{"primitives",
                        {{{"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}},
                          {"indices", 2},
                          {"mode", kGlLines}}}}}};
    gltf["buffers"] = {{{"byteLength", bytes.size()}}};
    gltf["bufferViews"] = {view(0, positions.size(), kGlArrayBuffer),
                           view(positions.size(), rgba.size(), kGlArrayBuffer),
                           view(positions.size() + rgba.size(), indices.size(), kGlElementBuffer)};
    gltf["accessors"] = {{{"bufferView", 0},
                          {"componentType", kGlFloat},
                          {"count", number},
                          {"type", "VEC3"},
                          {"min", least},
                          {"max", most}},
                         {{"bufferView", 1},
                          {"componentType", kGlUnsignedByte},
                          {"normalized", true},
                          {"count", number},
                          {"type", "VEC4"}},
                         {{"bufferView", 2},
                          {"componentType", kGlUnsignedInt},
                          {"count", index_count},
                          {"type", "SCALAR"}}};
  }
  std::string json = gltf.dump(), binary = bytes;
  PadTo4(' ', &json);
  PadTo4('\0', &binary);
  std::string glb = "glTF";
  PutLittleEndian(std::uint32_t{2}, &glb);
  const std::size_t binary_chunk = binary.empty() ? 0 : 8 + binary.size();
  PutLittleEndian(static_cast<std::uint32_t>(12 + 8 + json.size() + binary_chunk), &glb);
  PutLittleEndian(static_cast<std::uint32_t>(json.size()), &glb);
  glb += "JSON" + json;
  if (!binary.empty()) {
    PutLittleEndian(static_cast<std::uint32_t>(binary.size()), &glb);
    glb += std::string("BIN\0", 4) + binary;
  }
  return glb;
}

}  // namespace pleinair::app
