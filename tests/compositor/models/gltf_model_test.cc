#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>

#include "compositor/models/model.h"
#include "compositor/models/model_files.h"
#include "tests/compositor/models/model_files_made.h"
#include "tests/compositor/models/triangle_file.h"

namespace pleinair::compositor {
namespace {

using testing::ErrorOf;
using ::testing::HasSubstr;
using testing::PngHeader;
using testing::TemporaryFolder;
using testing::TriangleFile;

TEST(GltfModel, ReadsGeometryMaterialAndTexture) {
  const auto model = TriangleFile().Load();
  ASSERT_TRUE(model) << model.error().Message();
  ASSERT_EQ(model->meshes.size(), 1U);
  const Mesh& mesh = model->meshes[0];
  EXPECT_EQ(mesh.name, "leaf");
  ASSERT_EQ(mesh.indices.size(), 3U);
  // y up becomes z up: (0, 2, 0) points up.
  EXPECT_EQ(mesh.positions[mesh.indices[2]], (std::array<float, 3>{0.0F, 0.0F, 2.0F}));
  EXPECT_EQ(mesh.uvs[mesh.indices[2]], (std::array<float, 2>{0.0F, 1.0F}));
  // The front faced +z in the file, which is −y here.
  EXPECT_EQ(mesh.normals[0], (std::array<float, 3>{0.0F, -1.0F, 0.0F}));
  const Material& material = model->materials[mesh.material];
  EXPECT_EQ(material.name, "green");
  EXPECT_EQ(material.base_color, (std::array<float, 3>{0.5F, 0.25F, 1.0F}));
  EXPECT_FLOAT_EQ(material.roughness, 0.3F);
  EXPECT_FLOAT_EQ(material.coat.f0, 0.04F);
  ASSERT_EQ(material.base_color_texture, 0);
  EXPECT_EQ(model->textures[0](0, 0, 1), 128);
}

TEST(GltfModel, ReadsTheBinaryForm) {
  const TemporaryFolder folder;
  const auto model = LoadModel(folder.Write("model.glb", TriangleFile().Glb()));
  ASSERT_TRUE(model) << model.error().Message();
  EXPECT_EQ(model->meshes[0].positions.size(), 3U);
}

TEST(GltfModel, RefusesBinaryFilesCutAnywhere) {
  const TemporaryFolder folder;
  const std::string whole = TriangleFile().Glb();
  for (std::size_t length = 0; length + 4 < whole.size(); length += 7) {
    EXPECT_FALSE(LoadModel(folder.Write("model.glb", whole.substr(0, length)))) << length;
  }
}

TEST(GltfModel, PlacesNodesInsideNodes) {
  TriangleFile file;
  file.node =
      R"({"children":[1],"translation":[10,0,0]},{"mesh":0,"scale":[-1,1,1],"translation":[0,5,0]})";
  const auto model = file.Load();
  ASSERT_TRUE(model) << model.error().Message();
  const Mesh& mesh = model->meshes[0];
  EXPECT_EQ(mesh.positions[0], (std::array<float, 3>{10.0F, 0.0F, 5.0F}));
  // Mirroring reverses the winding: the front still faces the file's +z.
  EXPECT_EQ(mesh.normals[0], (std::array<float, 3>{0.0F, -1.0F, 0.0F}));
}

TEST(GltfModel, PutsSparseValuesIn) {
  TriangleFile file;
  file.position_accessor =
      R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,)"
      R"("indices":{"bufferView":2,"byteOffset":4,"componentType":5123},)"
      R"("values":{"bufferView":0,"byteOffset":12}}})";
  file.positions = {0, 0, 0, 1, 0, 0, 9, 9, 9};  // Vertex 2 becomes a copy of vertex 1.
  EXPECT_THAT(ErrorOf(file), HasSubstr("degenerate"));
  file.position_accessor.replace(file.position_accessor.find("\"byteOffset\":4"), 14,
                                 "\"byteOffset\":6");
  EXPECT_FALSE(file.Load()) << "the sparse indices reach beyond their view";
}

TEST(GltfModel, RefusesReferencesOutOfRange) {
  TriangleFile file;
  file.indices = {0, 1, 3};
  EXPECT_THAT(ErrorOf(file), HasSubstr("vertex 3 of 3"));
  file = {};
  file.position_accessor.replace(file.position_accessor.find("\"count\":3"), 9, "\"count\":4");
  EXPECT_THAT(ErrorOf(file), HasSubstr("beyond"));
  file = {};
  file.index_accessor = R"({"bufferView":2,"componentType":5125,"count":3,"type":"SCALAR"})";
  EXPECT_THAT(ErrorOf(file), HasSubstr("beyond"));
  file = {};
  file.index_accessor = R"({"bufferView":9,"componentType":5123,"count":3,"type":"SCALAR"})";
  EXPECT_FALSE(file.Load());
  file = {};
  file.position_accessor =
      R"({"bufferView":0,"componentType":5126,"count":18446744073709551615,"type":"VEC3"})";
  EXPECT_FALSE(file.Load());
  file = {};
  file.node = R"({"mesh":7})";
  EXPECT_FALSE(file.Load());
}

TEST(GltfModel, RefusesNodesThatContainThemselves) {
  TriangleFile file;
  file.node = R"({"mesh":0,"children":[1]},{"children":[0]})";
  EXPECT_THAT(ErrorOf(file), HasSubstr("contains itself"));
}

TEST(GltfModel, RefusesValuesThatAreNotFinite) {
  TriangleFile file;
  file.positions[4] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(ErrorOf(file), HasSubstr("not a finite number"));
}

TEST(GltfModel, RefusesHugeAndMissingTexturesAndBuffers) {
  TriangleFile file;
  file.picture = PngHeader(100'000, 100'000);
  EXPECT_THAT(ErrorOf(file), HasSubstr("100000 × 100000"));
  const TemporaryFolder folder;
  EXPECT_FALSE(LoadModel(folder.Write("m.gltf", TriangleFile().Json(R"("uri":"gone.bin",)"))));
  folder.Write("data.bin", TriangleFile().Buffer());
  std::string json = TriangleFile().Json(R"("uri":"data.bin",)");
  const std::string image = R"({"bufferView":3,"mimeType":"image/png"})";
  json.replace(json.find(image), image.size(), R"({"uri":"gone.png"})");
  const auto model = LoadModel(folder.Write("m.gltf", json));
  ASSERT_FALSE(model);
  EXPECT_THAT(model.error().Message(), HasSubstr("gone.png"));
}

TEST(GltfModel, ReadsOnlyFilesAndOnlyFromItsFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "inner");
  for (const char* uri : {R"("uri":".",)", R"("uri":"inner",)", R"("uri":"/dev/zero",)"}) {
    EXPECT_FALSE(LoadModel(folder.Write("m.gltf", TriangleFile().Json(uri)))) << uri;
  }
  // A file of that name in the working folder does not belong to the model.
  const TemporaryFolder working;
  working.Write("data.bin", TriangleFile().Buffer());
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(working.path());
  EXPECT_FALSE(LoadModel(folder.Write("m.gltf", TriangleFile().Json(R"("uri":"data.bin",)"))));
  working.Write("m.gltf", TriangleFile().Json(R"("uri":"data.bin",)"));
  EXPECT_TRUE(LoadModel("m.gltf"));
  std::filesystem::current_path(before);
}

TEST(GltfModel, TakesNamesFromItsFolderButNoAbsoluteOnes) {
  const TemporaryFolder folder;
  const std::filesystem::path inner = folder.path() / "inner";
  std::filesystem::create_directory(inner);
  const std::filesystem::path data = folder.Write("data.bin", TriangleFile().Buffer());
  const auto write = [&](const std::string& uri) {
    const std::string json = TriangleFile().Json(R"("uri":")" + uri + R"(",)");
    folder.Write("m.gltf", json);
    folder.Write("inner/m.gltf", json);
  };
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  // glTF 2.0, "URIs": relative paths, which may contain ".." and be percent-encoded.
  std::filesystem::create_symlink(data, inner / "link.bin");
  for (const char* uri : {"../data.bin", "%2e%2e/data.bin", "link.bin"}) {
    write(uri);
    for (const std::filesystem::path& model :
         {inner / "m.gltf", std::filesystem::path("inner/m.gltf")}) {
      const auto refused = LoadModel(model);
      ASSERT_FALSE(refused) << uri;
      EXPECT_THAT(refused.error().Message(), HasSubstr("lies outside the folder of the model"));
      AllowFilesOutsideModels(true);
      EXPECT_TRUE(LoadModel(model)) << uri;
      AllowFilesOutsideModels(false);
    }
  }
  write("inner/../data.bin");
  EXPECT_TRUE(LoadModel("m.gltf"));
  // The file exists, and so does one of that name outside the folder.
  for (const std::string& uri : {data.string(), std::string("/data.bin")}) {
    write(uri);
    EXPECT_FALSE(LoadModel(folder.path() / "m.gltf")) << uri;
    EXPECT_FALSE(LoadModel("m.gltf")) << uri;
    EXPECT_FALSE(LoadModel("./m.gltf")) << uri;
  }
  std::filesystem::current_path(before);
}

TEST(GltfModel, RefusesValuesThatTheLoaderPassesOver) {
  const auto refused = [](const char* from, const char* to) {
    const TriangleFile file;
    const TemporaryFolder folder;
    folder.Write("data.bin", file.Buffer());
    std::string json = file.Json(R"("uri":"data.bin",)");
    json.replace(json.find(from), std::string(from).size(), to);
    const auto model = LoadModel(folder.Write("m.gltf", json));
    return model ? std::string("no error") : model.error().Message();
  };
  EXPECT_EQ(refused("2.0", "2.0"), "no error");
  EXPECT_THAT(refused("2.0", "9.9"), HasSubstr("is of glTF version 9.9; this program reads 2.0"));
  EXPECT_THAT(refused(R"("version":"2.0")", R"("version":"2.1","minVersion":"2.1")"),
              HasSubstr("version 2.1"));
  EXPECT_THAT(refused(R"("scene":0)", R"("scene":99)"), HasSubstr("its scene 99 of 1"));
  EXPECT_THAT(refused(R"("material":0)", R"("material":-5)"), HasSubstr("below zero"));
  EXPECT_THAT(refused(R"({"mesh":0})", R"({"mesh":0,"matrix":[1]})"),
              HasSubstr("node 0: has a matrix of 1 numbers, not 16"));
  EXPECT_THAT(refused(R"({"mesh":0})", R"({"mesh":0,"rotation":[0,0,0,0]})"),
              HasSubstr("quaternion is zero"));
  EXPECT_THAT(refused("data.bin", R"(data.bin\u0000x)"), HasSubstr("NUL"));
}

TEST(GltfModel, RefusesExtensionsThatItWouldHaveToKnow) {
  TriangleFile file;
  file.extra = R"(,"extensionsUsed":["KHR_texture_basisu"],)"
               R"("extensionsRequired":["KHR_texture_basisu"])";
  EXPECT_THAT(ErrorOf(file), HasSubstr("KHR_texture_basisu"));
}

}  // namespace
}  // namespace pleinair::compositor
