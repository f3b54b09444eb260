#include "compositor/models/gltf_texture_transform.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pleinair::compositor {
namespace {

constexpr float kMaxUv = 1e8F;

}  // namespace

std::array<float, 2> UvMap::operator()(const std::array<float, 2>& uv) const {
  const double c = std::cos(rotation_rad), s = std::sin(rotation_rad);
  const double u = scale[0] * uv[0], v = scale[1] * uv[1];
  // Values that are too large and NaN become infinite, hence out of reach.
  const auto narrowed = [](double value) {
    return std::fabs(value) <= kMaxUv ? static_cast<float>(value)
                                      : std::numeric_limits<float>::infinity();
  };
  return {narrowed(offset[0] + c * u + s * v), narrowed(offset[1] - s * u + c * v)};
}

UvMap UvMapOf(const tinygltf::TextureInfo& texture) {
  UvMap map;
  map.set = texture.texCoord;
  const auto found = texture.extensions.find("KHR_texture_transform");
  if (found == texture.extensions.end()) return map;
  const tinygltf::Value& transform = found->second;
  const auto pair = [&](const char* key, std::array<double, 2>* numbers) {
    const tinygltf::Value& value = transform.Get(key);
    if (!value.IsArray() || value.ArrayLen() != 2) return;
    for (int i : {0, 1}) {
      if (value.Get(i).IsNumber()) (*numbers)[i] = value.Get(i).GetNumberAsDouble();
    }
  };
  pair("offset", &map.offset);
  pair("scale", &map.scale);
  if (const auto& value = transform.Get("rotation"); value.IsNumber()) {
    map.rotation_rad = value.GetNumberAsDouble();
  }
  if (const auto& value = transform.Get("texCoord"); value.IsInt()) {
    map.set = value.GetNumberAsInt();
  }
  return map;
}

bool IsWithinReach(const std::array<float, 2>& uv) {
  return std::ranges::all_of(uv, [](float value) { return std::fabs(value) <= kMaxUv; });
}

}  // namespace pleinair::compositor
