#include "compositor/contact_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compositor/light_solver.h"
#include "tests/compositor/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::BoxModel;
using testing::Ground;
using testing::Object;
using testing::Phantom;

constexpr std::array<float, 3> kGrey{0.5F, 0.5F, 0.5F};

ContactLines LinesOf(const std::vector<PlacedModel>& models) {
  std::vector<SurfaceMesh> surfaces;
  for (std::size_t i = 0; i < models.size(); ++i) {
    for (SurfaceMesh& surface : OrientedSurfaces(models[i], static_cast<int>(i))) {
      surfaces.push_back(std::move(surface));
    }
  }
  return {surfaces, 0.04};
}

double TotalLength(const ContactLines& lines) {
  double total = 0.0;
  for (const auto& segment : lines.segments()) total += Norm(segment.to - segment.from);
  return total;
}

TEST(ContactLines, GoRoundTheFootOfABox) {
  const ContactLines lines = LinesOf(
      {Phantom(Ground(3.0, kGrey)), Phantom(BoxModel({0.5, -1.0, 0.0}, {0.8, 1.0, 1.5}, kGrey))});
  // Each side's two triangles meet the ground's one or two: the foot, and pieces of it again.
  ASSERT_FALSE(lines.segments().empty());
  EXPECT_GE(TotalLength(lines), 4.5);
  for (const auto& segment : lines.segments()) {
    for (const Vec3 end : {segment.from, segment.to}) {
      EXPECT_NEAR(end.z, 0.0, 1e-6);
      const double outside = std::max(std::fabs(end.x - 0.65) - 0.15, std::fabs(end.y) - 1.0);
      EXPECT_NEAR(outside, 0.0, 0.03);
    }
  }
  EXPECT_TRUE(lines.IsWithin({0.4F, 0.3F, 0.0F}, 0.101));
  EXPECT_FALSE(lines.IsWithin({0.4F, 0.3F, 0.0F}, 0.099));
  EXPECT_TRUE(lines.IsWithin({0.65F, 1.0F, 0.2F}, 0.21));
  EXPECT_FALSE(lines.IsWithin({0.65F, 0.0F, 1.5F}, 1.0)) << "not the box' upper edges";
}

TEST(ContactLines, AreFoundAcrossASmallGapAndNotAcrossALargeOne) {
  const auto box = [](double bottom) {
    return Phantom(BoxModel({0.5, -1.0, bottom}, {0.8, 1.0, 1.5}, kGrey));
  };
  const PlacedModel ground = Phantom(Ground(3.0, kGrey));
  EXPECT_FALSE(LinesOf({ground, box(0.01)}).segments().empty());
  EXPECT_FALSE(LinesOf({ground, box(-0.2)}).segments().empty());
  EXPECT_TRUE(LinesOf({ground, box(0.1)}).segments().empty());
}

TEST(ContactLines, AreNotWhereNothingIsSeenOfTheOtherSurface) {
  // A body's own edges, layers of ground, and what is virtual.
  EXPECT_TRUE(LinesOf({Phantom(BoxModel({0, 0, 0}, {1, 1, 1}, kGrey))}).segments().empty());
  EXPECT_TRUE(LinesOf({Phantom(Ground(3.0, kGrey)), Phantom(Ground(1.0, kGrey, false, 0.01))})
                  .segments()
                  .empty());
  EXPECT_TRUE(LinesOf({Phantom(Ground(3.0, kGrey)), Object(BoxModel({0, 0, 0}, {1, 1, 1}, kGrey))})
                  .segments()
                  .empty());
}

TEST(ContactLines, AreTheInnerEdgesOfARoom) {
  // The six faces of a cube see each other along its twelve edges, if it is open (no lid: eight).
  Mesh room;
  testing::AddQuad(&room, {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}});
  testing::AddQuad(&room, {{{-1, -1, 0}, {-1, -1, 1}, {1, -1, 1}, {1, -1, 0}}});
  testing::AddQuad(&room, {{{-1, 1, 0}, {1, 1, 0}, {1, 1, 1}, {-1, 1, 1}}});
  testing::AddQuad(&room, {{{-1, -1, 0}, {-1, 1, 0}, {-1, 1, 1}, {-1, -1, 1}}});
  testing::AddQuad(&room, {{{1, -1, 0}, {1, -1, 1}, {1, 1, 1}, {1, 1, 0}}});
  const ContactLines lines = LinesOf({Phantom(testing::ModelOf(room, kGrey))});
  for (const double z : {0.0, 0.5}) {
    EXPECT_TRUE(lines.IsWithin({-1.0F, 1.0F, static_cast<float>(z)}, 0.01));
  }
  EXPECT_TRUE(lines.IsWithin({0.3F, 1.0F, 0.0F}, 0.01));
  EXPECT_FALSE(lines.IsWithin({0.3F, 1.0F, 1.0F}, 0.5)) << "the rim";
}

}  // namespace
}  // namespace pleinair::compositor
