// Files whose geometry or textures are compressed. The streams were written by the encoders of
// meshoptimizer 0.18, Draco 1.5 and libwebp 1.2.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "compositor/models/model.h"
#include "compositor/models/texture_decoder.h"
#include "tests/compositor/models/model_files_made.h"

namespace pleinair::compositor {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

/// A stream as base64, with its length.
struct Stream {
  std::string base64;
  int bytes = 0;
};

const Stream kVertices{
    "oAEYAAAAATwAAAD+/QEEAAAAAQwAAAD+AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA", 60};
const Stream kTriangle{"4PAAdodWZ3iphmWJaJgBaQAA", 18};
const Stream kNormals{"oAEMAAAAbAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAH8A", 42};
const Stream kDraco{
    "RFJBQ08CAgEBAAAAAwEBAQAAAQf/AREBAQAC/wAAAAAAAQAJAwAAAgEDCQIAAQIBAQEADAdVFR+tKgP1b4H/BwAA/h8A"
    "ACAAAAAA/wcAAAAAAAAAAAAAAAAAAAAAAEALAQEBAAMDVRWtKgMEcIEZAgAAAAD/AwAAAAAAAAAAAAAAAIA/Cg==",
    133};

std::string Buffer(const Stream& stream) {
  return R"({"byteLength":)" + std::to_string(stream.bytes) +
         R"(,"uri":"data:application/octet-stream;base64,)" + stream.base64 + R"("})";
}

/// A buffer view with a stream of `count` elements of `stride` bytes.
std::string View(int buffer, const Stream& stream, int stride, const std::string& mode) {
  return R"({"buffer":3,"byteLength":)" + std::to_string(3 * stride) +
         R"(,"extensions":{"EXT_meshopt_compression":{"buffer":)" + std::to_string(buffer) +
         R"(,"byteLength":)" + std::to_string(stream.bytes) + R"(,"byteStride":)" +
         std::to_string(stride) + R"(,"count":3,)" + mode + "}}}";
}

/// A triangle with quantized corners (0, 0, 0), (1, 0, 0) and (0, 1, 0). Its normals are in
/// octahedral form. The views' own buffer has no data.
std::string MeshoptFile(const Stream& vertices = kVertices,
                        const std::string& vertex_mode = R"("mode":"ATTRIBUTES")") {
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["EXT_meshopt_compression",)"
         R"("KHR_mesh_quantization"],"extensionsRequired":["EXT_meshopt_compression",)"
         R"("KHR_mesh_quantization"],"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":)"
         R"([{"primitives":[{"attributes":{"POSITION":0,"NORMAL":2},"indices":1}]}],"accessors":)"
         R"([{"bufferView":0,"componentType":5122,"normalized":true,"count":3,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"},{"bufferView":2,)"
         R"("componentType":5120,"normalized":true,"count":3,"type":"VEC3"}],"bufferViews":[)" +
         View(0, vertices, 8, vertex_mode) + "," + View(1, kTriangle, 2, R"("mode":"TRIANGLES")") +
         "," + View(2, kNormals, 4, R"("mode":"ATTRIBUTES","filter":"OCTAHEDRAL")") +
         R"(],"buffers":[)" + Buffer(vertices) + "," + Buffer(kTriangle) + "," + Buffer(kNormals) +
         R"(,{"byteLength":42,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}]})";
}

std::string DracoFile(const Stream& stream = kDraco, int position_id = 0) {
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_draco_mesh_compression"],)"
         R"("extensionsRequired":["KHR_draco_mesh_compression"],"scenes":[{"nodes":[0]}],"nodes":)"
         R"([{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2},)"
         R"("indices":1,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":)"
         R"({"POSITION":)" +
         std::to_string(position_id) +
         R"(,"TEXCOORD_0":1}}}}]}],"accessors":[{"componentType":5126,"count":3,"type":"VEC3"},)"
         R"({"componentType":5123,"count":3,"type":"SCALAR"},{"componentType":5126,"count":3,)"
         R"("type":"VEC2"}],"bufferViews":[{"buffer":0,"byteLength":)" +
         std::to_string(stream.bytes) + R"(}],"buffers":[)" + Buffer(stream) + "]}";
}

Result<Model> Load(const std::string& text) {
  const TemporaryFolder folder;
  return LoadModel(folder.Write("model.gltf", text));
}

std::string ErrorOf(const std::string& text) {
  const auto model = Load(text);
  EXPECT_FALSE(model);
  return model ? "" : model.error().Message();
}

/// A stream without its last `bytes`, a multiple of three.
Stream CutShort(const Stream& stream, int bytes) {
  const std::size_t padding = stream.base64.size() - (stream.base64.find_last_not_of('=') + 1);
  Stream cut{
      stream.base64.substr(0, stream.base64.size() - static_cast<std::size_t>(bytes / 3 * 4)),
      stream.bytes - bytes};
  if (bytes > 0) cut.bytes += static_cast<int>(padding);
  return cut;
}

TEST(CompressedModel, ReadsMeshoptWithQuantizedAttributes) {
  const auto model = Load(MeshoptFile());
  ASSERT_TRUE(model) << model.error().Message();
  const Mesh& mesh = model->meshes[0];
  ASSERT_EQ(mesh.indices.size(), 3U);
  std::array<std::array<float, 3>, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = mesh.positions[mesh.indices[i]];
  // Some rotation of the corners; y up became z up.
  const std::array<float, 3> origin{0, 0, 0}, x{1, 0, 0}, up{0, 0, 1};
  EXPECT_THAT(corners, ::testing::UnorderedElementsAre(origin, x, up));
  EXPECT_NEAR(mesh.normals[0][1], -1.0, 1e-6);
}

TEST(CompressedModel, ReadsTheBinaryFormWithAFallbackBuffer) {
  std::string json = MeshoptFile();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
  };
  const std::string glb =
      "glTF" + word(2) + word(20 + json.size()) + word(json.size()) + "JSON" + json;
  const TemporaryFolder folder;
  const auto model = LoadModel(folder.Write("model.glb", glb));
  ASSERT_TRUE(model) << model.error().Message();
  EXPECT_EQ(model->meshes[0].indices.size(), 3U);
}

TEST(CompressedModel, RefusesDamagedMeshopt) {
  for (int bytes = 3; bytes < kVertices.bytes; bytes += 3) {
    EXPECT_THAT(ErrorOf(MeshoptFile(CutShort(kVertices, bytes))),
                HasSubstr("meshopt stream of buffer view 0 is cut short or damaged"));
  }
  EXPECT_THAT(ErrorOf(MeshoptFile(kVertices, R"("mode":"TRIANGLES")")), HasSubstr("damaged"));
  EXPECT_THAT(ErrorOf(MeshoptFile(kVertices, R"("mode":7)")), HasSubstr("damaged"));
  EXPECT_THAT(ErrorOf(MeshoptFile(kVertices, R"("mode":"ATTRIBUTES","filter":"NEW")")),
              HasSubstr("damaged"));
  std::string many = MeshoptFile();
  many.replace(many.find(R"("count":3,"mode")"), 9, R"("count":90000000)");
  EXPECT_THAT(ErrorOf(many), HasSubstr("damaged")) << "it must not allocate";
  std::string elsewhere = MeshoptFile();
  elsewhere.replace(elsewhere.find(R"(compression":{"buffer":0)"), 24,
                    R"(compression":{"buffer":9)");
  EXPECT_THAT(ErrorOf(elsewhere), HasSubstr("does not exist"));
}

TEST(CompressedModel, ReadsDraco) {
  const auto model = Load(DracoFile());
  ASSERT_TRUE(model) << model.error().Message();
  const Mesh& mesh = model->meshes[0];
  ASSERT_EQ(mesh.indices.size(), 3U);
  for (const std::uint32_t index : mesh.indices) {
    // Texture coordinates are those of the corners (0, 0, 0), (1, 0, 0) and, y up, (0, 2, 0).
    EXPECT_NEAR(mesh.positions[index][0], mesh.uvs[index][0], 2e-3);
    EXPECT_NEAR(mesh.positions[index][2], 2.0F * mesh.uvs[index][1], 2e-3);
  }
  const ModelBounds box = BoundsOf(*model);
  EXPECT_NEAR(box.max_m.z, 2.0, 2e-3);
}

TEST(CompressedModel, RefusesDamagedDraco) {
  for (int bytes = 6; bytes < kDraco.bytes - 6; bytes += 9) {
    EXPECT_THAT(ErrorOf(DracoFile(CutShort(kDraco, bytes))), HasSubstr("model.gltf")) << bytes;
  }
  EXPECT_THAT(ErrorOf(DracoFile(kDraco, 5)), HasSubstr("lacks an attribute"));
  EXPECT_THAT(ErrorOf(DracoFile(kDraco, 1)), HasSubstr("lacks an attribute"))
      << "it has two numbers";
}

TEST(CompressedModel, DecodesWebp) {
  // 2 × 2 pixels, lossless: (10, 200, 30) and (255, 0, 128), twice.
  const std::string webp(
      "RIFF\x22\0\0\0WEBPVP8L\x16\0\0\0\x2f\x01\x40\0\0\x0f\x70\x1c\xe4\x2b\xd4\xdf\x43\x6c\xfe\x23"
      "\x0d\x15\x88\xe8\x7f\0",
      42);
  const auto decode = [](std::string_view bytes) {
    return DecodeTexture(std::as_bytes(std::span(bytes)), "leaf.webp");
  };
  const auto image = decode(webp);
  ASSERT_TRUE(image) << image.error().Message();
  EXPECT_EQ(image->width(), 2);
  EXPECT_EQ(image->channels(), 3);
  EXPECT_EQ((*image)(0, 1, 1), 200);
  EXPECT_EQ((*image)(1, 0, 2), 128);
  for (std::size_t size = 12; size + 2 < webp.size(); ++size) {
    const auto cut = decode(std::string_view(webp).substr(0, size));
    ASSERT_FALSE(cut) << size;
    EXPECT_THAT(cut.error().Message(), HasSubstr("leaf.webp"));
  }
}

}  // namespace
}  // namespace pleinair::compositor
