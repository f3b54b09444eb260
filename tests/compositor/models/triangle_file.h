#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "compositor/models/model.h"
#include "tests/compositor/models/model_files_made.h"

namespace pleinair::compositor::testing {

/// The bytes of values, one after the other.
template <typename T>
std::string Bytes(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// A textured triangle in one buffer: three corners, normals, texture coordinates, 16-bit indices.
/// Each test replaces the part that it wants to break.
struct TriangleFile {
  std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 2, 0};
  std::vector<float> uvs{0, 0, 1, 0, 0, 1};
  std::vector<std::uint16_t> indices{0, 1, 2};
  std::string picture = MakePng(1, 1, {{64, 128, 255}});
  std::string node = R"({"mesh":0})";
  std::string index_accessor = R"({"bufferView":2,"componentType":5123,"count":3,"type":"SCALAR"})";
  std::string position_accessor =
      R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,2,0]})";
  std::string extra;
  /// Additional JSON beside the material's roughness, beside its name, and after the attributes.
  std::string coat, alpha, attributes, color_texture = R"({"index":0})";
  std::string base = "0.5,0.25,1,0.75", metallic = "1";

  std::string Buffer() const {
    std::string buffer = Bytes(positions) + Bytes(uvs) + Bytes(indices);
    buffer.resize(68);  // The image starts at a multiple of four.
    return buffer + picture;
  }

  std::string Json(const std::string& buffer_uri) const {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + node +
           R"(],"meshes":[{"name":"leaf","primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1)" +
           attributes +
           R"(},)"
           R"("indices":2,"material":0}]}],"materials":[{"name":"green","doubleSided":true,)" +
           alpha + R"("pbrMetallicRoughness":{"baseColorFactor":[)" + base +
           R"(],"metallicFactor":)" + metallic + R"(,"roughnessFactor":0.3,)" + coat +
           R"("baseColorTexture":)" + color_texture +
           R"(}}],"textures":[{"source":0}],)"
           R"("images":[{"bufferView":3,"mimeType":"image/png"}],"accessors":[)" +
           position_accessor +
           R"(,{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"},)" + index_accessor +
           R"(],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,)"
           R"("byteLength":24},{"buffer":0,"byteOffset":60,"byteLength":6},{"buffer":0,)"
           R"("byteOffset":68,"byteLength":)" +
           std::to_string(picture.size()) + R"(}],"buffers":[{)" + buffer_uri + R"("byteLength":)" +
           std::to_string(Buffer().size()) + "}]" + extra + "}";
  }

  Result<Model> Load() const {
    const TemporaryFolder folder;
    folder.Write("data.bin", Buffer());
    return LoadModel(folder.Write("model.gltf", Json(R"("uri":"data.bin",)")));
  }

  std::string Glb() const {
    std::string json = Json("");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string buffer = Buffer();
    buffer.resize((buffer.size() + 3) / 4 * 4);
    const auto word = [](std::size_t value) {
      const auto number = static_cast<std::uint32_t>(value);
      return Bytes(std::vector<std::uint32_t>{number});
    };
    return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + buffer.size()) + word(json.size()) +
           "JSON" + json + word(buffer.size()) + std::string("BIN\0", 4) + buffer;
  }
};

/// The message with which a file is refused.
inline std::string ErrorOf(const TriangleFile& file) {
  const auto model = file.Load();
  EXPECT_FALSE(model);
  if (!model) {
    EXPECT_EQ(model.error().kind, ErrorKind::kInput);
  }
  return model ? "" : model.error().Message();
}

}  // namespace pleinair::compositor::testing
