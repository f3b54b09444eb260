#include "app/drape/ink_shapes.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace pleinair::app {
namespace {

using Ring = std::vector<glm::vec2>;

glm::vec3 ToGlm(const Point<World>& at) {
  return {static_cast<float>(at.xyz.x), static_cast<float>(at.xyz.y), static_cast<float>(at.xyz.z)};
}

/// Twice the signed area; positive if counter-clockwise.
double SignedArea(const Ring& ring) {
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    // From the first corner, so that places far from the origin cost no precision.
    const glm::dvec2 a = glm::dvec2(ring[i]) - glm::dvec2(ring[0]);
    const glm::dvec2 b = glm::dvec2(ring[i + 1]) - glm::dvec2(ring[0]);
    area += a.x * b.y - a.y * b.x;
  }
  return area;
}

bool Contains(const Ring& ring, glm::vec2 at) {
  bool inside = false;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const glm::dvec2 a(ring[i]), b(ring[i + 1]);
    if ((a.y <= at.y) == (b.y <= at.y)) continue;
    if (a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x) > at.x) inside = !inside;
  }
  return inside;
}

compositor::InkBlend BlendOf(scene::InkBlend blend) {
  switch (blend) {
    case scene::InkBlend::kPaint:
      return compositor::InkBlend::kPaint;
    case scene::InkBlend::kGlow:
      return compositor::InkBlend::kGlow;
    case scene::InkBlend::kStain:
      return compositor::InkBlend::kStain;
  }
  return compositor::InkBlend::kStain;
}

compositor::InkStyle StyleOf(const scene::InkDescription& ink, const LinearRgb& color) {
  return {color, static_cast<float>(ink.opacity), BlendOf(ink.blend)};
}

compositor::InkPen PenOf(const scene::InkDescription& ink) {
  compositor::InkPen pen;
  (ink.width_in_px ? pen.width_px : pen.width_m) = static_cast<float>(ink.line_width);
  if (ink.dash_m) {
    pen.dash_m = static_cast<float>((*ink.dash_m)[0]);
    pen.gap_m = static_cast<float>((*ink.dash_m)[1]);
  }
  return pen;
}

compositor::InkShape FillOf(const content::DrapedArea& area, const scene::InkDescription& ink) {
  compositor::InkShape shape{.style = StyleOf(ink, *ink.fill)};
  for (const auto& ring : area.rings) {
    Ring& seen = shape.rings.emplace_back();
    for (const Point<World>& at : ring) seen.emplace_back(ToGlm(at));
  }
  OrientRings(&shape.rings);
  return shape;
}

}  // namespace

void OrientRings(std::vector<std::vector<glm::vec2>>* rings) {
  std::vector<bool> is_hole;
  for (std::size_t i = 0; i < rings->size(); ++i) {
    const Ring& ring = (*rings)[i];
    const auto around = std::count_if(rings->begin(), rings->end(), [&](const Ring& other) {
      return &other != &ring && !ring.empty() && Contains(other, ring[0]);
    });
    is_hole.push_back(around % 2 == 1);
  }
  for (std::size_t i = 0; i < rings->size(); ++i) {
    Ring& ring = (*rings)[i];
    if (!ring.empty() && (SignedArea(ring) > 0.0) == is_hole[i]) {
      std::reverse(ring.begin(), ring.end());
    }
  }
}

std::vector<compositor::InkShape> InkShapesOf(const content::DrapedLayer& layer,
                                              const scene::InkDescription& ink,
                                              std::span<const std::optional<LinearRgb>> colors,
                                              std::uint32_t first_feature) {
  std::vector<compositor::InkShape> shapes;
  const compositor::InkPen pen = PenOf(ink);
  auto area = layer.areas.begin();
  const auto fill_up_to = [&](std::uint32_t feature) {
    for (; area != layer.areas.end() && area->feature <= feature; ++area) {
      if (ink.fill) shapes.push_back(FillOf(*area, ink));
    }
  };
  for (auto segment = layer.segments.begin(); segment != layer.segments.end();) {
    const std::uint32_t feature = segment->feature;
    fill_up_to(feature);
    const std::size_t index = feature - first_feature;
    const bool has_own = index < colors.size() && colors[index];
    compositor::InkShape shape{.style = StyleOf(ink, has_own ? *colors[index] : ink.color),
                               .pen = pen};
    for (; segment != layer.segments.end() && segment->feature == feature; ++segment) {
      shape.segments.push_back({ToGlm(segment->from), ToGlm(segment->to),
                                static_cast<float>(segment->from_arc_m),
                                static_cast<float>(segment->to_arc_m)});
    }
    if (ink.line_width > 0.0) shapes.push_back(std::move(shape));
  }
  fill_up_to(~std::uint32_t{0});
  return shapes;
}

}  // namespace pleinair::app
