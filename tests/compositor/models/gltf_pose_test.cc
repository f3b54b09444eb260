// Poses of animated, skinned and morphing models.

#include "compositor/models/gltf_pose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "compositor/models/animation/model_animation.h"
#include "compositor/models/model.h"
#include "tests/compositor/models/model_files_made.h"

namespace pleinair::compositor {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

constexpr float kHalf = std::numbers::sqrt2_v<float> / 2;

template <typename T>
std::string Bytes(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// A triangle (0 0 0) (1 0 0) (0 2 0) in a node at x = 10, with an animation "Move" of one channel.
struct AnimatedFile {
  std::vector<float> times{0, 2};
  std::vector<float> values{10, 0, 0, 14, 0, 0};
  std::string path = "translation", interpolation = "LINEAR", value_type = "VEC3";
  int value_count = 2;
  std::string node, primitive, extra;
  std::vector<float> more;  ///< 16 floats of an inverse bind matrix, or three morph deltas.

  Result<Model> Load(const ModelPose& pose, const ModelOptions& options = {}) const {
    const TemporaryFolder folder;
    return LoadModel(Write(folder), options, pose);
  }

  Result<AnimatedModel> LoadMoving(const std::string& animation,
                                   const ModelOptions& options = {}) const {
    const TemporaryFolder folder;
    return LoadAnimatedModel(Write(folder), options, animation);
  }

  std::filesystem::path Write(const TemporaryFolder& folder) const {
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 2, 0};
    const std::vector<std::uint8_t> joints{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0};
    const std::vector<float> weights{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    std::string buffer, views;
    const auto view = [&](const std::string& bytes) {
      views += (views.empty() ? "" : ",") + std::string(R"({"buffer":0,"byteOffset":)") +
               std::to_string(buffer.size()) + R"(,"byteLength":)" + std::to_string(bytes.size()) +
               "}";
      buffer += bytes;
    };
    view(Bytes(positions));
    view(Bytes(times));
    view(Bytes(values));
    view(Bytes(joints));
    view(Bytes(weights));
    view(Bytes(more.empty() ? std::vector<float>(16) : more));
    const auto accessor = [](int of, int type, std::size_t count, const std::string& shape) {
      return R"({"bufferView":)" + std::to_string(of) + R"(,"componentType":)" +
             std::to_string(type) + R"(,"count":)" + std::to_string(count) + R"(,"type":")" +
             shape + R"("})";
    };
    const std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,)"
        R"("translation":[10,0,0])" +
        node +
        R"(},{"children":[2]},{}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,)"
        R"("JOINTS_0":3,"WEIGHTS_0":4})" +
        primitive +
        R"(}]}],"animations":[{"name":"Move","channels":[{"sampler":0,"target":{"node":)" +
        (path == "rotation" && !extra.empty() ? "2" : "0") + R"(,"path":")" + path +
        R"("}}],"samplers":[{"input":1,"output":2,"interpolation":")" + interpolation +
        R"("}]}],"accessors":[)" + accessor(0, 5126, 3, "VEC3") + "," +
        accessor(1, 5126, times.size(), "SCALAR") + "," +
        accessor(2, 5126, static_cast<std::size_t>(value_count), value_type) + "," +
        accessor(3, 5121, 3, "VEC4") + "," + accessor(4, 5126, 3, "VEC4") + "," +
        (more.size() == 9 ? accessor(5, 5126, 3, "VEC3") : accessor(5, 5126, 1, "MAT4")) +
        R"(],"bufferViews":[)" + views + R"(],"buffers":[{"uri":"data.bin","byteLength":)" +
        std::to_string(buffer.size()) + "}]" + extra + "}";
    folder.Write("data.bin", buffer);
    return folder.Write("model.gltf", json);
  }

  /// A corner of the triangle in the file's coordinates.
  std::array<float, 3> Corner(std::size_t corner, double time_s) const {
    const auto model = Load({"Move", time_s});
    EXPECT_TRUE(model) << model.error().Message();
    if (!model) return {};
    const auto& [x, y, z] = model->meshes[0].positions[model->meshes[0].indices[corner]];
    return {x, z, -y};
  }

  std::string Error() const {
    const auto model = Load({"Move", 1.0});
    EXPECT_FALSE(model);
    return model ? "" : model.error().Message();
  }
};

void ExpectNear(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-5) << i;
}

TEST(ModelPose, MovesANodeFromKeyToKey) {
  AnimatedFile file;
  for (const auto& [time_s, x] : {std::array{-1.0, 10.0}, std::array{0.5, 11.0},
                                  std::array{2.0, 14.0}, std::array{9.0, 14.0}}) {
    ExpectNear(file.Corner(1, time_s), {static_cast<float>(x) + 1, 0, 0});
  }
  file.interpolation = "STEP";
  ExpectNear(file.Corner(0, 1.9), {10, 0, 0});
  // A spline with tangents of zero eases in and out: 10 + 4 (3 t² − 2 t³), t = 1/4.
  file.interpolation = "CUBICSPLINE";
  file.values = {0, 0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 14, 0, 0, 0, 0, 0};
  file.value_count = 6;
  ExpectNear(file.Corner(0, 0.5), {10.625F, 0, 0});
  // One key holds forever.
  file = {};
  file.times = {5};
  file.values = {12, 0, 0};
  file.value_count = 1;
  ExpectNear(file.Corner(0, 0.0), {12, 0, 0});
}

TEST(ModelPose, TurnsAlongTheShorterArc) {
  AnimatedFile file;
  file.path = "rotation";
  file.value_type = "VEC4";
  // A quarter turn about z, by the quaternion of the opposite sign.
  file.values = {0, 0, 0, 1, 0, 0, -kHalf, -kHalf};
  const float c = std::cos(std::numbers::pi_v<float> / 6);
  ExpectNear(file.Corner(1, 4.0 / 3.0), {10.5F, c, 0});
}

TEST(ModelPose, BendsASkinByItsJoints) {
  AnimatedFile file;
  file.node = R"(,"skin":0)";
  // The second joint turns by 90° about z.
  file.extra = R"(,"skins":[{"joints":[1,2]}])";
  file.path = "rotation";
  file.value_type = "VEC4";
  file.values = {0, 0, 0, 1, 0, 0, kHalf, kHalf};
  ExpectNear(file.Corner(1, 2.0), {1, 0, 0});  // The mesh's own node does not count.
  ExpectNear(file.Corner(2, 2.0), {-2, 0, 0});
  ExpectNear(file.Corner(2, 0.0), {0, 2, 0});
  file.extra = R"(,"skins":[{"joints":[1]}])";
  EXPECT_THAT(file.Error(), HasSubstr("joint out of range"));
  file.extra = R"(,"skins":[{"joints":[1,9]}])";
  EXPECT_THAT(file.Error(), HasSubstr("joint out of range"));
  file.extra = R"(,"skins":[{"joints":[1,2],"inverseBindMatrices":5}])";
  EXPECT_THAT(file.Error(), HasSubstr("fewer matrices than joints"));
}

TEST(ModelPose, AddsMorphTargets) {
  AnimatedFile file;
  file.more = {0, 0, 0, 0, 0, 0, 0, 0, 4};
  file.primitive = R"(,"targets":[{"POSITION":5}])";
  file.path = "weights";
  file.value_type = "SCALAR";
  file.values = {0, 1};
  ExpectNear(file.Corner(2, 1.0), {10, 2, 2});
  file.node = R"(,"weights":[0.25])";
  const auto still = file.Load({});
  ASSERT_TRUE(still) << still.error().Message();
  EXPECT_NEAR(still->meshes[0].positions[2][1], -1.0, 1e-6);
  EXPECT_THAT(UnsupportedFeatures(*still), ::testing::ElementsAre("animations"));
}

TEST(ModelPose, RefusesDamagedAnimations) {
  AnimatedFile file;
  file.times = {0, std::numeric_limits<float>::quiet_NaN()};
  EXPECT_THAT(file.Error(), HasSubstr("not a finite number"));
  file.times = {1, 1};
  EXPECT_THAT(file.Error(), HasSubstr("not in order"));
  file.times = {0, 1, 2};
  EXPECT_THAT(file.Error(), HasSubstr("more or fewer values than key frames"));
  file = {};
  const auto unknown = file.Load({"Run", 0.0});
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().Message(), HasSubstr("has no animation \"Run\"; it has Move"));
  EXPECT_TRUE(file.Load({"0", 0.0}));
  EXPECT_FALSE(file.Load({"1", 0.0}));
}

/// The file loaded at a moment and the shape of its animation then must be the same.
void ExpectShapesOfMoments(const AnimatedFile& file) {
  for (const NormalsMode normals : {NormalsMode::kFromFile, NormalsMode::kFlat}) {
    const ModelOptions options{
        normals, false, {.file_up = UpAxis::kZ, .placed_up = UpAxis::kY, .unit_m = 0.1}};
    const auto moving = file.LoadMoving("Move", options);
    ASSERT_TRUE(moving) << moving.error().Message();
    EXPECT_EQ(moving->animation->duration_s(), 2.0);
    EXPECT_TRUE(UnsupportedFeatures(moving->model).empty());
    for (const double time_s : {-1.0, 0.0, 0.3, 1.7, 2.0, 5.0}) {
      const auto still = file.Load({"Move", time_s}, options);
      ASSERT_TRUE(still) << still.error().Message();
      const std::vector<MeshShape> shapes = moving->animation->At(time_s);
      ASSERT_EQ(shapes.size(), still->meshes.size());
      for (std::size_t m = 0; m < shapes.size(); ++m) {
        ASSERT_EQ(shapes[m].positions.size(), still->meshes[m].positions.size());
        for (std::size_t v = 0; v < shapes[m].positions.size(); ++v) {
          ExpectNear(shapes[m].positions[v], still->meshes[m].positions[v]);
          ExpectNear(shapes[m].normals[v], still->meshes[m].normals[v]);
          const Vec3 in_box{shapes[m].positions[v][0], shapes[m].positions[v][1],
                            shapes[m].positions[v][2]};
          EXPECT_LE(Norm(in_box - moving->animation->bounds().Centre()),
                    0.5 * Norm(moving->animation->bounds().Size()) + 1e-6);
        }
      }
    }
  }
}

TEST(ModelAnimation, HasTheShapeOfTheFileAtEveryMoment) {
  AnimatedFile file;
  ExpectShapesOfMoments(file);
  file.path = "rotation";
  file.value_type = "VEC4";
  file.values = {0, 0, 0, 1, 0, kHalf, 0, kHalf};
  ExpectShapesOfMoments(file);
  file.node = R"(,"skin":0)";
  file.extra = R"(,"skins":[{"joints":[1,2]}])";
  ExpectShapesOfMoments(file);
  file = {};
  file.path = "scale";
  file.values = {1, 1, 1, 2, 1, 3};
  ExpectShapesOfMoments(file);
  file = {};
  file.more = {0, 0, 0, 0, 0, 0, 0, 0, 4};
  file.primitive = R"(,"targets":[{"POSITION":5}])";
  file.path = "weights";
  file.value_type = "SCALAR";
  file.values = {0, 1};
  ExpectShapesOfMoments(file);
}

TEST(ModelAnimation, ListsItselfInItsModel) {
  const auto model = AnimatedFile{}.Load({});
  ASSERT_TRUE(model);
  ASSERT_EQ(model->animations.size(), 1U);
  EXPECT_EQ(model->animations[0].name, "Move");
}

TEST(ModelAnimation, RefusesWhatDoesNotMove) {
  AnimatedFile file;
  const auto error_of = [&file](const std::string& name) {
    const auto moving = file.LoadMoving(name);
    return moving ? "" : moving.error().Message();
  };
  EXPECT_THAT(error_of("Run"), HasSubstr("has no animation \"Run\"; it has Move"));
  file.values = {10, 0, 0, 9e7F, 9e7F, 9e7F};
  EXPECT_THAT(error_of("Move"), HasSubstr("beyond 1e8 metres"));
  file.times = {5};
  file.values = {12, 0, 0};
  file.value_count = 1;
  EXPECT_THAT(error_of("Move"), HasSubstr("has no two key frames; leave animation out"));
  file.times = {0, std::numeric_limits<float>::quiet_NaN()};
  file.values = {10, 0, 0, 14, 0, 0};
  file.value_count = 2;
  EXPECT_THAT(error_of("Move"), HasSubstr("not a finite number"));
}

TEST(ModelAnimation, PlaysOnceOrAgainAndAgain) {
  const auto moving = AnimatedFile{}.LoadMoving("Move");
  ASSERT_TRUE(moving);
  Playback playback{moving->animation, 0.5, false};
  EXPECT_DOUBLE_EQ(playback.MomentAt(0.0), 0.5);
  EXPECT_DOUBLE_EQ(playback.MomentAt(1.0), 1.5);
  EXPECT_DOUBLE_EQ(playback.MomentAt(9.0), 2.0);
  EXPECT_DOUBLE_EQ(playback.MomentAt(-9.0), 0.0);
  playback.loop = true;
  EXPECT_DOUBLE_EQ(playback.MomentAt(9.0), 1.5);
  EXPECT_DOUBLE_EQ(playback.MomentAt(-0.75), 1.75);
}

}  // namespace
}  // namespace pleinair::compositor
