#include "compositor/models/gltf_meshopt.h"

#include <tiny_gltf.h>

#include <cstddef>
#include <span>
#include <utility>

#include "compositor/models/gltf_accessor.h"
#include "compositor/models/gltf_error.h"
#include "compositor/models/model_limits.h"

#ifdef PLEINAIR_MESHOPT
#include <meshoptimizer.h>
#endif

namespace pleinair::compositor {

#ifdef PLEINAIR_MESHOPT
namespace {

// The codecs shrink data at most 64-fold; a larger claim comes from a damaged file.
constexpr std::size_t kMaxRatio = 128;

/// The extension's fields of a buffer view.
struct Stream {
  std::span<const unsigned char> bytes;
  std::size_t count = 0, stride = 0;
  std::string mode, filter;
};

tl::unexpected<Error> Damaged(const std::string& where, std::size_t view) {
  return GltfError(where, "the meshopt stream of buffer view " + std::to_string(view) +
                              " is cut short or damaged");
}

std::size_t SizeOf(const tinygltf::Value& value) {
  if (!value.IsNumber()) return 0;
  const double number = value.GetNumberAsDouble();
  return number >= 0.0 && number < 9e15 ? static_cast<std::size_t>(number) : 0;
}

Result<Stream> StreamOf(const std::string& where, const tinygltf::Model& gltf, std::size_t view,
                        const tinygltf::Value& extension) {
  const tinygltf::Value& buffer = GltfField(extension, "buffer");
  if (!buffer.IsInt() || !IsGltfIndex(buffer.GetNumberAsInt(), gltf.buffers.size())) {
    return GltfError(where, "buffer view " + std::to_string(view) +
                                " is compressed in a buffer that does not exist");
  }
  const auto& data = gltf.buffers[static_cast<std::size_t>(buffer.GetNumberAsInt())].data;
  const std::size_t offset = SizeOf(GltfField(extension, "byteOffset"));
  const std::size_t length = SizeOf(GltfField(extension, "byteLength"));
  if (offset > data.size() || length > data.size() - offset) return Damaged(where, view);
  Stream stream{std::span(data).subspan(offset, length), SizeOf(GltfField(extension, "count")),
                SizeOf(GltfField(extension, "byteStride")), "", "NONE"};
  if (GltfField(extension, "mode").IsString())
    stream.mode = GltfField(extension, "mode").Get<std::string>();
  if (GltfField(extension, "filter").IsString()) {
    stream.filter = GltfField(extension, "filter").Get<std::string>();
  }
  return stream;
}

/// Returns whether counts and sizes are what the decoders require.
bool IsSound(const Stream& stream) {
  if (stream.count == 0 || stream.count > kMaxTriangles * 3) return false;
  if (stream.mode == "ATTRIBUTES") {
    if (stream.stride == 0 || stream.stride % 4 != 0 || stream.stride > 256) return false;
  } else if (stream.stride != 2 && stream.stride != 4) {
    return false;
  }
  return stream.count * stream.stride <= kMaxRatio * stream.bytes.size();
}

bool Filter(const Stream& stream, unsigned char* data) {
  if (stream.filter == "OCTAHEDRAL") {
    if (stream.stride != 4 && stream.stride != 8) return false;
    meshopt_decodeFilterOct(data, stream.count, stream.stride);
  } else if (stream.filter == "QUATERNION") {
    if (stream.stride != 8) return false;
    meshopt_decodeFilterQuat(data, stream.count, stream.stride);
  } else if (stream.filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(data, stream.count, stream.stride);
  } else {
    return stream.filter == "NONE";
  }
  return true;
}

bool Decode(const Stream& stream, unsigned char* data) {
  const unsigned char* from = stream.bytes.data();
  const std::size_t size = stream.bytes.size();
  if (stream.mode == "ATTRIBUTES") {
    return meshopt_decodeVertexBuffer(data, stream.count, stream.stride, from, size) == 0 &&
           Filter(stream, data);
  }
  if (stream.mode == "TRIANGLES") {
    return stream.count % 3 == 0 &&
           meshopt_decodeIndexBuffer(data, stream.count, stream.stride, from, size) == 0;
  }
  return stream.mode == "INDICES" &&
         meshopt_decodeIndexSequence(data, stream.count, stream.stride, from, size) == 0;
}

}  // namespace

Result<void> DecompressMeshopt(const std::string& where, tinygltf::Model* gltf) {
  std::size_t total = 0;
  for (std::size_t i = 0; i < gltf->bufferViews.size(); ++i) {
    const auto found = gltf->bufferViews[i].extensions.find(kMeshoptExtension);
    if (found == gltf->bufferViews[i].extensions.end()) continue;
    PLEINAIR_ASSIGN_OR_RETURN(const Stream stream, StreamOf(where, *gltf, i, found->second));
    if (!IsSound(stream)) return Damaged(where, i);
    total += stream.count * stream.stride;
    if (total > kMaxDecodedBytes) return GltfError(where, "is larger than 2 GiB when decompressed");
    tinygltf::Buffer buffer;
    buffer.data.resize(stream.count * stream.stride);
    if (!Decode(stream, buffer.data.data())) return Damaged(where, i);
    tinygltf::BufferView& view = gltf->bufferViews[i];
    view.buffer = static_cast<int>(gltf->buffers.size());
    view.byteOffset = 0;
    view.byteLength = buffer.data.size();
    if (stream.mode == "ATTRIBUTES") view.byteStride = stream.stride;
    gltf->buffers.push_back(std::move(buffer));
  }
  return {};
}
#else
Result<void> DecompressMeshopt(const std::string&, tinygltf::Model*) { return {}; }
#endif

}  // namespace pleinair::compositor
