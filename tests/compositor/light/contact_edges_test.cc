
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "compositor/light/contact_edges.h"
#include "compositor/models/model.h"
#include "compositor/models/placed_model.h"
#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::BoxModel;
using testing::Ground;
using testing::Object;
using testing::Phantom;

constexpr std::array<float, 3> kGrey{0.5F, 0.5F, 0.5F};

ContactEdges LinesOf(const std::vector<PlacedModel>& models, double finest_m = 0.04) {
  std::vector<SurfaceMesh> surfaces;
  for (std::size_t i = 0; i < models.size(); ++i) {
    for (SurfaceMesh& surface : OrientedSurfaces(models[i], static_cast<int>(i))) {
      surfaces.push_back(std::move(surface));
    }
  }
  return {surfaces, [finest_m](const auto&) { return finest_m; }};
}

double TotalLength(const ContactEdges& lines) {
  double total = 0.0;
  for (const auto& segment : lines.segments()) total += Norm(segment.to - segment.from);
  return total;
}

TEST(ContactEdges, GoRoundTheFootOfABox) {
  const ContactEdges lines = LinesOf(
      {Phantom(Ground(3.0, kGrey)), Phantom(BoxModel({0.5, -1.0, 0.0}, {0.8, 1.0, 1.5}, kGrey))});
  // Two triangles of each side intersect one or two of the ground: the foot line, and parts of it
  // again.
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

TEST(ContactEdges, AreFoundAcrossASmallGapAndNotAcrossALargeOne) {
  const auto box = [](double bottom) {
    return Phantom(BoxModel({0.5, -1.0, bottom}, {0.8, 1.0, 1.5}, kGrey));
  };
  const PlacedModel ground = Phantom(Ground(3.0, kGrey));
  EXPECT_FALSE(LinesOf({ground, box(0.01)}).segments().empty());
  EXPECT_FALSE(LinesOf({ground, box(-0.2)}).segments().empty());
  EXPECT_TRUE(LinesOf({ground, box(0.1)}).segments().empty());
}

TEST(ContactEdges, AreNotWhereNothingIsSeenOfTheOtherSurface) {
  // Excluded: a body's own edges, layers of ground, and virtual objects.
  EXPECT_TRUE(LinesOf({Phantom(BoxModel({0, 0, 0}, {1, 1, 1}, kGrey))}).segments().empty());
  EXPECT_TRUE(LinesOf({Phantom(Ground(3.0, kGrey)), Phantom(Ground(1.0, kGrey, false, 0.01))})
                  .segments()
                  .empty());
  EXPECT_TRUE(LinesOf({Phantom(Ground(3.0, kGrey)), Object(BoxModel({0, 0, 0}, {1, 1, 1}, kGrey))})
                  .segments()
                  .empty());
}

TEST(ContactEdges, AreTheInnerEdgesOfARoom) {
  // The six faces of an open cube face each other along its twelve edges (eight without a lid).
  Mesh room;
  testing::AddQuad(&room, {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}});
  testing::AddQuad(&room, {{{-1, -1, 0}, {-1, -1, 1}, {1, -1, 1}, {1, -1, 0}}});
  testing::AddQuad(&room, {{{-1, 1, 0}, {1, 1, 0}, {1, 1, 1}, {-1, 1, 1}}});
  testing::AddQuad(&room, {{{-1, -1, 0}, {-1, 1, 0}, {-1, 1, 1}, {-1, -1, 1}}});
  testing::AddQuad(&room, {{{1, -1, 0}, {1, -1, 1}, {1, 1, 1}, {1, 1, 0}}});
  const ContactEdges lines = LinesOf({Phantom(testing::ModelOf(room, kGrey))});
  for (const double z : {0.0, 0.5}) {
    EXPECT_TRUE(lines.IsWithin({-1.0F, 1.0F, static_cast<float>(z)}, 0.01));
  }
  EXPECT_TRUE(lines.IsWithin({0.3F, 1.0F, 0.0F}, 0.01));
  EXPECT_FALSE(lines.IsWithin({0.3F, 1.0F, 1.0F}, 0.5)) << "the rim";
}

/// Square cards of a side in all orientations, on a grid with this step.
std::shared_ptr<Model> Cards(int count, double side_m, double step_m) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const int column = i % 10, row = i / 10 % 10, layer = i / 100;
    const Vec3 middle = Vec3{column + 0.5, row + 0.5, layer + 0.5} * step_m;
    const double turn = i * std::numbers::phi, tilt = i * std::numbers::sqrt2;
    const Vec3 along{std::cos(turn), std::sin(turn), 0.0};
    const Vec3 across = Vec3{-std::sin(turn), std::cos(turn), 0.0} * std::cos(tilt) +
                        Vec3{0.0, 0.0, std::sin(tilt)};
    const Vec3 u = along * (side_m / 2), v = across * (side_m / 2);
    testing::AddQuad(&mesh, {middle - u - v, middle + u - v, middle + u + v, middle - u + v});
  }
  return testing::ModelOf(std::move(mesh), kGrey);
}

TEST(ContactEdges, AreFewHoweverManyCardsCross) {
  // Cards of 15 cm, 4 cm apart, intersect about forty others each. Cards of 1 m intersect nearly
  // all.
  const ContactEdges some = LinesOf({Phantom(Cards(20, 0.15, 0.04))});
  EXPECT_GT(some.segments().size(), 20U);
  EXPECT_LE(some.segments().size(), ContactEdges::kMaxSegments);
  EXPECT_TRUE(LinesOf({Phantom(Cards(3000, 0.15, 0.04))}).segments().empty());
  EXPECT_TRUE(LinesOf({Phantom(Cards(1500, 1.0, 0.01))}).segments().empty());
}

TEST(ContactEdges, AreNotAmongFineLeavesButWhereTheyTouchAWall) {
  // Intersections of leaves of 5 cm need no further vertices. The foot of the box keeps its line.
  const PlacedModel ground = Phantom(Ground(3.0, kGrey));
  const PlacedModel wall = Phantom(BoxModel({1.0, -1.0, 0.0}, {1.3, 1.0, 1.5}, kGrey));
  PlacedModel leaves = Phantom(Cards(3000, 0.05, 0.02));
  leaves.translation_m = {0.0, 0.0, 0.5};
  const std::size_t bare = LinesOf({ground, wall}, 0.1).segments().size();
  EXPECT_EQ(LinesOf({ground, wall, leaves}, 0.1).segments().size(), bare);
  leaves.translation_m = {0.9, 0.0, 0.5};
  EXPECT_GT(LinesOf({ground, wall, leaves}, 0.1).segments().size(), bare);
}

TEST(ContactEdges, GoRoundABoxOfFineTriangles) {
  // The ground is coarse: it has too few vertices at the foot of any object.
  Mesh fence;
  for (int i = 0; i < 20; ++i) {
    const double x = 0.05 * i;
    testing::AddQuad(&fence, {{{x, 0, 0}, {x + 0.05, 0, 0}, {x + 0.05, 0, 0.05}, {x, 0, 0.05}}});
  }
  const ContactEdges lines =
      LinesOf({Phantom(Ground(3.0, kGrey)), Phantom(testing::ModelOf(fence, kGrey))}, 0.1);
  EXPECT_TRUE(lines.IsWithin({0.52F, 0.01F, 0.0F}, 0.02));
}

TEST(ContactEdges, AreToldOnceWhereSurfacesLieTwice) {
  const PlacedModel ground = Phantom(Ground(3.0, kGrey));
  const PlacedModel box = Phantom(BoxModel({0.5, -1.0, 0.0}, {0.8, 1.0, 1.5}, kGrey));
  EXPECT_EQ(LinesOf({ground, box, box}).segments().size(),
            LinesOf({ground, box}).segments().size());
}

}  // namespace
}  // namespace pleinair::compositor
