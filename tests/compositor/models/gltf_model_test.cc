#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include "compositor/models/gltf_texture_transform.h"
#include "compositor/models/model.h"
#include "tests/compositor/models/model_files_made.h"

namespace pleinair::compositor {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::MakePng;
using testing::PngHeader;
using testing::TemporaryFolder;

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

std::string ErrorOf(const TriangleFile& file) {
  const auto model = file.Load();
  EXPECT_FALSE(model);
  if (!model) {
    EXPECT_EQ(model.error().kind, ErrorKind::kInput);
  }
  return model ? "" : model.error().Message();
}

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

TEST(GltfModel, ReadsWhatAlphaMeans) {
  TriangleFile file;
  const auto material = [&] { return file.Load()->materials[0]; };
  EXPECT_EQ(material().alpha, Material::Alpha::kIgnored);
  file.alpha = R"("alphaMode":"MASK","alphaCutoff":0.25,)";
  EXPECT_EQ(material().alpha, Material::Alpha::kCutout);
  EXPECT_FLOAT_EQ(material().alpha_cutoff, 0.25F);
  file.alpha = R"("alphaMode":"BLEND",)";
  EXPECT_EQ(material().alpha, Material::Alpha::kBlended);
  EXPECT_FLOAT_EQ(material().opacity, 0.75F);
}

TEST(GltfModel, SeesNothingOfWhatIsCutOutWholly) {
  TriangleFile file;
  file.alpha = R"("alphaMode":"MASK","alphaCutoff":1.5,)";
  file.color_texture = R"({"index":0}, "baseColorFactor":[1,1,1,1])";
  EXPECT_THAT(ErrorOf(file), HasSubstr("transparent"));
  file.alpha = R"("alphaMode":"MASK","alphaCutoff":1,)";
  EXPECT_TRUE(file.Load());
}

TEST(GltfModel, ReadsTexturesOfRoughnessAndMetallic) {
  TriangleFile file;
  file.coat = R"("metallicRoughnessTexture":{"index":0},)";
  auto model = file.Load();
  ASSERT_TRUE(model) << model.error().Message();
  const Material& material = model->materials[0];
  // One image, read as color and as data.
  ASSERT_EQ(model->textures.size(), 2U);
  EXPECT_NE(material.metallic_roughness_texture, material.base_color_texture);
  EXPECT_FLOAT_EQ(material.metallic, 1.0F);
  EXPECT_FLOAT_EQ(material.roughness, 0.3F);
  // With texture coordinates of a third set the texture is replaced by its mean.
  file.coat = R"("metallicRoughnessTexture":{"index":0,"texCoord":1},)";
  model = file.Load();
  ASSERT_TRUE(model);
  EXPECT_TRUE(model->materials[0].detail.metallic_roughness_coordinates.second_set);
  file.alpha = R"("normalTexture":{"index":0,"texCoord":2},)";
  EXPECT_THAT(UnsupportedFeatures(*file.Load()), ElementsAre("a third set of texture coordinates"));
  file.alpha.clear();
  file.coat = R"("metallicRoughnessTexture":{"index":0,"extensions":{"KHR_texture_transform":)"
              R"({"scale":[1e30,1e30]}}},)";
  model = file.Load();
  ASSERT_TRUE(model);
  EXPECT_EQ(model->materials[0].metallic_roughness_texture, -1);
  EXPECT_FLOAT_EQ(model->materials[0].roughness, 0.3F * 128 / 255);
  EXPECT_EQ(model->textures.size(), 1U) << "the picture is kept though nothing is drawn with it";
}

TEST(GltfModel, ReportsWhatItLeavesOut) {
  TriangleFile file;
  EXPECT_THAT(UnsupportedFeatures(*file.Load()), IsEmpty());
  file.alpha = R"("extensions":{"KHR_materials_iridescence":{}},)";
  EXPECT_THAT(UnsupportedFeatures(*file.Load()), ElementsAre("KHR_materials_iridescence"));
  file = {};
  file.extra = R"(,"animations":[{"channels":[],"samplers":[]}])";
  EXPECT_THAT(UnsupportedFeatures(*file.Load()), ElementsAre("animations"));
  // No primitive uses this material.
  file = {};
  file.color_texture = R"({"index":0}}},{"emissiveFactor":[1,1,1],"pbrMetallicRoughness":{)"
                       R"("metallicFactor":1)";
  EXPECT_THAT(UnsupportedFeatures(*file.Load()), IsEmpty());
}

TEST(GltfModel, ReadsNormalMapEmissionColorsOfVerticesAndUnlitMaterials) {
  TriangleFile file;
  file.alpha = R"("normalTexture":{"index":0,"scale":0.5,"extensions":{"KHR_texture_transform":)"
               R"({"offset":[0.25,0],"scale":[2,4]}}},"emissiveTexture":{"index":0,"texCoord":1},)"
               R"("emissiveFactor":[0,1,0.5],"extensions":{"KHR_materials_emissive_strength":)"
               R"({"emissiveStrength":3000},"KHR_materials_unlit":{}},)";
  file.attributes = R"(,"COLOR_0":0,"TEXCOORD_1":1)";
  file.positions = {0.5, 0, 0, 1, 0.25, 0, 0, 2, 0};
  const auto model = file.Load();
  ASSERT_TRUE(model) << model.error().Message();
  EXPECT_THAT(UnsupportedFeatures(*model), IsEmpty());
  const Mesh& mesh = model->meshes[0];
  const MaterialDetail& detail = model->materials[static_cast<std::size_t>(mesh.material)].detail;
  EXPECT_EQ(detail.emission.luminance_cd_m2, (std::array<float, 3>{0.0F, 3000.0F, 1500.0F}));
  EXPECT_TRUE(detail.emission.coordinates.second_set);
  EXPECT_TRUE(detail.unlit);
  EXPECT_EQ(detail.normal_map.scale, 0.5F);
  EXPECT_FALSE(detail.normal_map.coordinates.second_set);
  EXPECT_EQ(detail.normal_map.coordinates.matrix, (std::array<float, 4>{2, 0, 0, 4}));
  EXPECT_EQ(detail.normal_map.coordinates.offset, (std::array<float, 2>{0.25F, 0.0F}));
  EXPECT_NE(detail.normal_map.texture, detail.emission.texture) << "linear and sRGB";
  ASSERT_EQ(mesh.details.size(), 3U);
  EXPECT_EQ(mesh.details[0].color, (std::array<float, 4>{0.5F, 0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(mesh.details[1].color, (std::array<float, 4>{1.0F, 0.25F, 0.0F, 1.0F}));
  EXPECT_EQ(mesh.details[1].uv, (std::array<float, 2>{1.0F, 0.0F}));
}

TEST(GltfModel, ReadsLayersAndTransmission) {
  TriangleFile file;
  file.picture = MakePng(1, 1, {{102, 51, 255}});
  file.alpha =
      R"("extensions":{"KHR_materials_ior":{"ior":2.0},"KHR_materials_specular":)"
      R"({"specularFactor":0.5,"specularColorFactor":[1,0.5,0.25]},"KHR_materials_clearcoat":)"
      R"({"clearcoatFactor":0.5,"clearcoatTexture":{"index":0},"clearcoatRoughnessFactor":0.25},)"
      R"("KHR_materials_sheen":{"sheenColorFactor":[0,0.5,1],"sheenRoughnessFactor":0.75}},)";
  auto model = file.Load();
  ASSERT_TRUE(model) << model.error().Message();
  EXPECT_THAT(UnsupportedFeatures(*model), IsEmpty());
  const Material* material = &model->materials[0];
  EXPECT_NEAR(material->coat.f0, 0.5 / 9.0, 1e-6);
  EXPECT_EQ(material->detail.layers.coat_tint, (std::array<float, 3>{1, 0.5F, 0.25F}));
  EXPECT_NEAR(material->detail.layers.clearcoat, 0.5 * 0.4, 1e-6);
  EXPECT_EQ(material->detail.layers.clearcoat_roughness, 0.25F);
  EXPECT_EQ(material->detail.layers.sheen_color, (std::array<float, 3>{0, 0.5F, 1}));
  EXPECT_EQ(material->detail.layers.sheen_roughness, 0.75F);
  // A pane of clear glass: 8 % of it, its reflections, remain.
  file.alpha = R"("extensions":{"KHR_materials_transmission":{"transmissionFactor":1}},)";
  file.coat = R"("metallicRoughnessTexture":{"index":0},)";
  file.base = "1,1,1,0.5";
  file.metallic = "0";
  model = file.Load();
  ASSERT_TRUE(model) << model.error().Message();
  material = &model->materials[0];
  EXPECT_EQ(material->alpha, Material::Alpha::kBlended);
  EXPECT_NEAR(material->opacity, 0.08, 1e-6) << "without alphaMode, alpha does not count";
  // Metal transmits nothing.
  file.metallic = "1";
  EXPECT_EQ(file.Load()->materials[0].alpha, Material::Alpha::kIgnored);
}

TEST(GltfModel, ExpressesOneMapOfTextureCoordinatesByAnother) {
  MaterialUvs uvs{{0, {0.5, 0.25}, {2.0, 3.0}, 0.3}, {}};
  const UvMap other{0, {-1.0, 2.0}, {0.5, 4.0}, -1.1};
  const auto coordinates = CoordinatesIn(&uvs, other);
  ASSERT_TRUE(coordinates);
  EXPECT_FALSE(uvs.second_set);
  const std::array<float, 2> uv{0.7F, -0.2F};
  const auto [u, v] = uvs.first(uv);
  const auto expected = other(uv);
  const auto& m = coordinates->matrix;
  EXPECT_NEAR(m[0] * u + m[1] * v + coordinates->offset[0], expected[0], 1e-5);
  EXPECT_NEAR(m[2] * u + m[3] * v + coordinates->offset[1], expected[1], 1e-5);
  // One further set, and no third.
  EXPECT_TRUE(CoordinatesIn(&uvs, {.set = 1})->second_set);
  EXPECT_FALSE(CoordinatesIn(&uvs, {.set = 2}));
  // A map that flattens its coordinates has no inverse: the same set is read again.
  MaterialUvs flat{{0, {0.0, 0.0}, {0.0, 1.0}, 0.0}, {}};
  EXPECT_TRUE(CoordinatesIn(&flat, {})->second_set);
}

TEST(GltfModel, MovesTextureCoordinatesAsTheFileAsks) {
  TriangleFile file;
  file.extra = R"(,"extensionsUsed":["KHR_texture_transform"],)"
               R"("extensionsRequired":["KHR_texture_transform"])";
  file.color_texture = R"({"index":0,"extensions":{"KHR_texture_transform":{)"
                       R"("offset":[0.5,1],"scale":[2,3],"rotation":1.5707963267948966}}})";
  const auto model = file.Load();
  ASSERT_TRUE(model) << model.error().Message();
  const Mesh& mesh = model->meshes[0];
  // By the extension's text and example, a quarter turn maps (u, v) to (v, −u). The matrix printed
  // there turns the other way.
  EXPECT_NEAR(mesh.uvs[mesh.indices[1]][0], 0.5, 1e-6);
  EXPECT_NEAR(mesh.uvs[mesh.indices[1]][1], 1.0 - 2.0, 1e-6);
  EXPECT_NEAR(mesh.uvs[mesh.indices[2]][0], 0.5 + 3.0, 1e-6);
  EXPECT_NEAR(mesh.uvs[mesh.indices[2]][1], 1.0, 1e-6);
}

TEST(GltfModel, RefusesToMoveTextureCoordinatesOutOfTheWorld) {
  TriangleFile file;
  file.extra = R"(,"extensionsUsed":["KHR_texture_transform"])";
  file.color_texture = R"({"index":0,"extensions":{"KHR_texture_transform":{)"
                       R"("scale":[1e308,1e308],"rotation":0.5}}})";
  const auto model = file.Load();
  ASSERT_FALSE(model);
  EXPECT_NE(model.error().Message().find("KHR_texture_transform"), std::string::npos)
      << model.error().Message();
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
  // glTF 2.0, "URIs": relative paths, which may contain "..".
  write("../data.bin");
  EXPECT_TRUE(LoadModel(inner / "m.gltf"));
  EXPECT_TRUE(LoadModel("inner/m.gltf"));
  std::filesystem::current_path(inner);
  EXPECT_TRUE(LoadModel("m.gltf"));
  std::filesystem::current_path(folder.path());
  // The file exists, and so does one of that name outside the folder.
  for (const std::string& uri : {data.string(), std::string("/data.bin")}) {
    write(uri);
    EXPECT_FALSE(LoadModel(folder.path() / "m.gltf")) << uri;
    EXPECT_FALSE(LoadModel("m.gltf")) << uri;
    EXPECT_FALSE(LoadModel("./m.gltf")) << uri;
  }
  std::filesystem::current_path(before);
}

TEST(GltfModel, RefusesExtensionsThatItWouldHaveToKnow) {
  TriangleFile file;
  file.extra = R"(,"extensionsUsed":["KHR_texture_basisu"],)"
               R"("extensionsRequired":["KHR_texture_basisu"])";
  EXPECT_THAT(ErrorOf(file), HasSubstr("KHR_texture_basisu"));
}

}  // namespace
}  // namespace pleinair::compositor
