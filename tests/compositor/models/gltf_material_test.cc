#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "compositor/models/gltf_texture_transform.h"
#include "compositor/models/model.h"
#include "tests/compositor/models/model_files_made.h"
#include "tests/compositor/models/triangle_file.h"

namespace pleinair::compositor {
namespace {

using ::testing::ElementsAre;
using testing::ErrorOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::MakePng;
using testing::TriangleFile;

TEST(GltfMaterial, ReadsWhatAlphaMeans) {
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

TEST(GltfMaterial, SeesNothingOfWhatIsCutOutWholly) {
  TriangleFile file;
  file.alpha = R"("alphaMode":"MASK","alphaCutoff":1.5,)";
  file.color_texture = R"({"index":0}, "baseColorFactor":[1,1,1,1])";
  EXPECT_THAT(ErrorOf(file), HasSubstr("transparent"));
  file.alpha = R"("alphaMode":"MASK","alphaCutoff":1,)";
  EXPECT_TRUE(file.Load());
}

TEST(GltfMaterial, ReadsTexturesOfRoughnessAndMetallic) {
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

TEST(GltfMaterial, ReportsWhatItLeavesOut) {
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

TEST(GltfMaterial, ReadsNormalMapEmissionColorsOfVerticesAndUnlitMaterials) {
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

TEST(GltfMaterial, ReadsLayersAndTransmission) {
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

TEST(GltfMaterial, ReadsDiffuseTransmission) {
  TriangleFile file;
  file.picture = MakePng(1, 1, {{102, 51, 255}});
  file.base = "0.8,0.4,0.2,1";
  file.metallic = "0";
  file.alpha =
      R"("extensions":{"KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":0.25,)"
      R"("diffuseTransmissionColorFactor":[1,0.5,0],)"
      R"("diffuseTransmissionColorTexture":{"index":0}}},)";
  auto model = file.Load();
  ASSERT_TRUE(model) << model.error().Message();
  EXPECT_THAT(UnsupportedFeatures(*model), IsEmpty());
  const Material& material = model->materials[0];
  // The factor takes light from the base.
  EXPECT_NEAR(material.base_color[0], 0.8 * 0.75, 1e-6);
  const DiffuseTransmission& transmission = material.detail.transmission;
  EXPECT_NEAR(transmission.color[0], 0.25 * material.coat.base_share, 1e-6);
  EXPECT_NEAR(transmission.color[1], 0.125 * material.coat.base_share, 1e-6);
  EXPECT_EQ(transmission.color[2], 0.0F);
  EXPECT_GE(transmission.texture, 0);
  EXPECT_TRUE(material.detail.Transmits());
  // Metal transmits nothing.
  file.metallic = "1";
  EXPECT_FALSE(file.Load()->materials[0].detail.Transmits());
}

TEST(GltfMaterial, ExpressesOneMapOfTextureCoordinatesByAnother) {
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

TEST(GltfMaterial, MovesTextureCoordinatesAsTheFileAsks) {
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

TEST(GltfMaterial, RefusesToMoveTextureCoordinatesOutOfTheWorld) {
  TriangleFile file;
  file.extra = R"(,"extensionsUsed":["KHR_texture_transform"])";
  file.color_texture = R"({"index":0,"extensions":{"KHR_texture_transform":{)"
                       R"("scale":[1e308,1e308],"rotation":0.5}}})";
  const auto model = file.Load();
  ASSERT_FALSE(model);
  EXPECT_NE(model.error().Message().find("KHR_texture_transform"), std::string::npos)
      << model.error().Message();
}

}  // namespace
}  // namespace pleinair::compositor
