// Edges that may be visible as edges.
#include "compositor/surfaces/mesh_outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pleinair::compositor {
namespace {

struct Sheet {
  std::vector<glm::vec3> positions, normals;
  std::vector<std::uint32_t> indices;

  /// Two squares with a common edge along y, the second one turned up by `fold` radians. `split`:
  /// the common edge has vertices of both.
  static Sheet Folded(double fold, bool split) {
    const auto c = static_cast<float>(std::cos(fold)), s = static_cast<float>(std::sin(fold));
    Sheet sheet;
    sheet.positions = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {c, 0, s}, {c, 1, s}};
    sheet.normals = {6, glm::vec3(0, 0, 1)};
    std::uint32_t low = 1, high = 2;
    if (split) {
      low = 6;
      high = 7;
      sheet.positions.insert(sheet.positions.end(), {{0, 0, 0}, {-0.0F, 1, 0}});
      sheet.normals.insert(sheet.normals.end(), 2, glm::vec3(-s, 0, c));
    }
    sheet.indices = {0, 1, 2, 0, 2, 3, low, 4, 5, low, 5, high};
    return sheet;
  }
  std::vector<OutlineEdge> Outline(bool all = false) const {
    return OutlineOf(positions, normals, indices, all);
  }
};

std::size_t Pairs(const std::vector<OutlineEdge>& edges) {
  return static_cast<std::size_t>(std::ranges::count_if(
      edges, [](const OutlineEdge& edge) { return edge.other_corner != OutlineEdge::kNone; }));
}

TEST(MeshOutline, HasBordersAndConvexEdgesOnly) {
  EXPECT_EQ(Sheet::Folded(0, false).Outline().size(), 6U) << "borders of a flat sheet";
  EXPECT_EQ(Pairs(Sheet::Folded(-0.2, false).Outline()), 1U) << "bent down: convex";
  EXPECT_EQ(Pairs(Sheet::Folded(0.2, false).Outline()), 0U) << "bent up: concave";
  EXPECT_EQ(Pairs(Sheet::Folded(0.6, false).Outline()), 1U) << "a crease";
  EXPECT_EQ(Pairs(Sheet::Folded(0, false).Outline(true)), 3U) << "with both diagonals";
}

TEST(MeshOutline, WeldsVerticesAndKnowsCreases) {
  const auto creases = [](double degrees) {
    const auto edges = Sheet::Folded(degrees * std::numbers::pi / 180, true).Outline();
    return std::ranges::count_if(edges, [](const OutlineEdge& edge) { return edge.is_crease; });
  };
  EXPECT_EQ(creases(0), 0) << "a seam of texture coordinates";
  EXPECT_EQ(creases(20), 1);
  EXPECT_EQ(creases(-20), 1);
  EXPECT_EQ(Sheet::Folded(0, true).Outline().size(), 6U);
}

TEST(MeshOutline, TakesEachSideOfSheetsThatMeetInOneEdgeAsABorder) {
  Sheet sheet = Sheet::Folded(-0.2, false);
  sheet.positions.emplace_back(0, 0.5, 1);
  sheet.normals.emplace_back(1, 0, 0);
  sheet.indices.insert(sheet.indices.end(), {1, 2, 6});
  EXPECT_EQ(Pairs(sheet.Outline()), 0U);
  EXPECT_EQ(sheet.Outline().size(), 6U + 3U + 2U);
}

TEST(MeshOutline, HasNoEdgesOfWhatHasNoArea) {
  Sheet sheet = Sheet::Folded(0, false);
  sheet.positions.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0, 0);
  sheet.normals.emplace_back(0, 0, 1);
  sheet.indices.insert(sheet.indices.end(), {0, 0, 1, 1, 4, 6});
  EXPECT_EQ(sheet.Outline().size(), 6U);
  EXPECT_TRUE(OutlineOf({}, {}, {}).empty());
}

}  // namespace
}  // namespace pleinair::compositor
