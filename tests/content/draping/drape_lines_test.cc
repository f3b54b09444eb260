// Draped lines: against analytic fields, small worlds whose heights are known, and all triangles
// tried one by one.
#include "content/draping/drape_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/content/draping/made_surfaces.h"
#include "tests/temporary_folder.h"

namespace pleinair::content {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using tests::Hills;
using tests::IndexOf;
using tests::LineOf;
using tests::MeshMaker;
using tests::RandomLine;
using tests::TriedHeight;

std::vector<Vec3> PointsOf(const DrapedPiece& piece) {
  std::vector<Vec3> points;
  points.reserve(piece.vertices.size());
  for (const DrapedVertex& vertex : piece.vertices) points.push_back(vertex.at.xyz);
  return points;
}

/// Heights along a piece, rounded to 1 mm, as distance along x and height.
std::vector<std::pair<double, double>> SectionOf(const DrapedPiece& piece) {
  std::vector<std::pair<double, double>> section;
  for (const Vec3& point : PointsOf(piece)) {
    section.emplace_back(std::round(point.x * 1e3) / 1e3, std::round(point.z * 1e3) / 1e3);
  }
  return section;
}

TEST(DrapeLines, LieInTheTriangulationOfAField) {
  MeshMaker maker;
  maker.Field(60, 50.0, Hills);
  const SurfaceIndex index = IndexOf(maker.Take());
  std::mt19937 random(7);
  std::vector<LineToDrape> lines;
  lines.reserve(20);
  for (int i = 0; i < 20; ++i) lines.push_back(RandomLine(&random, 49.0, 6));
  const DrapedPieces draped = DrapeLines(lines, index, {});
  ASSERT_EQ(draped.pieces.size(), lines.size());
  EXPECT_EQ(draped.report.off_target, 0U);
  EXPECT_EQ(draped.report.vertices_in, 120U);
  double worst_vertex = 0.0, worst_gap = 0.0, worst_of_file = 0.0;
  for (const DrapedPiece& piece : draped.pieces) {
    const std::vector<Vec3> points = PointsOf(piece);
    std::size_t of_file = 0;
    for (const DrapedVertex& vertex : piece.vertices) {
      const Vec3& at = vertex.at.xyz;
      const auto height = TriedHeight(index.mesh(), {at.x, at.y}, {}, 1e-9);
      ASSERT_TRUE(height);
      worst_vertex = std::max(worst_vertex, std::fabs(at.z - *height));
      of_file += vertex.of_file ? 1 : 0;
    }
    EXPECT_EQ(of_file, 6U);
    for (int i = 0; i < 1000; ++i) {
      const double at = (points.size() - 1) * (i + 0.5) / 1000.0;
      const auto k = static_cast<std::size_t>(at);
      const Vec3 sample = points[k] + (points[k + 1] - points[k]) * (at - k);
      worst_gap =
          std::max(worst_gap, std::fabs(sample.z - *index.HeightAt({sample.x, sample.y}, {})));
    }
    // A line with the vertices of the file alone.
    for (std::size_t k = 1; k < 6; ++k) {
      const Vec3 a = lines[piece.line].points[k - 1].xyz, b = lines[piece.line].points[k].xyz;
      const Vec3 m = (a + b) * 0.5;
      const double chord =
          0.5 * (*index.HeightAt({a.x, a.y}, {}) + *index.HeightAt({b.x, b.y}, {}));
      worst_of_file = std::max(worst_of_file, std::fabs(chord - *index.HeightAt({m.x, m.y}, {})));
    }
  }
  // Corners within 1 um of a line count as on it.
  EXPECT_LE(worst_vertex, 1e-6);
  EXPECT_LE(worst_gap, 1e-6);
  EXPECT_GT(worst_of_file, 0.1);
}

TEST(DrapeLines, HaveAVertexAtEachCrossedEdgeAndNoOther) {
  MeshMaker maker;
  maker.Quad({0, 0, 0}, {2, 0, 1}, {2, 2, 0}, {0, 2, 3});  // The diagonal goes from (0,0) to (2,2).
  const SurfaceIndex index = IndexOf(maker.Take());
  const std::vector lines{LineOf({{0.5, 1.5, 0}, {1.5, 0.5, 0}})};
  const DrapedPieces draped = DrapeLines(lines, index, {});
  ASSERT_EQ(draped.pieces.size(), 1U);
  const std::vector<DrapedVertex>& vertices = draped.pieces[0].vertices;
  ASSERT_EQ(vertices.size(), 3U);
  EXPECT_TRUE(vertices[0].of_file);
  EXPECT_FALSE(vertices[1].of_file);
  EXPECT_TRUE(vertices[2].of_file);
  EXPECT_NEAR(vertices[0].at.xyz.z, 1.5, 1e-12);
  EXPECT_NEAR(vertices[1].at.xyz.z, 0.0, 1e-12);
  EXPECT_NEAR(vertices[2].at.xyz.z, 0.5, 1e-12);
}

TEST(DrapeLines, FollowEdgesAndPassThroughCorners) {
  MeshMaker maker;
  maker.Field(10, 5.0, [](double x, double y) { return 0.3 * std::fabs(x) + 0.1 * y; });
  const SurfaceIndex index = IndexOf(maker.Take());
  const std::vector lines{
      LineOf({{-5, 0, 0}, {5, 0, 0}}),                     // Along edges, from border to border.
      LineOf({{0, -5, 0}, {0, 5, 0}}),                     // Along the ridge.
      LineOf({{-5, -5, 0}, {5, 5, 0}}),                    // Along diagonals, through corners.
      LineOf({{-5, 5, 0}, {5, 5, 0}}),                     // Along the border.
      LineOf({{-4, -3, 0}, {-3, -3, 0}, {-3, -2, 0}}),     // Vertices on corners.
      LineOf({{-4.5, -3.25, 0}, {3, 1, 0}, {-2, 4.5, 0}})  // Otherwise.
  };
  const DrapedPieces draped = DrapeLines(lines, index, {});
  ASSERT_EQ(draped.pieces.size(), lines.size());
  EXPECT_EQ(draped.report.off_target, 0U);
  for (const DrapedPiece& piece : draped.pieces) {
    for (const DrapedVertex& vertex : piece.vertices) {
      const Vec3& at = vertex.at.xyz;
      EXPECT_NEAR(at.z, 0.3 * std::fabs(at.x) + 0.1 * at.y, 1e-9);
    }
    const Vec3 end = piece.vertices.back().at.xyz;
    const Vec3 wanted = lines[piece.line].points.back().xyz;
    EXPECT_EQ(end.x, wanted.x);
    EXPECT_EQ(end.y, wanted.y);
  }
  EXPECT_EQ(draped.pieces[0].vertices.size(), 11U);
  EXPECT_EQ(draped.pieces[4].vertices.size(), 3U);
}

TEST(DrapeLines, ClimbTheWallsOfABox) {
  MeshMaker maker;
  maker.Quad({-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0});
  maker.Box({-2, -3, 0.001}, {2, 3, 1.5});
  const SurfaceIndex index = IndexOf(maker.Take());
  const std::vector lines{LineOf({{-6, -0.5, 0}, {6, -0.5, 0}})};
  const DrapedPieces draped = DrapeLines(lines, index, {});
  ASSERT_EQ(draped.pieces.size(), 1U);
  const auto section = SectionOf(draped.pieces[0]);
  const auto has = [&](double x, double z) {
    return std::count(section.begin(), section.end(), std::pair(x, z));
  };
  EXPECT_EQ(has(-2.0, 0.0), 1);
  EXPECT_EQ(has(-2.0, 1.5), 1);
  EXPECT_EQ(has(2.0, 1.5), 1);
  EXPECT_EQ(has(2.0, 0.0), 1);
  const DrapedLayer layer = LayerOf(lines, draped);
  EXPECT_NEAR(layer.segments.back().to_arc_m, 12.0 + 3.0, 1e-9);
  EXPECT_TRUE(layer.segments.front().starts);
  EXPECT_TRUE(layer.segments.back().ends);
  DrapeOptions lowest;
  lowest.on.choice = SurfaceChoice::kLowest;
  const DrapedPieces below = DrapeLines(lines, index, lowest);
  for (const Vec3& point : PointsOf(below.pieces.at(0))) EXPECT_NEAR(point.z, 0.0, 1e-12);
}

// A vertex of the file may lie on the wall itself, and a line may run along it.
TEST(DrapeLines, ClimbAWallAtAVertexOfTheFile) {
  MeshMaker maker;
  maker.Quad({-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0});
  maker.Box({-2, -3, 0}, {2, 3, 1.5});
  const SurfaceIndex index = IndexOf(maker.Take());
  for (const double y : {-0.5, 0.0, 1.0}) {
    const std::vector lines{LineOf({{-6, y, 0}, {-2, y, 0}, {0, y, 0}})};
    const DrapedPieces draped = DrapeLines(lines, index, {});
    ASSERT_EQ(draped.pieces.size(), 1U) << y;
    EXPECT_NEAR(draped.pieces[0].vertices.back().at.xyz.z, 1.5, 1e-12);
    EXPECT_NEAR(LayerOf(lines, draped).segments.back().to_arc_m, 6.0 + 1.5, 1e-9);
  }
  const std::vector along{LineOf({{-2, -6, 0}, {-2, 6, 0}})};
  const DrapedPieces draped = DrapeLines(along, index, {});
  ASSERT_EQ(draped.pieces.size(), 1U);
  EXPECT_NEAR(LayerOf(along, draped).segments.back().to_arc_m, 12.0 + 3.0, 1e-9);
}

TEST(DrapeLines, ClimbOverAWallWithoutThickness) {
  MeshMaker maker;
  maker.Quad({-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0});
  maker.OfSurface(1);
  maker.Quad({1, -3, -0.2}, {1, 3, -0.2}, {1, 3, 2}, {1, -3, 2});
  const SurfaceIndex index = IndexOf(maker.Take());
  const std::vector lines{LineOf({{-6, 1.1, 0}, {6, 1.1, 0}}), LineOf({{1, -5, 0}, {1, 5, 0}})};
  const DrapedPieces draped = DrapeLines(lines, index, {});
  ASSERT_EQ(draped.pieces.size(), 2U);
  const DrapedLayer layer = LayerOf(lines, draped);
  double rise_m = 0.0, highest_m = 0.0;
  for (const DrapedSegment& segment : layer.segments) {
    rise_m += std::fabs(segment.to.xyz.z - segment.from.xyz.z);
    highest_m = std::max(highest_m, segment.to.xyz.z);
  }
  EXPECT_NEAR(rise_m, 8.0, 1e-9);
  EXPECT_NEAR(highest_m, 2.0, 1e-12);
  // On the wall alone.
  DrapeOptions named;
  named.on = {SurfaceChoice::kNamed, 1};
  const DrapedPieces on_wall = DrapeLines(lines, index, named);
  ASSERT_EQ(on_wall.pieces.size(), 2U);
  EXPECT_THAT(SectionOf(on_wall.pieces[0]), ElementsAre(std::pair(1.0, -0.2), std::pair(1.0, 2.0)));
  for (const Vec3& point : PointsOf(on_wall.pieces[1])) {
    EXPECT_NEAR(point.x, 1.0, 1e-12);
    EXPECT_LE(std::fabs(point.y), 3.0 + 1e-9);
  }
  DrapeOptions lowest;
  lowest.on.choice = SurfaceChoice::kLowest;
  const DrapedPieces below = DrapeLines(lines, index, lowest);
  for (const DrapedPiece& piece : below.pieces) {
    for (const Vec3& point : PointsOf(piece)) EXPECT_NEAR(point.z, 0.0, 1e-12);
  }
}

// A deck without railings has no face at its ends: the line is broken there.
TEST(DrapeLines, AreChosenOnABridgeByTheRule) {
  MeshMaker maker;
  maker.Field(20, 20.0, [](double x, double) { return 0.05 * x; });
  maker.OfSurface(1);
  maker.Quad({-5, -2, 4}, {5, -2, 4}, {5, 2, 4}, {-5, 2, 4});
  const SurfaceIndex index = IndexOf(maker.Take());
  const std::vector lines{LineOf({{-10, 0.1, 0}, {10, 0.3, 0}})};
  const DrapedPieces top = DrapeLines(lines, index, {});
  ASSERT_EQ(top.pieces.size(), 3U);
  EXPECT_EQ(top.report.off_target, 0U);
  for (const Vec3& point : PointsOf(top.pieces[1])) EXPECT_NEAR(point.z, 4.0, 1e-12);
  EXPECT_NEAR(top.pieces[1].vertices.front().at.xyz.x, -5.0, 1e-9);
  EXPECT_NEAR(top.pieces[1].vertices.back().at.xyz.x, 5.0, 1e-9);
  for (const std::size_t ground : {std::size_t{0}, std::size_t{2}}) {
    for (const Vec3& point : PointsOf(top.pieces[ground])) {
      EXPECT_NEAR(point.z, 0.05 * point.x, 1e-9);
    }
  }
  DrapeOptions options;
  options.on.choice = SurfaceChoice::kLowest;
  const DrapedPieces lowest = DrapeLines(lines, index, options);
  ASSERT_EQ(lowest.pieces.size(), 1U);
  for (const Vec3& point : PointsOf(lowest.pieces[0])) EXPECT_NEAR(point.z, 0.05 * point.x, 1e-9);
  options.on = {SurfaceChoice::kNamed, 1};
  const DrapedPieces deck = DrapeLines(lines, index, options);
  ASSERT_EQ(deck.pieces.size(), 1U);
  EXPECT_EQ(deck.report.off_target, 2U);
  for (const DrapedVertex& vertex : deck.pieces[0].vertices) {
    EXPECT_FALSE(vertex.of_file);
    EXPECT_NEAR(vertex.at.xyz.z, 4.0, 1e-12);
  }
}

TEST(DrapeLines, BendWhereTwoSurfacesIntersect) {
  MeshMaker maker;
  maker.Quad({-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0});
  maker.Quad({-10, -9, -2}, {10, -9, 2}, {10, 9, 2}, {-10, 9, -2});
  const SurfaceIndex index = IndexOf(maker.Take());
  const std::vector lines{LineOf({{-8, 1.5, 0}, {8, 1.5, 0}})};
  const DrapedPieces draped = DrapeLines(lines, index, {});
  ASSERT_EQ(draped.pieces.size(), 1U);
  EXPECT_THAT(SectionOf(draped.pieces[0]), ::testing::Contains(std::pair(0.0, 0.0)));
  for (const Vec3& point : PointsOf(draped.pieces[0])) {
    EXPECT_NEAR(point.z, std::max(0.0, 0.2 * point.x), 1e-9);
  }
}

TEST(DrapeLines, LeaveOutWhatIsOffTheSurfaceAndCountIt) {
  MeshMaker maker;
  maker.Quad({0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 4, 1});
  maker.Quad({6, 0, 1}, {10, 0, 1}, {10, 4, 1}, {6, 4, 1});
  const SurfaceIndex index = IndexOf(maker.Take());
  const auto off = [&](std::vector<Vec3> points) {
    const std::vector lines{LineOf(std::move(points))};
    const DrapedPieces draped = DrapeLines(lines, index, {});
    return std::pair(draped.pieces.size(), draped.report.off_target);
  };
  EXPECT_EQ(off({{1, 2, 0}, {9, 2, 0}}), std::pair(std::size_t{2}, std::size_t{1}));
  EXPECT_EQ(off({{1, 2, 0}, {5, 2, 0}, {9, 2, 0}}), std::pair(std::size_t{2}, std::size_t{1}));
  EXPECT_EQ(off({{-1, 2, 0}, {1, 2, 0}}), std::pair(std::size_t{1}, std::size_t{1}));
  EXPECT_EQ(off({{-1, 2, 0}, {11, 2, 0}}), std::pair(std::size_t{2}, std::size_t{3}));
  EXPECT_EQ(off({{1, 2, 0}, {5, 2, 0}, {5, 3, 0}}), std::pair(std::size_t{1}, std::size_t{2}));
  EXPECT_EQ(off({{5, 2, 0}}), std::pair(std::size_t{0}, std::size_t{1}));
  EXPECT_EQ(off({{2, 2, 0}, {2, 2, 0}}), std::pair(std::size_t{1}, std::size_t{0}));
}

TEST(DrapeLines, AreCutAtTheRadius) {
  MeshMaker maker;
  maker.Quad({-100, -100, 1}, {100, -100, 1}, {100, 100, 1}, {-100, 100, 1});
  const SurfaceIndex index = IndexOf(maker.Take());
  DrapeOptions options;
  options.radius_m = 50.0;
  const std::vector lines{LineOf({{0, 0, 0}, {80, 0, 0}, {80, 5, 0}}),
                          LineOf({{-90, 30, 0}, {90, 30, 0}}),
                          LineOf({{1e3, 0, -12.7e6}, {1, 0, 0}})};
  const DrapedPieces draped = DrapeLines(lines, index, options);
  EXPECT_EQ(draped.report.clipped, 5U);
  ASSERT_EQ(draped.pieces.size(), 2U);
  EXPECT_NEAR(draped.pieces[0].vertices.back().at.xyz.x, 50.0, 1e-9);
  EXPECT_NEAR(draped.pieces[1].vertices.front().at.xyz.x, -40.0, 1e-9);
  EXPECT_NEAR(draped.pieces[1].vertices.back().at.xyz.x, 40.0, 1e-9);
}

TEST(DrapeLines, CloseRingsWithoutEnds) {
  MeshMaker maker;
  maker.Field(7, 10.0, Hills);
  const SurfaceIndex index = IndexOf(maker.Take());
  const std::vector lines{
      LineOf({{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}, {-5, -5, 0}}, PartKind::kRing, 3),
      LineOf({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, -1, 0}}, PartKind::kRing, 3),
      LineOf({{0, 0, 0}, {20, 0, 0}, {20, 20, 0}, {0, 0, 0}}, PartKind::kRing, 4)};
  const auto layer = DrapeExactly(lines, index, {}, "map");
  ASSERT_TRUE(layer);
  ASSERT_EQ(layer->areas.size(), 2U);
  EXPECT_EQ(layer->areas[0].rings.size(), 2U);
  for (const DrapedArea& area : layer->areas) {
    for (const auto& ring : area.rings) EXPECT_EQ(ring.front().xyz, ring.back().xyz);
  }
  // The area keeps its corners where no surface is.
  const auto& cut = layer->areas[1].rings[0];
  for (const Vec2 corner : {Vec2{20, 0}, Vec2{20, 20}}) {
    EXPECT_TRUE(std::any_of(cut.begin(), cut.end(), [&](const Point<World>& p) {
      return p.xyz.x == corner.x && p.xyz.y == corner.y;
    }));
  }
  for (const DrapedSegment& segment : layer->segments) {
    if (segment.feature != 3) continue;
    EXPECT_FALSE(segment.starts || segment.ends);
  }
}

TEST(DrapeLines, StandAboveTheSurfaceOrAtTheirOwnHeights) {
  MeshMaker maker;
  maker.Field(10, 10.0, Hills);
  const SurfaceIndex index = IndexOf(maker.Take());
  std::vector lines{LineOf({{-5, -5, 7}, {5, 4, 8}})};
  lines[0].above_m = -1.5;
  for (const Vec3& point : PointsOf(DrapeLines(lines, index, {}).pieces.at(0))) {
    EXPECT_NEAR(point.z, *TriedHeight(index.mesh(), {point.x, point.y}, {}, 1e-9) - 1.5, 1e-9);
  }
  DrapeOptions own;
  own.own_heights = true;
  const DrapedPieces kept = DrapeLines(lines, index, own);
  ASSERT_EQ(kept.pieces.at(0).vertices.size(), 2U);
  EXPECT_EQ(kept.pieces[0].vertices[1].at.xyz, (Vec3{5, 4, 6.5}));
}

TEST(DrapeLines, RefuseALayerThatNoSurfaceLiesUnder) {
  MeshMaker maker;
  maker.Field(2, 10.0, Hills);
  const SurfaceIndex index = IndexOf(maker.Take());
  EXPECT_THAT(tests::MessageOf(DrapeExactly(std::vector{LineOf({{50, 50, 0}, {60, 50, 0}})}, index,
                                            {}, "plan.gpkg")),
              HasSubstr("plan.gpkg: no surface lies under any vertex"));
  // But an area may be larger than the surface.
  EXPECT_TRUE(DrapeExactly(
      std::vector{LineOf({{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}, {-50, -50, 0}},
                         PartKind::kRing)},
      index, {}, "plan.gpkg"));
}

}  // namespace
}  // namespace pleinair::content
