#include "compositor/models/gltf_draco.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "compositor/models/gltf_accessor.h"
#include "compositor/models/gltf_error.h"
#include "compositor/models/model_limits.h"

#ifdef PLEINAIR_DRACO
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#endif
#include <draco/compression/decode.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
#endif

namespace pleinair::compositor {

#ifdef PLEINAIR_DRACO
namespace {

// Components of an attribute: colors and joints have four.
constexpr std::size_t kMaxComponents = 4;

tl::unexpected<Error> Damaged(const std::string& where, const std::string& cause) {
  return GltfError(where, "a Draco stream is cut short or damaged (" + cause + ")");
}

std::size_t ComponentsOf(int accessor_type) {
  const int components =
      tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor_type));
  return components > 0 ? static_cast<std::size_t>(components) : 0;
}

Result<std::unique_ptr<draco::Mesh>> Decode(const std::string& where,
                                            std::span<const std::byte> bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return Damaged(where, decoded.status().error_msg_string());
  std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  if (mesh->num_points() > kMaxVertices || mesh->num_faces() > kMaxTriangles) {
    return GltfError(where, "has more than 20 million vertices");
  }
  return mesh;
}

/// Replaces the accessors of primitives by the content of their streams, within the limits of a
/// file.
class Decompression {
 public:
  Decompression(const std::string& where, tinygltf::Model* gltf) : where_(where), gltf_(*gltf) {}

  Result<void> Decompress(const tinygltf::Primitive& primitive, const tinygltf::Value& extension) {
    const tinygltf::Value& view = GltfField(extension, "bufferView");
    PLEINAIR_ASSIGN_OR_RETURN(
        const std::span<const std::byte> bytes,
        GltfViewBytes(gltf_, view.IsInt() ? view.GetNumberAsInt() : -1, where_));
    PLEINAIR_ASSIGN_OR_RETURN(const std::unique_ptr<draco::Mesh> mesh, Decode(where_, bytes));
    points_ += mesh->num_points();
    if (points_ > kMaxVertices) return GltfError(where_, "has more than 20 million vertices");
    const tinygltf::Value& ids = GltfField(extension, "attributes");
    for (const auto& [name, accessor] : primitive.attributes) {
      const tinygltf::Value& id = GltfField(ids, name.c_str());
      if (id.Type() == tinygltf::NULL_TYPE) continue;
      PLEINAIR_RETURN_IF_ERROR(Replace(*mesh, id.IsInt() ? id.GetNumberAsInt() : -1, accessor));
    }
    return ReplaceIndices(*mesh, primitive.indices);
  }

 private:
  /// Makes an accessor refer to a decoded attribute of the mesh.
  Result<void> Replace(const draco::Mesh& mesh, int unique_id, int index) {
    if (!IsGltfIndex(index, gltf_.accessors.size())) {
      return GltfError(where_, "refers to an accessor that does not exist");
    }
    const draco::PointAttribute* attribute =
        unique_id < 0 ? nullptr
                      : mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(unique_id));
    const std::size_t components =
        ComponentsOf(gltf_.accessors[static_cast<std::size_t>(index)].type);
    if (attribute == nullptr || components == 0 || components > kMaxComponents ||
        static_cast<std::size_t>(attribute->num_components()) != components) {
      return Damaged(where_, "it lacks an attribute");
    }
    PLEINAIR_RETURN_IF_ERROR(Claim(std::size_t{mesh.num_points()} * components * sizeof(float)));
    std::vector<float> values(std::size_t{mesh.num_points()} * components);
    std::array<float, kMaxComponents> value{};
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
      const draco::AttributeValueIndex mapped = attribute->mapped_index(draco::PointIndex(i));
      if (mapped.value() >= attribute->size() ||
          !attribute->ConvertValue(mapped, static_cast<std::int8_t>(components), value.data())) {
        return Damaged(where_, "an attribute");
      }
      std::copy_n(value.begin(), components,
                  values.begin() + static_cast<std::ptrdiff_t>(i * components));
    }
    Refer(index, values, TINYGLTF_COMPONENT_TYPE_FLOAT, mesh.num_points());
    return {};
  }

  Result<void> ReplaceIndices(const draco::Mesh& mesh, int index) {
    if (!IsGltfIndex(index, gltf_.accessors.size())) {
      return GltfError(where_, "a Draco primitive has no indices");
    }
    PLEINAIR_RETURN_IF_ERROR(Claim(std::size_t{mesh.num_faces()} * 3 * sizeof(std::uint32_t)));
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t{mesh.num_faces()} * 3);
    for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
      for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(i))) {
        indices.push_back(corner.value());
      }
    }
    Refer(index, indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, indices.size());
    return {};
  }

  /// Counts bytes before they are allocated.
  Result<void> Claim(std::size_t bytes) {
    bytes_ += bytes;
    if (bytes_ <= kMaxDecodedBytes) return {};
    return GltfError(where_, "is larger than 2 GiB when decompressed");
  }

  /// Makes an accessor refer to `count` elements in a buffer of their own.
  template <typename T>
  void Refer(int index, const std::vector<T>& values, int component_type, std::size_t count) {
    tinygltf::Buffer buffer;
    buffer.data.resize(values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(buffer.data.data(), values.data(), buffer.data.size());
    tinygltf::BufferView view;
    view.buffer = static_cast<int>(gltf_.buffers.size());
    view.byteLength = buffer.data.size();
    gltf_.buffers.push_back(std::move(buffer));
    gltf_.bufferViews.push_back(std::move(view));
    tinygltf::Accessor& accessor = gltf_.accessors[static_cast<std::size_t>(index)];
    accessor.bufferView = static_cast<int>(gltf_.bufferViews.size()) - 1;
    accessor.byteOffset = 0;
    accessor.componentType = component_type;
    accessor.normalized = false;
    accessor.count = count;
    accessor.sparse.isSparse = false;
  }

  const std::string& where_;
  tinygltf::Model& gltf_;
  std::size_t points_ = 0, bytes_ = 0;  ///< Decoded, over all primitives.
};

}  // namespace

Result<void> DecompressDraco(const std::string& where, tinygltf::Model* gltf) {
  Decompression decompression(where, gltf);
  for (const tinygltf::Mesh& mesh : gltf->meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const auto found = primitive.extensions.find(kDracoExtension);
      if (found == primitive.extensions.end()) continue;
      PLEINAIR_RETURN_IF_ERROR(decompression.Decompress(primitive, found->second));
    }
  }
  return {};
}
#else
Result<void> DecompressDraco(const std::string&, tinygltf::Model*) { return {}; }
#endif

}  // namespace pleinair::compositor
