#include "app/drape/ink_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace pleinair::app {
namespace {

using Ring = std::vector<glm::vec2>;

Ring Square(float low, float high) {
  return {{low, low}, {high, low}, {high, high}, {low, high}, {low, low}};
}

double SignedArea(const Ring& ring) {
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    area += 0.5 * (ring[i].x * ring[i + 1].y - ring[i].y * ring[i + 1].x);
  }
  return area;
}

TEST(InkShapes, HaveHolesClockwiseWhateverTheFileHas) {
  for (int turned = 0; turned < 16; ++turned) {
    // A square with a hole, an island in the hole, and a square beside them.
    std::vector<Ring> rings{Square(0, 9), Square(1, 8), Square(2, 7), Square(20, 22)};
    for (std::size_t i = 0; i < rings.size(); ++i) {
      if ((turned >> i & 1) != 0) std::reverse(rings[i].begin(), rings[i].end());
    }
    OrientRings(&rings);
    EXPECT_GT(SignedArea(rings[0]), 0.0) << turned;
    EXPECT_LT(SignedArea(rings[1]), 0.0) << turned;
    EXPECT_GT(SignedArea(rings[2]), 0.0) << turned;
    EXPECT_GT(SignedArea(rings[3]), 0.0) << turned;
  }
}

content::DrapedSegment Segment(std::uint32_t feature, double from_x, double to_x) {
  return {.from = {{from_x, 0, 1}},
          .to = {{to_x, 0, 1}},
          .from_arc_m = from_x,
          .to_arc_m = to_x,
          .feature = feature};
}

content::DrapedArea Area(std::uint32_t feature) {
  return {feature, {{{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{0, 0, 0}}}}};
}

TEST(InkShapes, AreInTheOrderOfTheFeaturesWithFillsBelowTheirOutlines) {
  content::DrapedLayer layer;
  layer.segments = {Segment(5, 0, 1), Segment(5, 1, 2), Segment(6, 0, 1), Segment(7, 0, 1)};
  layer.areas = {Area(6), Area(8)};
  scene::InkDescription ink;
  ink.line_width = 0.2;
  ink.fill = LinearRgb{0, 0, 1};
  ink.dash_m = {0.3, 0.1};
  const std::vector<std::optional<LinearRgb>> colors{{}, LinearRgb{0, 1, 0}, {}, {}};
  const auto shapes = InkShapesOf(layer, ink, colors, 5);
  ASSERT_EQ(shapes.size(), 5U);
  EXPECT_EQ(shapes[0].segments.size(), 2U);
  EXPECT_EQ(shapes[0].style.color, ink.color);
  EXPECT_FLOAT_EQ(shapes[0].pen.width_m, 0.2F);
  EXPECT_FLOAT_EQ(shapes[0].pen.dash_m, 0.3F);
  EXPECT_FLOAT_EQ(shapes[0].segments[1].from_arc_m, 1.0F);
  EXPECT_EQ(shapes[1].rings.size(), 1U);
  EXPECT_EQ(shapes[1].style.color, (LinearRgb{0, 0, 1}));
  EXPECT_EQ(shapes[2].style.color, (LinearRgb{0, 1, 0})) << "its own color";
  EXPECT_EQ(shapes[3].style.color, ink.color);
  EXPECT_EQ(shapes[4].rings.size(), 1U) << "an area whose outline is off the phantoms";
}

TEST(InkShapes, OfAnOutlineAloneHaveNoFill) {
  content::DrapedLayer layer;
  layer.segments = {Segment(0, 0, 1)};
  layer.areas = {Area(0)};
  scene::InkDescription ink;
  ink.width_in_px = true;
  ink.line_width = 3.0;
  const auto shapes = InkShapesOf(layer, ink, {}, 0);
  ASSERT_EQ(shapes.size(), 1U);
  EXPECT_TRUE(shapes[0].rings.empty());
  EXPECT_FLOAT_EQ(shapes[0].pen.width_px, 3.0F);
  EXPECT_EQ(shapes[0].pen.width_m, 0.0F);
}

}  // namespace
}  // namespace pleinair::app
