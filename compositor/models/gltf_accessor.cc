#include "compositor/models/gltf_accessor.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "compositor/models/gltf_error.h"
#include "compositor/models/model_limits.h"

namespace pleinair::compositor {
namespace {

template <typename T>
T Load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

/// Reads one component. Normalised integers are scaled to 0…1 or −1…1 (glTF 2.0, 3.6.2.2).
double Component(const std::byte* from, int type, bool normalized) {
  const auto scaled = [normalized](double value, double maximum) {
    return normalized ? std::max(value / maximum, -1.0) : value;
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return scaled(Load<std::int8_t>(from), 127.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return scaled(Load<std::uint8_t>(from), 255.0);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return scaled(Load<std::int16_t>(from), 32767.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return scaled(Load<std::uint16_t>(from), 65535.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return Load<std::uint32_t>(from);
    default:
      return Load<float>(from);
  }
}

std::size_t ComponentSize(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

std::size_t ComponentCount(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    case TINYGLTF_TYPE_MAT4:
      return 16;
    default:
      return 0;
  }
}

/// `count` elements of `element_size` bytes at intervals of `stride`, all within `bytes`.
struct Elements {
  std::span<const std::byte> bytes;
  std::size_t stride = 0;
  const std::byte* At(std::size_t i) const { return bytes.data() + i * stride; }
};

Result<Elements> ElementsOf(const tinygltf::Model& gltf, int view, std::size_t offset,
                            std::size_t count, std::size_t element_size, const std::string& where) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::span<const std::byte> bytes,
                            GltfViewBytes(gltf, view, where));
  std::size_t stride = gltf.bufferViews[static_cast<std::size_t>(view)].byteStride;
  if (stride == 0) stride = element_size;
  // glTF 2.0, 5.11.4: strides are at most 252, so no product below can overflow.
  const bool fits = stride >= element_size && stride <= 252 && count <= kMaxVertices * 6 &&
                    offset <= bytes.size() && count > 0 &&
                    (count - 1) * stride + element_size <= bytes.size() - offset;
  if (!fits) return GltfError(where, "an accessor reaches beyond its buffer view");
  return Elements{bytes.subspan(offset), stride};
}

Result<void> CheckAccessor(const tinygltf::Model& gltf, int index, std::size_t components,
                           const std::string& where) {
  if (index < 0 || static_cast<std::size_t>(index) >= gltf.accessors.size()) {
    return GltfError(where, "refers to accessor " + std::to_string(index) + " of " +
                                std::to_string(gltf.accessors.size()));
  }
  const tinygltf::Accessor& accessor = gltf.accessors[static_cast<std::size_t>(index)];
  if (ComponentCount(accessor.type) != components || ComponentSize(accessor.componentType) == 0) {
    return GltfError(where, "accessor " + std::to_string(index) + " has another type than its use");
  }
  if (accessor.count > kMaxTriangles * 3) return GltfError(where, "an accessor is too large");
  return {};
}

/// All components of an accessor, one after the other.
Result<std::vector<double>> Components(const tinygltf::Model& gltf, int index,
                                       std::size_t components, const std::string& where) {
  PLEINAIR_RETURN_IF_ERROR(CheckAccessor(gltf, index, components, where));
  const tinygltf::Accessor& accessor = gltf.accessors[static_cast<std::size_t>(index)];
  const std::size_t size = ComponentSize(accessor.componentType);
  const auto copy = [&](const std::byte* from, double* to) {
    for (std::size_t c = 0; c < components; ++c) {
      to[c] = Component(from + c * size, accessor.componentType, accessor.normalized);
    }
  };
  std::vector<double> values;
  if (accessor.count == 0) return values;
  if (accessor.bufferView >= 0) {
    PLEINAIR_ASSIGN_OR_RETURN(const Elements elements,
                              ElementsOf(gltf, accessor.bufferView, accessor.byteOffset,
                                         accessor.count, components * size, where));
    values.resize(accessor.count * components);
    for (std::size_t i = 0; i < accessor.count; ++i) copy(elements.At(i), &values[i * components]);
  } else if (accessor.sparse.isSparse) {
    // No bytes of the file back these zeros: a count alone must not allocate gigabytes.
    if (accessor.count > std::min(kMaxVertices, kMaxVertices * 4 / components)) {
      return GltfError(where, "an accessor is too large");
    }
    values.resize(accessor.count * components);
  } else {
    return GltfError(where, "accessor " + std::to_string(index) + " has no data");
  }
  if (!accessor.sparse.isSparse) return values;

  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > accessor.count ||
      sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) {
    return GltfError(where, "a sparse accessor is out of range");
  }
  if (sparse.count == 0) return values;
  const auto count = static_cast<std::size_t>(sparse.count);
  const std::size_t index_size = ComponentSize(sparse.indices.componentType);
  if (index_size == 0 || sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) {
    return GltfError(where, "a sparse accessor's indices are not integers");
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      const Elements indices,
      ElementsOf(gltf, sparse.indices.bufferView,
                 static_cast<std::size_t>(sparse.indices.byteOffset), count, index_size, where));
  PLEINAIR_ASSIGN_OR_RETURN(
      const Elements replacements,
      ElementsOf(gltf, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
                 count, components * size, where));
  for (std::size_t i = 0; i < count; ++i) {
    const double at = Component(indices.At(i), sparse.indices.componentType, false);
    if (at < 0.0 || at >= static_cast<double>(accessor.count)) {
      return GltfError(where, "a sparse accessor is out of range");
    }
    copy(replacements.At(i), &values[static_cast<std::size_t>(at) * components]);
  }
  return values;
}

}  // namespace

const tinygltf::Value& GltfField(const tinygltf::Value& value, const char* key) {
  static const tinygltf::Value kNull;
  return value.IsObject() ? value.Get(key) : kNull;
}

Result<std::span<const std::byte>> GltfViewBytes(const tinygltf::Model& gltf, int view_index,
                                                 const std::string& where) {
  if (view_index < 0 || static_cast<std::size_t>(view_index) >= gltf.bufferViews.size()) {
    return GltfError(where, "refers to a buffer view that does not exist");
  }
  const tinygltf::BufferView& view = gltf.bufferViews[static_cast<std::size_t>(view_index)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= gltf.buffers.size()) {
    return GltfError(where, "refers to a buffer that does not exist");
  }
  const std::vector<unsigned char>& data = gltf.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
    return GltfError(where, "a buffer view reaches beyond its buffer");
  }
  return std::as_bytes(std::span(data)).subspan(view.byteOffset, view.byteLength);
}

template <std::size_t N>
Result<std::vector<std::array<float, N>>> ReadGltfFloats(const tinygltf::Model& gltf, int accessor,
                                                         const std::string& where) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<double> values, Components(gltf, accessor, N, where));
  if (values.size() / N > kMaxVertices) {
    return GltfError(where, "has more than 20 million vertices");
  }
  std::vector<std::array<float, N>> elements(values.size() / N);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]) || std::fabs(values[i]) > 1e8) {
      return GltfError(where, "accessor " + std::to_string(accessor) +
                                  " has a value that is not a finite number below 1e8");
    }
    elements[i / N][i % N] = static_cast<float>(values[i]);
  }
  return elements;
}

template Result<std::vector<std::array<float, 2>>> ReadGltfFloats<2>(const tinygltf::Model&, int,
                                                                     const std::string&);
template Result<std::vector<std::array<float, 3>>> ReadGltfFloats<3>(const tinygltf::Model&, int,
                                                                     const std::string&);

template Result<std::vector<std::array<float, 4>>> ReadGltfFloats<4>(const tinygltf::Model&, int,
                                                                     const std::string&);
template Result<std::vector<std::array<float, 1>>> ReadGltfFloats<1>(const tinygltf::Model&, int,
                                                                     const std::string&);
template Result<std::vector<std::array<float, 16>>> ReadGltfFloats<16>(const tinygltf::Model&, int,
                                                                       const std::string&);

Result<std::vector<std::array<float, 4>>> ReadGltfColors(const tinygltf::Model& gltf, int accessor,
                                                         const std::string& where) {
  std::vector<std::array<float, 4>> colors;
  const bool is_rgb = accessor >= 0 && static_cast<std::size_t>(accessor) < gltf.accessors.size() &&
                      gltf.accessors[static_cast<std::size_t>(accessor)].type == TINYGLTF_TYPE_VEC3;
  if (is_rgb) {
    PLEINAIR_ASSIGN_OR_RETURN(const auto rgb, ReadGltfFloats<3>(gltf, accessor, where));
    colors.reserve(rgb.size());
    for (const auto& [r, g, b] : rgb) colors.push_back({r, g, b, 1.0F});
  } else {
    PLEINAIR_ASSIGN_OR_RETURN(colors, ReadGltfFloats<4>(gltf, accessor, where));
  }
  for (auto& color : colors) {
    for (float& value : color) value = std::clamp(value, 0.0F, 1.0F);
  }
  return colors;
}

Result<std::vector<std::uint32_t>> ReadGltfIndices(const tinygltf::Model& gltf, int accessor,
                                                   const std::string& where) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<double> values, Components(gltf, accessor, 1, where));
  std::vector<std::uint32_t> indices;
  indices.reserve(values.size());
  for (const double value : values) {
    if (!(value >= 0.0 && value < 4294967295.0)) {
      return GltfError(where, "an index is out of range");
    }
    indices.push_back(static_cast<std::uint32_t>(value));
  }
  return indices;
}

}  // namespace pleinair::compositor
