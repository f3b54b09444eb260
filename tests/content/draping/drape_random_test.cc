// Draped lines and the index of triangles against all triangles tried one by one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "content/draping/drape_lines.h"
#include "tests/content/draping/made_surfaces.h"

namespace pleinair::content {
namespace {

using tests::Hills;
using tests::IndexOf;
using tests::LineOf;
using tests::MeshMaker;
using tests::RandomLine;
using tests::TriedHeight;

// Triangles at random, above and through one another, with corners on a coarse lattice so that
// edges, corners and lines meet.
TEST(DrapeLines, AgreeWithAllTrianglesTriedOneByOne) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const bool lattice = seed % 2 == 0;
    std::uniform_real_distribution<double> place(-8.0, 8.0), height(0.0, 3.0);
    const auto coordinate = [&] { return lattice ? std::round(place(random)) : place(random); };
    MeshMaker maker;
    for (int i = 0; i < 60; ++i) {
      maker.OfSurface(static_cast<std::uint32_t>(i % 3));
      std::uint32_t corners[3];
      for (std::uint32_t& corner : corners) {
        corner = maker.Vertex({coordinate(), coordinate(), height(random)});
      }
      maker.Triangle(corners[0], corners[1], corners[2]);
    }
    const SurfaceIndex index = IndexOf(maker.Take());
    std::vector<LineToDrape> lines;
    lines.reserve(8);
    for (int i = 0; i < 8; ++i) {
      lines.push_back(
          LineOf({{coordinate(), coordinate(), 0}, {coordinate() + 0.5, coordinate(), 0}}));
    }
    for (const SurfaceRule rule :
         {SurfaceRule{SurfaceChoice::kTop, 0}, SurfaceRule{SurfaceChoice::kLowest, 0},
          SurfaceRule{SurfaceChoice::kNamed, 2}}) {
      DrapeOptions options;
      options.on = rule;
      const DrapedPieces draped = DrapeLines(lines, index, options);
      for (std::size_t n = 0; n < lines.size(); ++n) {
        const Vec3 a = lines[n].points[0].xyz, way = lines[n].points[1].xyz - a;
        const double square = way.x * way.x + way.y * way.y;
        for (int k = 0; k < 200; ++k) {
          const double s = (k + 0.37) / 200.0;
          const Vec2 at{a.x + s * way.x, a.y + s * way.y};
          const auto inner = TriedHeight(index.mesh(), at, rule, -1e-5);
          const auto outer = TriedHeight(index.mesh(), at, rule, 1e-5);
          if (inner != outer) continue;  // At an edge.
          std::optional<double> found;
          for (const DrapedPiece& piece : draped.pieces) {
            if (piece.line != n) continue;
            for (std::size_t i = 1; i < piece.vertices.size(); ++i) {
              const Vec3 p = piece.vertices[i - 1].at.xyz, q = piece.vertices[i].at.xyz;
              const double from = ((p.x - a.x) * way.x + (p.y - a.y) * way.y) / square;
              const double to = ((q.x - a.x) * way.x + (q.y - a.y) * way.y) / square;
              if (from < s && s < to) found = p.z + (q.z - p.z) * ((s - from) / (to - from));
            }
          }
          ASSERT_EQ(found.has_value(), outer.has_value()) << "line " << n << " at " << s;
          ASSERT_NEAR(found.value_or(0.0), outer.value_or(0.0), 1e-6)
              << "line " << n << " at " << s;
        }
      }
    }
  }
}

TEST(DrapeLines, AreTheSameForAnyNumberOfThreads) {
  MeshMaker maker;
  maker.Field(40, 50.0, Hills);
  const SurfaceIndex index = IndexOf(maker.Take());
  std::mt19937 random(3);
  std::vector<LineToDrape> lines;
  lines.reserve(500);
  for (int i = 0; i < 500; ++i) lines.push_back(RandomLine(&random, 60.0, 4));
  DrapeOptions one, four;
  one.threads = 1;
  four.threads = 4;
  const DrapedLayer a = LayerOf(lines, DrapeLines(lines, index, one));
  const DrapedLayer b = LayerOf(lines, DrapeLines(lines, index, four));
  ASSERT_EQ(a.segments.size(), b.segments.size());
  for (std::size_t i = 0; i < a.segments.size(); ++i) {
    ASSERT_EQ(a.segments[i].from.xyz, b.segments[i].from.xyz);
    ASSERT_EQ(a.segments[i].to.xyz, b.segments[i].to.xyz);
    ASSERT_EQ(a.segments[i].to_arc_m, b.segments[i].to_arc_m);
  }
  EXPECT_EQ(a.report.off_target, b.report.off_target);
  EXPECT_GT(a.report.off_target, 0U);
}

TEST(SurfaceIndex, FindsHeightsAsAllTrianglesTriedOneByOne) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-50.0, 50.0);
  MeshMaker maker;
  maker.Field(30, 45.0, Hills);
  maker.OfSurface(1);
  maker.Box({-20, -20, -1}, {20, 15, 6});
  const SurfaceIndex index = IndexOf(maker.Take());
  for (int i = 0; i < 2000; ++i) {
    const Vec2 at{place(random), place(random)};
    for (const SurfaceChoice choice :
         {SurfaceChoice::kTop, SurfaceChoice::kLowest, SurfaceChoice::kNamed}) {
      const SurfaceRule rule{choice, 1};
      const auto found = index.HeightAt(at, rule), tried = TriedHeight(index.mesh(), at, rule);
      ASSERT_EQ(found.has_value(), tried.has_value());
      ASSERT_NEAR(found.value_or(0.0), tried.value_or(0.0), 1e-9);
    }
  }
}

TEST(SurfaceIndex, RefusesMeshesThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3 bad : {Vec3{nan, 0, 0}, Vec3{0, nan, 0}, Vec3{0, 0, nan}, Vec3{0, 1e300, 0}}) {
    MeshMaker maker;
    maker.Quad({0, 0, 0}, {1, 0, 0}, bad, {0, 1, 0});
    EXPECT_FALSE(SurfaceIndex::Create(maker.Take()));
  }
  MeshMaker maker;
  maker.Quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  SurfaceMesh mesh = maker.Take();
  mesh.triangles[1][2] = 4;
  EXPECT_FALSE(SurfaceIndex::Create(std::move(mesh)));
  const auto none = SurfaceIndex::Create({});
  ASSERT_TRUE(none);
  EXPECT_FALSE(none->HeightAt({0, 0}, {}));
}

}  // namespace
}  // namespace pleinair::content
