#include "compositor/models/gltf_texture_transform.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "compositor/models/gltf_accessor.h"

namespace pleinair::compositor {
namespace {

constexpr float kMaxUv = 1e8F;
constexpr const char* kTransformExtension = "KHR_texture_transform";

using Matrix = std::array<double, 4>;  // Row-major.

Matrix MatrixOf(const UvMap& map) {
  const double c = std::cos(map.rotation_rad), s = std::sin(map.rotation_rad);
  return {c * map.scale[0], s * map.scale[1], -s * map.scale[0], c * map.scale[1]};
}

TextureCoordinates Narrowed(const Matrix& matrix, double offset_u, double offset_v) {
  TextureCoordinates coordinates;
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    coordinates.matrix[i] = static_cast<float>(matrix[i]);
  }
  coordinates.offset = {static_cast<float>(offset_u), static_cast<float>(offset_v)};
  return coordinates;
}

/// The map from the result of `first` to that of `map`. Nothing if it is not finite.
std::optional<TextureCoordinates> Relative(const UvMap& map, const UvMap& first) {
  const Matrix a = MatrixOf(map), b = MatrixOf(first);
  const double det = b[0] * b[3] - b[1] * b[2];
  const Matrix inverse{b[3] / det, -b[1] / det, -b[2] / det, b[0] / det};
  const Matrix product{a[0] * inverse[0] + a[1] * inverse[2], a[0] * inverse[1] + a[1] * inverse[3],
                       a[2] * inverse[0] + a[3] * inverse[2],
                       a[2] * inverse[1] + a[3] * inverse[3]};
  const double u = map.offset[0] - product[0] * first.offset[0] - product[1] * first.offset[1];
  const double v = map.offset[1] - product[2] * first.offset[0] - product[3] * first.offset[1];
  const auto is_usable = [](double value) { return std::fabs(value) <= kMaxUv; };
  if (!std::ranges::all_of(product, is_usable) || !is_usable(u) || !is_usable(v)) return {};
  return Narrowed(product, u, v);
}

UvMap Transformed(int set, const tinygltf::ExtensionMap& extensions) {
  UvMap map;
  map.set = set;
  const auto found = extensions.find(kTransformExtension);
  if (found == extensions.end()) return map;
  const tinygltf::Value& transform = found->second;
  const auto pair = [&](const char* key, std::array<double, 2>* numbers) {
    const tinygltf::Value& value = GltfField(transform, key);
    if (!value.IsArray() || value.ArrayLen() != 2) return;
    for (int i : {0, 1}) {
      if (value.Get(i).IsNumber()) (*numbers)[i] = value.Get(i).GetNumberAsDouble();
    }
  };
  pair("offset", &map.offset);
  pair("scale", &map.scale);
  if (const auto& value = GltfField(transform, "rotation"); value.IsNumber()) {
    map.rotation_rad = value.GetNumberAsDouble();
  }
  if (const auto& value = GltfField(transform, "texCoord"); value.IsInt()) {
    map.set = value.GetNumberAsInt();
  }
  return map;
}

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

tinygltf::TextureInfo TextureInfoOf(const tinygltf::Value& texture) {
  tinygltf::TextureInfo info;
  if (const auto& index = GltfField(texture, "index"); index.IsInt()) {
    info.index = index.GetNumberAsInt();
  }
  if (const auto& set = GltfField(texture, "texCoord"); set.IsInt()) {
    info.texCoord = set.GetNumberAsInt();
  }
  const auto& extensions = GltfField(texture, "extensions");
  if (extensions.IsObject() && extensions.Has(kTransformExtension)) {
    info.extensions[kTransformExtension] = extensions.Get(kTransformExtension);
  }
  return info;
}

UvMap UvMapOf(const tinygltf::TextureInfo& texture) {
  return Transformed(texture.texCoord, texture.extensions);
}

UvMap UvMapOf(const tinygltf::NormalTextureInfo& texture) {
  return Transformed(texture.texCoord, texture.extensions);
}

std::optional<TextureCoordinates> CoordinatesIn(MaterialUvs* uvs, const UvMap& map) {
  if (map == uvs->first) return TextureCoordinates{};
  if (map.set == uvs->first.set) {
    if (auto relative = Relative(map, uvs->first)) return relative;
  }
  if (uvs->second_set && *uvs->second_set != map.set) return {};
  auto own = Relative(map, UvMap{});
  if (!own) return {};
  uvs->second_set = map.set;
  own->second_set = true;
  return own;
}

bool IsWithinReach(const std::array<float, 2>& uv) {
  return std::ranges::all_of(uv, [](float value) { return std::fabs(value) <= kMaxUv; });
}

}  // namespace pleinair::compositor
