#include "compositor/models/gltf_draco.h"

#include <tiny_gltf.h>

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
#include "compositor/models/gltf_value.h"
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

constexpr const char* kExtension = "KHR_draco_mesh_compression";
// Components of an attribute: colors and joints have four.
constexpr std::size_t kMaxComponents = 4;

tl::unexpected<Error> Damaged(const std::string& where, const std::string& cause) {
  return GltfError(where, "a Draco stream is cut short or damaged (" + cause + ")");
}

/// Adds a buffer with a view of it, and returns the view's index.
template <typename T>
int AddView(const std::vector<T>& values, tinygltf::Model* gltf) {
  tinygltf::Buffer buffer;
  buffer.data.resize(values.size() * sizeof(T));
  std::memcpy(buffer.data.data(), values.data(), buffer.data.size());
  tinygltf::BufferView view;
  view.buffer = static_cast<int>(gltf->buffers.size());
  view.byteLength = buffer.data.size();
  gltf->buffers.push_back(std::move(buffer));
  gltf->bufferViews.push_back(std::move(view));
  return static_cast<int>(gltf->bufferViews.size()) - 1;
}

std::size_t ComponentsOf(int accessor_type) {
  const int components =
      tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor_type));
  return components > 0 ? static_cast<std::size_t>(components) : 0;
}

/// Makes an accessor refer to a decoded attribute of the mesh.
Result<void> Replace(const std::string& where, const draco::Mesh& mesh, int unique_id, int index,
                     tinygltf::Model* gltf) {
  if (!IsGltfIndex(index, gltf->accessors.size())) {
    return GltfError(where, "refers to an accessor that does not exist");
  }
  const draco::PointAttribute* attribute =
      unique_id < 0 ? nullptr : mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(unique_id));
  const std::size_t components =
      ComponentsOf(gltf->accessors[static_cast<std::size_t>(index)].type);
  if (attribute == nullptr || components == 0 || components > kMaxComponents ||
      static_cast<std::size_t>(attribute->num_components()) != components) {
    return Damaged(where, "it lacks an attribute");
  }
  std::vector<float> values(std::size_t{mesh.num_points()} * components);
  std::array<float, kMaxComponents> value{};
  for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
    const draco::AttributeValueIndex mapped = attribute->mapped_index(draco::PointIndex(i));
    if (mapped.value() >= attribute->size() ||
        !attribute->ConvertValue(mapped, static_cast<std::int8_t>(components), value.data())) {
      return Damaged(where, "an attribute");
    }
    std::copy_n(value.begin(), components,
                values.begin() + static_cast<std::ptrdiff_t>(i * components));
  }
  const int view = AddView(values, gltf);
  tinygltf::Accessor& accessor = gltf->accessors[static_cast<std::size_t>(index)];
  accessor.bufferView = view;
  accessor.byteOffset = 0;
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.normalized = false;
  accessor.count = mesh.num_points();
  accessor.sparse.isSparse = false;
  return {};
}

Result<void> ReplaceIndices(const std::string& where, const draco::Mesh& mesh, int index,
                            tinygltf::Model* gltf) {
  if (!IsGltfIndex(index, gltf->accessors.size())) {
    return GltfError(where, "a Draco primitive has no indices");
  }
  std::vector<std::uint32_t> indices;
  indices.reserve(std::size_t{mesh.num_faces()} * 3);
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
    for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(i))) {
      indices.push_back(corner.value());
    }
  }
  const int view = AddView(indices, gltf);
  tinygltf::Accessor& accessor = gltf->accessors[static_cast<std::size_t>(index)];
  accessor.bufferView = view;
  accessor.byteOffset = 0;
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  accessor.normalized = false;
  accessor.count = indices.size();
  accessor.sparse.isSparse = false;
  return {};
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

Result<void> DecompressPrimitive(const std::string& where, const tinygltf::Primitive& primitive,
                                 const tinygltf::Value& extension, tinygltf::Model* gltf) {
  const tinygltf::Value& view = GltfField(extension, "bufferView");
  PLEINAIR_ASSIGN_OR_RETURN(const std::span<const std::byte> bytes,
                            GltfViewBytes(*gltf, view.IsInt() ? view.GetNumberAsInt() : -1, where));
  PLEINAIR_ASSIGN_OR_RETURN(const std::unique_ptr<draco::Mesh> mesh, Decode(where, bytes));
  const tinygltf::Value& ids = GltfField(extension, "attributes");
  for (const auto& [name, accessor] : primitive.attributes) {
    if (!ids.Has(name)) continue;
    const tinygltf::Value& id = GltfField(ids, name.c_str());
    PLEINAIR_RETURN_IF_ERROR(
        Replace(where, *mesh, id.IsInt() ? id.GetNumberAsInt() : -1, accessor, gltf));
  }
  return ReplaceIndices(where, *mesh, primitive.indices, gltf);
}

}  // namespace

Result<void> DecompressDraco(const std::string& where, tinygltf::Model* gltf) {
  std::size_t points = 0;
  for (std::size_t m = 0; m < gltf->meshes.size(); ++m) {
    for (const tinygltf::Primitive& primitive : gltf->meshes[m].primitives) {
      const auto found = primitive.extensions.find(kExtension);
      if (found == primitive.extensions.end()) continue;
      PLEINAIR_RETURN_IF_ERROR(DecompressPrimitive(where, primitive, found->second, gltf));
      const auto position = primitive.attributes.find("POSITION");
      if (position == primitive.attributes.end()) continue;
      points += gltf->accessors[static_cast<std::size_t>(position->second)].count;
      if (points > kMaxVertices) return GltfError(where, "has more than 20 million vertices");
    }
  }
  return {};
}
#else
Result<void> DecompressDraco(const std::string&, tinygltf::Model*) { return {}; }
#endif

}  // namespace pleinair::compositor
