#include "compositor/models/model_frame.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "compositor/models/model.h"
#include "tests/compositor/models/model_files_made.h"

namespace pleinair::compositor {
namespace {

using testing::TemporaryFolder;

/// A tetrahedron 2 wide, 3 high along y and 1 deep, standing on y = 0, in units of the file.
std::string Tetrahedron(const std::string& header = "", const std::array<std::string, 3>& at = {}) {
  const auto vertex = [&](const char* x, const char* y, const char* z) {
    return "v " + at[0] + x + " " + at[1] + y + " " + at[2] + z + "\n";
  };
  return header + vertex("1", "0", "0") + vertex("3", "0", "0") + vertex("1", "3", "0") +
         vertex("1", "0", "1") + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
}

/// The same in one buffer as glTF.
std::string TetrahedronAsGltf() {
  return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,)"
         R"("componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,)"
         R"("byteLength":36}],"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;)"
         // (0 0 0) (1 0 0) (0 2 3)
         R"(base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAEBA"}]})";
}

Model Load(const std::string& content, const ModelFrame& frame, const char* name = "m.obj") {
  const TemporaryFolder folder;
  const auto model =
      LoadModel(folder.Write(name, content), {.normals = NormalsMode::kFromFile, .frame = frame});
  EXPECT_TRUE(model) << model.error().Message();
  return model ? *model : Model{};
}

void ExpectBox(const Model& model, Vec3 min, Vec3 max, double tolerance = 1e-6) {
  const ModelBounds box = BoundsOf(model);
  EXPECT_NEAR(Norm(box.min_m - min), 0.0, tolerance) << box.min_m.x << " " << box.min_m.y;
  EXPECT_NEAR(Norm(box.max_m - max), 0.0, tolerance) << box.max_m.x << " " << box.max_m.y;
}

TEST(ModelFrame, TurnsUpWhatTheSceneCallsUp) {
  ExpectBox(Load(Tetrahedron(), {}), {1, 0, 0}, {3, 3, 1});
  ExpectBox(Load(Tetrahedron(), {.file_up = UpAxis::kY}), {1, -1, 0}, {3, 0, 3});
  ExpectBox(Load(Tetrahedron(), {.file_up = UpAxis::kZ}), {1, 0, 0}, {3, 3, 1});
  // A marker on a wall.
  ExpectBox(Load(Tetrahedron(), {.file_up = {}, .placed_up = UpAxis::kY}), {1, 0, 0}, {3, 3, 1});
  ExpectBox(Load(Tetrahedron(), {.file_up = UpAxis::kZ, .placed_up = UpAxis::kY}), {1, 0, -3},
            {3, 1, 0});
}

TEST(ModelFrame, StandsGltfUprightOnAnyMarker) {
  const std::string gltf = TetrahedronAsGltf();
  ExpectBox(Load(gltf, {}, "m.gltf"), {0, -3, 0}, {1, 0, 2});
  ExpectBox(Load(gltf, {.file_up = {}, .placed_up = UpAxis::kY}, "m.gltf"), {0, 0, 0}, {1, 2, 3});
  ExpectBox(Load(gltf, {.file_up = UpAxis::kZ}, "m.gltf"), {0, 0, 0}, {1, 2, 3});
}

TEST(ModelFrame, TurnsNormalsToo) {
  const Model model = Load(Tetrahedron("vn 0 1 0\n") + "f 1//1 2//1 4//1\n",
                           {.file_up = UpAxis::kY, .unit_m = 0.001});
  bool found = false;
  for (const auto& normal : model.meshes[0].normals) {
    found |= normal == std::array<float, 3>{0.0F, 0.0F, 1.0F};
  }
  EXPECT_TRUE(found);
}

TEST(ModelFrame, ConvertsUnitsAndPutsTheBottomCentreAtTheOrigin) {
  ExpectBox(Load(Tetrahedron(), {.file_up = {}, .unit_m = 0.001}), {0.001, 0, 0},
            {0.003, 0.003, 0.001}, 1e-9);
  ExpectBox(Load(Tetrahedron(), {.file_up = {}, .unit_m = 0.0254, .bottom_centre = true}),
            Vec3{-1, -1.5, 0} * 0.0254, Vec3{1, 1.5, 1} * 0.0254);
  ExpectBox(Load(Tetrahedron(), {.file_up = {}, .placed_up = UpAxis::kY, .bottom_centre = true}),
            {-1, 0, -0.5}, {1, 3, 0.5});
}

TEST(ModelFrame, KeepsMillimetresOfSurveyCoordinates) {
  // Eastings and northings as of UTM, 1 to 3 mm apart: floats there lie half a metre apart.
  const std::array<std::string, 3> at{"458013.00", "5548021.00", "220.00"};
  const Model model = Load(Tetrahedron("", at), {.file_up = {}, .bottom_centre = true});
  EXPECT_EQ(model.origin_m, Vec3{});
  ExpectBox(model, Vec3{-1, -1.5, 0} * 1e-3, Vec3{1, 1.5, 1} * 1e-3, 1e-8);
  const Model kept = Load(Tetrahedron("", at), {.file_up = {}, .unit_m = 0.3048});
  EXPECT_NEAR(kept.origin_m.y, 5548021.0 * 0.3048, 1e-3);
  const Vec3 size = BoundsOf(kept).Size();
  EXPECT_NEAR(size.y, 0.003 * 0.3048, 1e-8);
}

TEST(ModelFrame, LooksYUpByShapeAndHeader) {
  const std::string centred = "v -1 0 -1\nv 1 0 1\nv 0 3 -1\nv 0 3 1\n";
  const std::string faces = "f 1 2 3\nf 1 2 4\n";
  EXPECT_TRUE(LooksYUp(Load(centred + faces, {})));
  // The same, z up.
  EXPECT_FALSE(LooksYUp(Load("v -1 -1 0\nv 1 1 0\nv 0 -1 3\nv 0 1 3\n" + faces, {})));
  // As a cow that faces x, above and below its origin.
  EXPECT_TRUE(LooksYUp(Load("v -4 -3 -1\nv 5 -3 1\nv 0 2 -1\nv 0 2 1\n" + faces, {})));
  // A ball is symmetric in all directions.
  EXPECT_FALSE(LooksYUp(Load("v -1 -1 -1\nv 1 1 1\nv 0 1 -1\nv 0 1 1\n" + faces, {})));
  EXPECT_FALSE(LooksYUp(Load(Tetrahedron("# Blender 4.1.0\n"), {})));
  const std::string below = "v 0 0 -2\nv 1 1 -2\nv 1 0 1\n";
  EXPECT_TRUE(LooksYUp(Load("# Blender 4.1.0\n" + below + "f 1 2 3\n", {})));
  EXPECT_FALSE(LooksYUp(Load("# Other\n" + below + "f 1 2 3\n", {})));
}

TEST(ModelFrame, NamesTheProgramThatWroteTheFile) {
  EXPECT_EQ(Load(Tetrahedron("####\n#\n# OBJ File Generated by Meshlab\n"), {}).written_by,
            "OBJ File Generated by Meshlab");
  EXPECT_EQ(Load(Tetrahedron(), {}).written_by, "");
}

}  // namespace
}  // namespace pleinair::compositor
