#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "base/srgb.h"
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

std::size_t TriangleCount(const Model& model) {
  std::size_t count = 0;
  for (const Mesh& mesh : model.meshes) count += mesh.indices.size() / 3;
  return count;
}

Result<Model> LoadObj(const std::string& text, ModelOptions options = {}) {
  const TemporaryFolder folder;
  return LoadModel(folder.Write("model.obj", text), options);
}

double Area(const Model& model) {
  double sum = 0.0;
  for (const Mesh& mesh : model.meshes) {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      std::array<std::array<double, 3>, 3> p{};
      for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < 3; ++k) p[c][k] = mesh.positions[mesh.indices[i + c]][k];
      }
      // Level polygons: twice the signed area.
      sum +=
          ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0])) /
          2.0;
    }
  }
  return sum;
}

std::string ErrorOf(const std::string& text) {
  const auto model = LoadObj(text);
  EXPECT_FALSE(model);
  return model ? "" : model.error().Message();
}

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ObjModel, ReadsCornersFromEitherEnd) {
  for (const char* face : {"f 1 2 3 4\n", "f -4 -3 -2 -1\n", "f 1// 2// 3 4\n"}) {
    const auto model = LoadObj(std::string(kSquare) + face);
    ASSERT_TRUE(model) << model.error().Message();
    EXPECT_EQ(TriangleCount(*model), 2U);
    EXPECT_NEAR(Area(*model), 1.0, 1e-6);
    EXPECT_EQ(model->meshes[0].normals[0], (std::array<float, 3>{0.0F, 0.0F, 1.0F}));
  }
}

TEST(ObjModel, ReadsWindowsLineEndsCommentsAndContinuations) {
  const auto model = LoadObj(
      "# a square\r\nv 0 0 0 1.0\r\nv 1 0 0 # corner\r\nv +1 1e0 0\r\n\r\nv 0 1 0\r\n"
      "f 1 2 \\\r\n 3 4\r\nl 1 2\r\ns off\r\n");
  ASSERT_TRUE(model) << model.error().Message();
  EXPECT_NEAR(Area(*model), 1.0, 1e-6);
}

TEST(ObjModel, FillsConcavePolygonsWithoutOverlap) {
  // An L shape: a fan from its first corner would cover ground outside it.
  const auto model =
      LoadObj("v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 2 3 4 5 6 1\n");
  ASSERT_TRUE(model) << model.error().Message();
  EXPECT_EQ(TriangleCount(*model), 4U);
  EXPECT_NEAR(Area(*model), 3.0, 1e-6);
  for (const Mesh& mesh : model->meshes) {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      float x = 0.0F, y = 0.0F;
      for (int c = 0; c < 3; ++c) {
        x += mesh.positions[mesh.indices[i + c]][0] / 3.0F;
        y += mesh.positions[mesh.indices[i + c]][1] / 3.0F;
      }
      EXPECT_FALSE(x > 1.0F && y > 1.0F) << "a triangle lies outside the L";
    }
  }
}

TEST(ObjModel, GroupsFacesByNameAndMaterial) {
  const TemporaryFolder folder;
  folder.Write("two.mtl",
               "newmtl red brick\nKd 0.5 0.1 0.05\nillum 1\nKs 1 1 1\nd 0.5\nTr 0.5\n"
               "newmtl coat\nKd 0.2\nd 0\nKs 0.04 0.04 0.04\nNs 98\nillum 2\nPm 0.25\n");
  const auto file = folder.Write(
      "model.obj",
      std::string("mtllib two.mtl\no wall\n") + kSquare +
          "usemtl red brick\nf 1 2 3\nusemtl coat\nf 1 3 4\nusemtl red brick\nf 2 3 4\n");
  const auto model = LoadModel(file);
  ASSERT_TRUE(model) << model.error().Message();
  ASSERT_EQ(model->meshes.size(), 2U);
  EXPECT_EQ(model->meshes[0].name, "wall");
  EXPECT_EQ(model->meshes[0].indices.size(), 6U);
  const Material& brick = model->materials[model->meshes[0].material];
  EXPECT_EQ(brick.name, "red brick");
  EXPECT_EQ(brick.base_color, (std::array<float, 3>{0.5F, 0.1F, 0.05F})) << "Kd is linear";
  EXPECT_EQ(brick.coat.f0, 0.0F) << "illum 1 has no highlight";
  EXPECT_EQ(brick.alpha, Material::Alpha::kBlended);
  EXPECT_EQ(brick.opacity, 0.5F);
  const Material& coat = model->materials[model->meshes[1].material];
  EXPECT_NEAR(coat.coat.f0, 0.04F, 1e-6F);
  EXPECT_NEAR(coat.roughness, std::pow(0.02, 0.25), 1e-5);
  EXPECT_EQ(coat.coat.base_share, 1.0F) << "MTL adds Ks to Kd";
  EXPECT_EQ(coat.metallic, 0.25F);
  EXPECT_EQ(coat.opacity, 1.0F) << "d taken for Tr";
  EXPECT_EQ(coat.base_color, (std::array<float, 3>{0.2F, 0.2F, 0.2F}));
}

TEST(ObjModel, GivesASurfaceOfStatedRoughnessACoat) {
  const TemporaryFolder folder;
  folder.Write("two.mtl",
               "newmtl smooth\nKd 0.2\nPr 0.25\nillum 2\nnewmtl matt\nKd 0.2\nPr 0.25\nillum 1\n");
  const auto model =
      LoadModel(folder.Write("model.obj", std::string("mtllib two.mtl\nl 1 2\n") + kSquare +
                                              "usemtl smooth\nf 1 2 3\nusemtl matt\nf 1 3 4\n"));
  ASSERT_TRUE(model) << model.error().Message();
  const Material& smooth = model->materials[model->meshes[0].material];
  EXPECT_EQ(smooth.coat.f0, kDielectricF0);
  EXPECT_EQ(smooth.roughness, 0.25F);
  EXPECT_EQ(model->materials[model->meshes[1].material].coat.f0, 0.0F);
  EXPECT_EQ(model->unsupported_features, std::set<std::string>{kPointsAndLines});
}

TEST(ObjModel, TakesGlassForOpaqueWhereAsked) {
  const TemporaryFolder folder;
  folder.Write("thin.mtl", "newmtl a\nKd 0.5 0.5 0.5\nd 0.2\n");
  const auto file =
      folder.Write("model.obj", std::string("mtllib thin.mtl\n") + kSquare + "usemtl a\nf 1 2 3\n");
  EXPECT_EQ(LoadModel(file)->meshes[0].role, MeshRole::kRenderOnly) << "it casts no shadow";
  const auto phantom = LoadModel(file, {.opaque_glass = true, .frame = {}});
  ASSERT_TRUE(phantom);
  EXPECT_EQ(phantom->meshes[0].role, MeshRole::kAll);
}

TEST(ObjModel, ReportsWhatItLeavesOut) {
  const TemporaryFolder folder;
  const auto unsupported_features = [&](const std::string& material, const std::string& points) {
    folder.Write("one.mtl", "newmtl a\nKd 0.5 0.5 0.5\n" + material);
    return UnsupportedFeatures(
        *LoadModel(folder.Write("model.obj", "mtllib one.mtl\n" + points + "usemtl a\nf 1 2 3\n")));
  };
  const std::string plain = "v 0 0 0 1\nv 1 0 0\nv 1 1 0\n";
  EXPECT_THAT(unsupported_features("Ke 0 0 0\nNi 1.45\nKa 1 1 1\n", plain), IsEmpty());
  EXPECT_THAT(unsupported_features("map_d holes.png\ndisp bumps.png\n", plain),
              ElementsAre("displacement", "pictures of transparency (map_d)"));
  EXPECT_THAT(unsupported_features("newmtl b\nrefl 1\n", plain), IsEmpty()) << "nothing has it";
}

TEST(ObjModel, ReadsColorsOfVertices) {
  const auto model =
      LoadObj("v 0 0 0 1 0 0.5\nv 1 0 0\nv 1 1 0 0 1 0\nv 0 1 0 0.5\nf 1 2 3\nf 1 3 4\n");
  ASSERT_TRUE(model) << model.error().Message();
  const auto& details = model->meshes[0].details;
  ASSERT_EQ(details.size(), model->meshes[0].positions.size());
  EXPECT_NEAR(details[0].color[2], LinearFromSrgb(0.5), 1e-6);
  EXPECT_EQ(details[1].color, (std::array<float, 4>{1, 1, 1, 1}));
  EXPECT_EQ(details[2].color, (std::array<float, 4>{0, 1, 0, 1}));
  ASSERT_EQ(details.size(), 6U) << "each flat triangle has corners of its own";
  EXPECT_EQ(details[5].color, (std::array<float, 4>{1, 1, 1, 1})) << "one number is a weight";
  EXPECT_THAT(ErrorOf("v 0 0 0 1 x 0\n"), HasSubstr("model.obj:1"));
}

TEST(ObjModel, ReadsEmissionBumpsRoughnessAndMetalFromPictures) {
  const TemporaryFolder folder;
  folder.Write("grey.png", MakePng(2, 1, {{0, 0, 0}, {100, 100, 100}}));
  folder.Write("blue.png", MakePng(1, 1, {{128, 128, 255}}));
  folder.Write("m.mtl",
               "newmtl a\nKd 0.5\nKe 0 300 10\nmap_Ke grey.png\nmap_Bump -bm 2 grey.png\n"
               "map_Pr grey.png\nmap_Pm blue.png\nPm 0.5\n"
               "newmtl b\nmap_Ke grey.png\nbump blue.png\nmap_Pr grey.png\nPr 0.25\n");
  const auto model =
      LoadModel(folder.Write("model.obj", std::string("mtllib m.mtl\n") + kSquare +
                                              "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n"));
  ASSERT_TRUE(model) << model.error().Message();
  EXPECT_THAT(UnsupportedFeatures(*model), IsEmpty());
  const auto texture = [&](int index) { return model->textures[static_cast<std::size_t>(index)]; };
  const Material& a = model->materials[0];
  EXPECT_EQ(a.detail.emission.luminance_cd_m2, (std::array<float, 3>{0, 300, 10}));
  EXPECT_EQ(texture(a.detail.emission.texture)(1, 0, 0), 100);
  // The picture repeats: both its pixels are a valley and a ridge, level in the middle.
  EXPECT_EQ(texture(a.detail.normal_map.texture)(0, 0, 2), 255);
  EXPECT_EQ(texture(a.metallic_roughness_texture)(1, 0, 1), 100);
  EXPECT_EQ(texture(a.metallic_roughness_texture)(1, 0, 2), 128);
  EXPECT_EQ(a.roughness, 1.0F);
  EXPECT_EQ(a.metallic, 0.5F);
  const Material& b = model->materials[1];
  EXPECT_EQ(b.detail.emission.luminance_cd_m2, (std::array<float, 3>{1, 1, 1}));
  EXPECT_EQ(texture(b.detail.normal_map.texture)(0, 0, 0), 128) << "a normal map is kept";
  EXPECT_EQ(b.roughness, 0.25F);
}

TEST(ObjModel, KeepsNormalsOfTheFileUnlessAskedForOthers) {
  const std::string roof =
      "v 0 0 0\nv 1 0 1\nv 0 1 0\nv 1 1 1\nv 2 0 0\nv 2 1 0\nvn 0 0 2\n"
      "f 1//1 2//1 4//1 3//1\nf 2//1 5//1 6//1 4//1\n";
  const auto kept = LoadObj(roof);
  ASSERT_TRUE(kept);
  for (const auto& normal : kept->meshes[0].normals) EXPECT_EQ(normal[2], 1.0F);
  const auto flat = LoadObj(roof, {NormalsMode::kFlat, false, {}});
  ASSERT_TRUE(flat);
  for (const auto& normal : flat->meshes[0].normals) {
    EXPECT_NEAR(std::fabs(normal[0]), std::sqrt(0.5), 1e-5);
  }
  const auto smooth = LoadObj(roof, {NormalsMode::kSmooth, false, {}});
  ASSERT_TRUE(smooth);
  for (std::size_t i = 0; i < smooth->meshes[0].positions.size(); ++i) {
    if (smooth->meshes[0].positions[i][0] == 1.0F) {
      EXPECT_GT(smooth->meshes[0].normals[i][2], 0.9F) << "the ridge is rounded";
    }
  }
}

TEST(ObjModel, ReadsATextureWithVCountedFromTheTop) {
  const TemporaryFolder folder;
  folder.Write("grass field.png", MakePng(2, 1, {{10, 200, 30}, {255, 0, 128}}));
  folder.Write("m.mtl", "newmtl a\nmap_Kd -s 1 1 1 -clamp on grass field.png\n");
  const auto file =
      folder.Write("model.obj", std::string("mtllib m.mtl\nusemtl a\nvt 0 0\nvt 1 0.25\nvt 1 1\n") +
                                    kSquare + "f 1/1 2/2 3/3\n");
  const auto model = LoadModel(file);
  ASSERT_TRUE(model) << model.error().Message();
  const Material& material = model->materials[model->meshes[0].material];
  ASSERT_EQ(material.base_color_texture, 0);
  EXPECT_EQ(material.base_color, (std::array<float, 3>{1.0F, 1.0F, 1.0F}));
  const Image<std::uint8_t>& image = model->textures[0];
  ASSERT_EQ(image.width(), 2);
  ASSERT_EQ(image.channels(), 3);
  EXPECT_EQ(image(1, 0, 2), 128);
  EXPECT_EQ(model->meshes[0].uvs[1], (std::array<float, 2>{1.0F, 0.75F}));
}

TEST(ObjModel, ReadsAPngWhoseFirstDataChunkIsEmpty) {
  std::string png = MakePng(1, 1, {{10, 200, 30}});
  std::string empty_chunk;
  testing::AppendPngChunk("IDAT", "", &empty_chunk);
  png.insert(png.find("IDAT") - 4, empty_chunk);
  const TemporaryFolder folder;
  folder.Write("a.png", png);
  folder.Write("m.mtl", "newmtl a\nmap_Kd a.png\n");
  const auto model = LoadModel(
      folder.Write("model.obj", std::string("mtllib m.mtl\n") + kSquare + "usemtl a\nf 1 2 3\n"));
  ASSERT_TRUE(model) << model.error().Message();
  EXPECT_EQ(model->textures[0](0, 0, 1), 200);
}

TEST(ObjModel, RefusesATextureOf100000Squared) {
  const TemporaryFolder folder;
  folder.Write("huge.png", PngHeader(100'000, 100'000));
  folder.Write("m.mtl", "newmtl a\nmap_Kd huge.png\n");
  const auto model = LoadModel(
      folder.Write("model.obj", std::string("mtllib m.mtl\n") + kSquare + "usemtl a\nf 1 2 3\n"));
  ASSERT_FALSE(model);
  EXPECT_THAT(model.error().Message(), HasSubstr("huge.png"));
  EXPECT_THAT(model.error().Message(), HasSubstr("100000 × 100000"));
}

TEST(ObjModel, RefusesAJpegOf65535By20000) {
  // An APP0 segment, a fill byte, then the frame header: 8 bits, 20000 lines of 65535 samples.
  const std::string jpeg(
      "\xFF\xD8\xFF\xE0\x00\x04\x00\x00\xFF\xFF\xC0\x00\x11\x08\x4E\x20\xFF\xFF\x03", 19);
  const TemporaryFolder folder;
  folder.Write("huge.jpg", jpeg);
  folder.Write("m.mtl", "newmtl a\nmap_Kd huge.jpg\n");
  const auto file =
      folder.Write("model.obj", std::string("mtllib m.mtl\n") + kSquare + "usemtl a\nf 1 2 3\n");
  const auto model = LoadModel(file);
  ASSERT_FALSE(model);
  EXPECT_THAT(model.error().Message(), HasSubstr("huge.jpg: the texture is 65535 × 20000 pixels"));
  for (std::size_t length = 0; length < 18; ++length) {  // Cut short: no size, but an error.
    folder.Write("huge.jpg", jpeg.substr(0, length));
    const auto cut = LoadModel(file);
    ASSERT_FALSE(cut);
    EXPECT_THAT(cut.error().Message(), HasSubstr("huge.jpg"));
  }
}

TEST(ObjModel, RefusesTexturesThatAreMissingCutShortOrOfAnotherFormat) {
  const TemporaryFolder folder;
  const std::string whole = MakePng(8, 8, std::vector<std::array<std::uint8_t, 3>>(64));
  folder.Write("cut.png", whole.substr(0, whole.size() / 2));
  folder.Write("text.png", "hello");
  folder.Write("empty.png", "");
  for (const char* name : {"missing.png", "cut.png", "text.png", "empty.png", "."}) {
    folder.Write("m.mtl", std::string("newmtl a\nmap_Kd ") + name + "\n");
    const auto model = LoadModel(
        folder.Write("model.obj", std::string("mtllib m.mtl\n") + kSquare + "usemtl a\nf 1 2 3\n"));
    ASSERT_FALSE(model) << name;
    EXPECT_EQ(model.error().kind, ErrorKind::kInput);
    EXPECT_THAT(model.error().Message(), HasSubstr(name));
  }
}

TEST(ObjModel, NamesFileAndLineOfBrokenStatements) {
  EXPECT_THAT(ErrorOf(std::string(kSquare) + "f 1 2 5\n"), HasSubstr("model.obj:5"));
  EXPECT_THAT(ErrorOf(std::string(kSquare) + "f 1 2 5\n"), HasSubstr("vertex 5 of 4"));
  EXPECT_THAT(ErrorOf(std::string(kSquare) + "f 0 1 2\n"), HasSubstr("vertex 0"));
  EXPECT_THAT(ErrorOf(std::string(kSquare) + "f -5 1 2\n"), HasSubstr("vertex -5"));
  EXPECT_THAT(ErrorOf(std::string(kSquare) + "f 1/1 2/1 3/1\n"), HasSubstr("texture coordinate"));
  EXPECT_THAT(ErrorOf(std::string(kSquare) + "f 1//9 2//9 3//9\n"), HasSubstr("normal 9"));
  EXPECT_THAT(ErrorOf(std::string(kSquare) + "f 1 2\n"), HasSubstr("three corners"));
  EXPECT_THAT(ErrorOf(std::string(kSquare) + "f 1 2 99999999999999999999\n"), HasSubstr(":5"));
  EXPECT_THAT(ErrorOf("v 0 0 nan\n"), HasSubstr("model.obj:1"));
  EXPECT_THAT(ErrorOf("v 0 0 inf\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(ErrorOf("v 0 0 1e300\n"), HasSubstr("1e300"));
  EXPECT_THAT(ErrorOf("v 0 0\n"), HasSubstr("too few"));
  EXPECT_THAT(ErrorOf("mtllib gone.mtl\n"), HasSubstr("gone.mtl"));
}

TEST(ObjModel, RefusesMaterialValuesOutOfRangeAndNoise) {
  const auto refused = [](const std::string& library) {
    const TemporaryFolder folder;
    folder.Write("m.mtl", library);
    const auto model = LoadModel(
        folder.Write("model.obj", std::string("mtllib m.mtl\n") + kSquare + "usemtl a\nf 1 2 3\n"));
    return model ? std::string("no error") : model.error().Message();
  };
  EXPECT_EQ(refused("\xEF\xBB\xBFnewmtl a\nKd 1.001 0 0\nKs 2 2 2\nvray:glossy 1\n"), "no error");
  EXPECT_THAT(refused("newmtl a\nKd -1 0 0\n"), HasSubstr("m.mtl:2: Kd -1 is outside 0 to 1"));
  EXPECT_THAT(refused("newmtl a\nKd 204 204 204\n"), HasSubstr("Kd 204 is outside 0 to 1"));
  EXPECT_THAT(refused("newmtl a\nNs -7\n"), HasSubstr("Ns -7 is outside"));
  EXPECT_THAT(refused("newmtl a\nd 7\n"), HasSubstr("d 7 is outside"));
  EXPECT_THAT(refused("\x01\x02\xFFnoise\n"), HasSubstr("no statement of a material library"));
  EXPECT_THAT(refused("some words\n"), HasSubstr("defines no material"));
}

TEST(ObjModel, ReadsCompanionsOnlyFromItsFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "inner");
  folder.Write("m.mtl", "newmtl a\n");
  folder.Write("inner/n.mtl", "newmtl a\nmap_Kd ../../secret.png\n");
  for (const char* library : {"../m.mtl", "n.mtl", "/etc/hostname"}) {
    const auto model =
        LoadModel(folder.Write("inner/model.obj", std::string("mtllib ") + library + "\n" +
                                                      kSquare + "usemtl a\nf 1 2 3\n"));
    ASSERT_FALSE(model) << library;
    EXPECT_THAT(model.error().Message(), HasSubstr("lies outside the folder of the model"));
  }
}

TEST(Model, NamesFormatsThatAreNotRead) {
  const TemporaryFolder folder;
  std::string stl(84 + 50, '\0');
  stl[80] = 1;
  for (const auto& [content, name] : {std::pair<std::string, const char*>{"ply\nformat", "a PLY"},
                                      {"solid a\nfacet normal", "an STL"},
                                      {stl, "an STL"},
                                      {"Kaydara FBX Binary", "an FBX"}}) {
    const auto model = LoadModel(folder.Write("model.any", content));
    ASSERT_FALSE(model);
    EXPECT_THAT(model.error().Message(), HasSubstr(std::string("is ") + name + " model"));
  }
}

TEST(ObjModel, RefusesFilesWithoutFaces) {
  EXPECT_THAT(ErrorOf(""), HasSubstr("is empty"));
  EXPECT_THAT(ErrorOf(kSquare), HasSubstr("no faces"));
  EXPECT_THAT(ErrorOf("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), HasSubstr("degenerate"));
  EXPECT_FALSE(LoadModel("/nowhere/model.obj"));
  const TemporaryFolder folder;
  EXPECT_FALSE(LoadModel(folder.path())) << "a folder";
}

}  // namespace
}  // namespace pleinair::compositor
