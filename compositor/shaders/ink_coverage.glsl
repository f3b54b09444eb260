#ifndef COMPOSITOR_INK_COVERAGE_GLSL
#define COMPOSITOR_INK_COVERAGE_GLSL
// Share of a pixel that ink covers, in closed form. The pixel's footprint is a parallelogram with
// the sides `step_x` and `step_y` on the map, seen from above, metres. Across a direction it counts
// as a box of the same variance. Arithmetic only; also compiled as C++ (gl/glsl_as_cpp.h,
// tests/compositor/ink/ink_coverage_test.cc).

#include "compositor/shaders/winding.glsl"

struct InkFootprint {
  vec3 place;           // The pixel's center on the surface, map coordinates.
  vec2 step_x, step_y;  // Its sides.
  float height;         // By how much the surface rises along both.
  vec2 slope;           // Of the surface, metres up per metre; 0 for faces.
  bool is_face;         // A steep surface: lines lie on it where they climb it.
};

// A line as its segments are drawn.
struct InkBand {
  float half_width, dash, gap;
};

// Whether the surface at a place counts as that of a segment, `away` from it, which has the height
// `z` or differs from it by `differs` at most. The surface is followed along its slope.
bool IsSameSurface(InkFootprint seen, vec2 away, float z, float differs) {
  float there = seen.place.z - dot(seen.slope, away);
  float leeway = seen.is_face ? 0.0f : 0.03f + 0.3f * length(away);
  return abs(there - z) <= leeway + seen.height + differs;
}

// Width of the footprint along a unit vector.
float FootprintAlong(vec2 direction, vec2 step_x, vec2 step_y) {
  vec2 sides = vec2(dot(step_x, direction), dot(step_y, direction));
  return max(length(sides), 1e-6f);
}

// Integral from 0 to `way` of a line's dashes, which begin at 0; metres.
float DrawnUpTo(float way, float dash, float gap) {
  float period = dash + gap;
  float whole = floor(way / period);
  return whole * dash + min(way - whole * period, dash);
}

// Mean of the dashes over `width` around `way`; 1 without gaps.
float DashCoverage(float way, float width, float dash, float gap) {
  float period = max(dash + gap, 1e-6f);
  float drawn = max(dash, 1e-6f);
  float mean = (DrawnUpTo(way + 0.5f * width, drawn, period - drawn) -
                DrawnUpTo(way - 0.5f * width, drawn, period - drawn)) / width;
  return gap > 0.0f ? mean : 1.0f;
}

// Share of a box of `width`, `distance` away, that a band of `half_width` to both sides covers.
float BandCoverage(float distance, float half_width, float width) {
  return clamp((half_width - distance) / width + 0.5f, 0.0f, 1.0f) -
         clamp((-half_width - distance) / width + 0.5f, 0.0f, 1.0f);
}

struct LineCoverage {
  float beside;       // By a segment that the pixel's center lies beside, else 0.
  float round_capped; // By a segment with round caps.
  float distance;     // To the segment; large if it is on another surface.
  float flat_capped;  // By a segment that ends flat.
};

// Of several segments: no coverage yet.
LineCoverage NoCoverage() {
  LineCoverage none;
  none.beside = 0.0f;
  none.round_capped = 0.0f;
  none.distance = 1e30f;
  none.flat_capped = 0.0f;
  return none;
}

// Of one more segment of a line. Round ends count where they are nearest: seen along a long
// footprint, farther ones would cover too much.
LineCoverage WithSegment(LineCoverage line, LineCoverage segment) {
  LineCoverage both;
  both.beside = max(line.beside, segment.beside);
  both.round_capped = segment.distance < line.distance ? segment.round_capped : line.round_capped;
  both.distance = min(line.distance, segment.distance);
  both.flat_capped = line.flat_capped + segment.flat_capped;
  return both;
}

// Of a segment with the extent of a point seen from above: a disc, or a line up a vertical face.
LineCoverage CoverageOfPoint(InkFootprint seen, vec4 from, vec4 to, InkBand band) {
  vec2 step_x = seen.step_x, step_y = seen.step_y;
  vec3 place = seen.place;
  vec2 away = vec2(place.x - from.x, place.y - from.y);
  float low = min(from.z, to.z), high = max(from.z, to.z);
  bool climbs = high - low > 1e-4f;
  // A vertical face is a line, along which its footprint lies.
  vec2 longer = dot(step_x, step_x) > dot(step_y, step_y) ? step_x : step_y;
  float size = length(longer);
  vec2 along_face = size > 1e-9f ? longer / size : vec2(1.0f, 0.0f);
  float distance = climbs ? abs(dot(away, along_face)) : length(away);
  vec2 direction = climbs || distance < 1e-9f ? along_face : away / max(distance, 1e-9f);
  float height = max(seen.height, 1e-6f);
  float climbed = clamp(abs(place.z - from.z), 0.0f, high - low);
  float dashes = DashCoverage(from.w + climbed, height, band.dash, band.gap);
  float overlap = (clamp(place.z + 0.5f * height, low, high) - clamp(place.z - 0.5f * height, low, high)) / height;
  // A line climbs its own face alone: other faces, and level ground, are not along it.
  float aside = length(away - dot(away, along_face) * along_face);
  bool on_face = seen.is_face && aside <= 0.03f && max(low - place.z, place.z - high) <= seen.height;
  bool same = climbs ? on_face : IsSameSurface(seen, away, from.z, 0.0f);
  float across = BandCoverage(distance, band.half_width, FootprintAlong(direction, step_x, step_y));
  float footprint = max(abs(step_x.x * step_y.y - step_x.y * step_y.x), 1e-12f);
  float disc = min(3.14159265f * band.half_width * band.half_width / footprint, 1.0f) *
               (distance < 0.5f * FootprintAlong(direction, step_x, step_y) ? 1.0f : 0.0f);
  float visible = same ? (climbs ? dashes : 1.0f) : 0.0f;
  LineCoverage covered;
  covered.beside = climbs ? visible * across * overlap : 0.0f;
  covered.round_capped = climbs ? covered.beside : visible * across;
  covered.distance = same ? distance : 1e30f;
  covered.flat_capped = climbs ? covered.beside : visible * disc;
  return covered;
}

// Of a segment with an extent seen from above.
LineCoverage CoverageOfWay(InkFootprint seen, vec4 from, vec4 to, InkBand band) {
  vec2 step_x = seen.step_x, step_y = seen.step_y;
  vec2 at = vec2(seen.place.x - from.x, seen.place.y - from.y);
  vec2 whole = vec2(to.x - from.x, to.y - from.y);
  float size = max(length(whole), 1e-6f);
  vec2 along = whole / size;
  vec2 across = vec2(-along.y, along.x);
  float way = dot(at, along);
  float inside = clamp(way, 0.0f, size);
  vec2 away = at - inside * along;
  float distance = length(away);
  // Beside the segment, the distance is across it, also where that is 0.
  bool beside = way >= 0.0f && way <= size;
  vec2 direction = beside || distance < 1e-9f ? across : away / max(distance, 1e-9f);
  float share = inside / size;
  float footprint = FootprintAlong(along, step_x, step_y);
  float length_m = length(vec2(size, to.z - from.z));
  float dashes = DashCoverage(from.w + share * length_m, footprint, band.dash, band.gap);
  // Other surfaces above or below the line show none of it.
  bool same = IsSameSurface(seen, away, mix(from.z, to.z, share), to.w);
  float visible = same ? dashes : 0.0f;
  LineCoverage covered;
  covered.round_capped =
      visible * BandCoverage(distance, band.half_width, FootprintAlong(direction, step_x, step_y));
  covered.beside = beside ? covered.round_capped : 0.0f;
  covered.distance = same ? distance : 1e30f;
  float overlap = clamp(way + 0.5f * footprint, 0.0f, size) - clamp(way - 0.5f * footprint, 0.0f, size);
  covered.flat_capped = visible * overlap / footprint *
                        BandCoverage(abs(dot(at, across)), band.half_width, FootprintAlong(across, step_x, step_y));
  return covered;
}

// `from`, `to`: InkPart of compositor/ink/ink_segments.h. Metres.
LineCoverage CoverageOfSegment(InkFootprint seen, vec4 from, vec4 to, InkBand band) {
  float size = length(vec2(to.x - from.x, to.y - from.y));
  bool is_point = size <= max(1e-6f, 1e-3f * abs(to.z - from.z));
  LineCoverage covered;
  if (is_point) {
    covered = CoverageOfPoint(seen, from, to, band);
  } else {
    covered = CoverageOfWay(seen, from, to, band);
  }
  return covered;
}

// From all segments of a line. Lines as wide as the footprint have round joints; of thinner ones,
// short pieces count by their lengths. `reach`: half of the footprint's extent.
float CoverageOfLine(LineCoverage line, float half_width, float reach) {
  float wide = smoothstep(0.5f, 1.0f, half_width / max(reach, 1e-6f));
  return mix(min(line.flat_capped, 1.0f), max(line.beside, line.round_capped), wide);
}

// Change of an area's coverage, from the winding number at the footprint's center, by what lies
// beyond an edge. Areas are to the left of their edges.
float CoverageBeyondEdge(vec2 place, vec2 step_x, vec2 step_y, vec2 from, vec2 to) {
  vec2 whole = to - from;
  float size = max(length(whole), 1e-6f);
  vec2 along = whole / size;
  float side = SideOfEdge(from, to, place);
  float footprint = FootprintAlong(along, step_x, step_y);
  float way = dot(place - from, along);
  float overlap = clamp(way + 0.5f * footprint, 0.0f, size) - clamp(way - 0.5f * footprint, 0.0f, size);
  float across = FootprintAlong(vec2(-along.y, along.x), step_x, step_y);
  float beyond = clamp(0.5f - abs(side) / size / across, 0.0f, 1.0f) * overlap / footprint;
  return side >= 0.0f ? -beyond : beyond;
}

#endif
