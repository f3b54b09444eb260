// Tests casters whose shape changes, which the processor draws, against OpenGL and against new
// maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tests/shadows/shadow_scene.h"

namespace pleinair::shadows {
namespace {

constexpr int kAround = 48, kAcross = 24;

/// A lumpy ball of about 2,300 triangles, 40 cm large, before a wall.
class LumpyBall : public ShadowScene {
 protected:
  void SetUp() override {
    ShadowScene::SetUp();
    options_.resolutions = {256, 256, 256, 256};
    AddGround();
    for (int k = 0; k < kAcross; ++k) {
      for (int i = 0; i < kAround; ++i) {
        const unsigned a = Index(i, k), b = Index(i + 1, k), c = Index(i, k + 1),
                       d = Index(i + 1, k + 1);
        indices_.insert(indices_.end(), {a, c, b, b, c, d});
      }
    }
    SetShape(0.0);
    AddMesh(std::vector<glm::vec3>(points_.begin(), points_.end()), indices_);
    focus_.Include({-0.5, -0.5, 0.0});
    focus_.Include({0.5, 0.5, 0.8});
  }

  /// Moves the ball to the right.
  void SetShape(double right_m) {
    points_.clear();
    positions_.clear();
    for (int k = 0; k <= kAcross; ++k) {
      for (int i = 0; i < kAround; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / kAround;
        const double polar = std::numbers::pi * k / kAcross;
        const double radius = 0.2 + 0.03 * std::sin(5.0 * turn) * std::sin(4.0 * polar);
        points_.emplace_back(right_m + radius * std::sin(polar) * std::cos(turn),
                             radius * std::sin(polar) * std::sin(turn),
                             0.4 + radius * std::cos(polar));
        const glm::vec3& p = points_.back();
        positions_.push_back({p.x, p.y, p.z});
      }
    }
    ++revision_;
  }

  std::vector<ShadowCaster> BallCasters(bool in_memory) const {
    std::vector<ShadowCaster> casters = Casters();
    ShadowCaster& ball = casters.back();
    ball.sun_side_only = true;
    ball.bounds = focus_;
    ball.revision = revision_;
    if (in_memory) ball.triangles = {positions_, indices_};
    return casters;
  }

  const glm::dvec3 sun_ = SunAt(200, 40);
  const ProbePlane ground_{{-1.0, -1.0, 0.0}, {0.02, 0, 0}, {0, 0.02, 0}, 100, 100};
  ShadowMapOptions options_;
  Box focus_;

 private:
  static unsigned Index(int i, int k) { return static_cast<unsigned>(k * kAround + i % kAround); }

  std::vector<glm::vec3> points_;
  std::vector<std::array<float, 3>> positions_;
  std::vector<std::uint32_t> indices_;
  std::uint64_t revision_ = 0;
};

TEST_F(LumpyBall, IsDrawnAsByOpenGl) {
  ShadowMaps by_gl = *ShadowMaps::Create(options_), by_processor = *ShadowMaps::Create(options_);
  ASSERT_TRUE(by_gl.UpdateForRegion(BallCasters(false), AsDirection(sun_), focus_));
  ASSERT_TRUE(by_processor.UpdateForRegion(BallCasters(true), AsDirection(sun_), focus_));
  const Image<float> expected = by_gl.ReadDepth(0), drawn = by_processor.ReadDepth(0);
  int different = 0, higher = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    different += std::fabs(expected.data()[i] - drawn.data()[i]) > 1e-3F ? 1 : 0;
    higher += expected.data()[i] < 0.6F ? 1 : 0;
  }
  ASSERT_GT(higher, 2000);  // Texels of the ball.
  EXPECT_LE(different, higher / 200);
  const std::vector<float> a = Visibility(by_gl, ground_), b = Visibility(by_processor, ground_);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::fabs(a[i] - b[i]);
  EXPECT_LT(*std::min_element(b.begin(), b.end()), 0.01F);
  EXPECT_LE(sum / static_cast<double>(a.size()), 5e-4);
}

TEST_F(LumpyBall, IsDrawnAgainWhereItWasAndWhereItIs) {
  ShadowMaps followed = *ShadowMaps::Create(options_);
  EXPECT_EQ(*followed.UpdateForRegion(BallCasters(true), AsDirection(sun_), focus_), 2);
  EXPECT_EQ(*followed.UpdateForRegion(BallCasters(true), AsDirection(sun_), focus_), 0);
  for (const double right_m : {0.05, 0.2, -0.2}) {
    SetShape(right_m);
    EXPECT_EQ(*followed.UpdateForRegion(BallCasters(true), AsDirection(sun_), focus_), 1);
    ShadowMaps fresh = *ShadowMaps::Create(options_);
    ASSERT_TRUE(fresh.UpdateForRegion(BallCasters(true), AsDirection(sun_), focus_));
    const Image<float> expected = fresh.ReadDepth(0), drawn = followed.ReadDepth(0);
    EXPECT_TRUE(std::equal(expected.data(), expected.data() + expected.size(), drawn.data()));
    EXPECT_EQ(Visibility(followed, ground_), Visibility(fresh, ground_));
  }
}

}  // namespace
}  // namespace pleinair::shadows
