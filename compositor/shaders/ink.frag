#version 450 core
// Ink on the real surfaces of a pixel. Output: what is kept of the camera's light, lit light to add
// and unlit light to add, display-linear. Cells and shapes: compositor/ink/ink_grid.h.
//
// AREAS: some shapes are areas. PAINT: some blend as paint, which needs the surface's light.

#include "compositor/shaders/ink_coverage.glsl"
#include "compositor/shaders/piece_weights.glsl"
#include "compositor/shaders/pixel_pieces.glsl"
#include "compositor/shaders/visible_surface.glsl"

#ifdef PAINT
#ifndef SHADOW_SETS
#define SHADOW_SETS 2  // The first: phantoms alone.
#endif
#include "compositor/shaders/sun_seen.glsl"
#include "shadows/shaders/shadow_visibility.glsl"

uniform vec3 u_to_sun;          // Unit, marker coordinates.
uniform vec3 u_sun_normal_lux;  // Linear Rec.709.
#endif

layout(binding = 24) uniform usampler2D u_ink_cells;    // First entry, number of entries.
layout(binding = 25) uniform usampler2D u_ink_entries;  // InkGrid::Entry.
layout(binding = 26) uniform usampler2D u_ink_parts;    // Numbers of segments.
layout(binding = 27) uniform sampler2D u_ink_segments;  // Two texels each.
layout(binding = 28) uniform sampler2D u_ink_shapes;    // Three texels each: InkPass.

const int kMaxLevels = 16;
uniform vec3 u_levels[kMaxLevels];       // Side of the cells in metres, number of cells along x, y.
uniform float u_first_cells[kMaxLevels];
uniform int u_last_level;
uniform vec2 u_origin_m;
uniform mat4 u_map_from_marker;
uniform float u_blur_px;    // Of the camera, render pixels, standard deviation.
uniform float u_widest_px;  // Of the pens that have pixels; camera pixels.
uniform float u_render_px;  // Render pixels of a camera pixel.

layout(location = 0) out vec4 out_kept;
layout(location = 1) out vec4 out_lit;
layout(location = 2) out vec4 out_unlit;

const int kTexelsPerRow = 4096, kShapesPerRow = 1365;
const uint kMeanBit = 1u << 31;
const int kStain = 0, kPaint = 1, kGlow = 2;  // InkBlend of compositor/ink/ink_shape.h.

struct Ink {
  vec3 kept, lit, unlit;
};

ivec2 TexelOf(int index) { return ivec2(index % kTexelsPerRow, index / kTexelsPerRow); }

/// `light`: of a white diffuse surface there, display-linear.
Ink Over(Ink below, vec4 color, int blend, float share, vec3 light) {
  vec3 kept = blend == kStain ? mix(vec3(1.0), color.rgb, share) : vec3(1.0 - share);
  Ink ink;
  ink.kept = below.kept * kept;
  ink.lit = below.lit * kept;
  ink.unlit = below.unlit * kept;
#ifdef PAINT
  ink.lit += blend == kPaint ? share * color.rgb * light : vec3(0.0);
#endif
  ink.unlit += blend == kGlow ? share * color.rgb : vec3(0.0);
  return ink;
}

Ink InkAt(InkFootprint seen, vec3 light) {
  vec3 place = seen.place;
  vec2 side_x = seen.step_x, side_y = seen.step_y;
  float reach = 0.5 * (length(side_x) + length(side_y));
  // A pen's pixels count along the footprint's mean side.
  float pixel_m = sqrt(max(length(side_x) * length(side_y), 1e-12)) * u_render_px;
  float needed = 2.0 * (reach + 0.5 * u_widest_px * pixel_m) / u_levels[0].x;
  int level = clamp(int(ceil(log2(max(needed, 1.0)))), 0, u_last_level);
  vec3 cells = u_levels[level];
  vec2 cell = clamp(floor((place.xy - u_origin_m) / cells.x), vec2(0.0), cells.yz - 1.0);
  vec2 center = u_origin_m + cells.x * (cell + 0.5);
  int index = int(u_first_cells[level]) + int(cell.y) * int(cells.y) + int(cell.x);
  uvec2 listed = texelFetch(u_ink_cells, TexelOf(index), 0).rg;
  // Footprints beyond the border's cells see no ink.
  vec2 outside = max(abs(place.xy - center) - 0.5 * cells.x, vec2(0.0));
  int entries = max(outside.x, outside.y) > cells.x ? 0 : int(listed.y);
  Ink ink = Ink(vec3(1.0), vec3(0.0), vec3(0.0));
  for (int e = 0; e < entries; ++e) {
    uvec4 entry = texelFetch(u_ink_entries, TexelOf(int(listed.x) + e), 0);
    ivec2 at = ivec2(3 * (int(entry.x) % kShapesPerRow), int(entry.x) / kShapesPerRow);
    vec4 color = texelFetch(u_ink_shapes, at, 0);
    vec4 pen = texelFetch(u_ink_shapes, at + ivec2(1, 0), 0);  // Half widths in m, px; dash, gap.
    vec4 kind = texelFetch(u_ink_shapes, at + ivec2(2, 0), 0);  // Blend, whether it is an area.
    float inside = uintBitsToFloat(entry.w);
    bool is_mean = (entry.z & kMeanBit) != 0u;
    int parts = int(entry.z & ~kMeanBit);
    InkBand band = InkBand(pen.x + pen.y * pixel_m, pen.z, pen.w);
    float beyond = 0.0;
    LineCoverage line = NoCoverage();
    for (int p = 0; p < parts; ++p) {
      int segment = int(texelFetch(u_ink_parts, TexelOf(int(entry.y) + p), 0).r);
      vec4 from = texelFetch(u_ink_segments, TexelOf(2 * segment), 0);
      vec4 to = texelFetch(u_ink_segments, TexelOf(2 * segment) + ivec2(1, 0), 0);
#ifdef AREAS
      inside += CrossingOfEdge(center, place.xy, from.xy, to.xy);
      beyond += CoverageBeyondEdge(place.xy, side_x, side_y, from.xy, to.xy);
#endif
      line = WithSegment(line, CoverageOfSegment(seen, from, to, band));
    }
    float covered = CoverageOfLine(line, band.half_width, reach);
#ifdef AREAS
    covered = kind.y > 0.5 ? clamp(inside + beyond, 0.0, 1.0) : covered;
#endif
    covered = is_mean ? uintBitsToFloat(entry.w) : covered;
    ink = Over(ink, color, int(kind.x), covered * color.a, light);
  }
  return ink;
}

/// `spread`: of the footprint over the pixel's own, by the blur.
InkFootprint FootprintOf(VisibleSurface surface, float spread) {
  // Steeper surfaces are faces, which have no slope.
  const float kLeastUp = 0.2;
  vec3 step_x = spread * mat3(u_map_from_marker) * surface.step_x;
  vec3 step_y = spread * mat3(u_map_from_marker) * surface.step_y;
  vec3 normal = mat3(u_map_from_marker) * surface.flat_normal;
  InkFootprint seen;
  seen.place = (u_map_from_marker * vec4(surface.position_m, 1.0)).xyz;
  seen.step_x = step_x.xy;
  seen.step_y = step_y.xy;
  seen.height = abs(step_x.z) + abs(step_y.z);
  seen.is_face = abs(normal.z) < kLeastUp;
  seen.slope = seen.is_face ? vec2(0.0) : -normal.xy / normal.z;
  return seen;
}

#ifdef PAINT
/// Display-linear light of a white diffuse surface.
vec3 LightOn(VisibleSurface surface, int component) {
  const float kPi = 3.14159265;
  vec3 sun = max(dot(surface.normal, u_to_sun), 0.0) * u_sun_normal_lux;
  sun *= CloudTransmittance(surface.position_m);
  float visible = ShadowVisibility(0, surface.position_m, surface.flat_normal, surface.step_x, surface.step_y);
  FogAir air = AirUpTo(distance(u_eye_m, surface.position_m));
  visible *= SunTransmittanceSeen(surface, component, sun.g * visible, air);
  vec3 irradiance = surface.ambient_without + visible * sun;
  return u_exposure_scale * (air.left * irradiance / kPi + air.light);
}
#endif

void main() {
  uvec4 seen = PiecesOfPixel(ivec2(gl_FragCoord.xy)).seen;
  uint weights = WeightsOfSamples(seen, u_samples);
  Ink ink = Ink(vec3(0.0), vec3(0.0), vec3(0.0));
  float whole = 0.0;
  float spread = sqrt(1.0 + 12.0 * u_blur_px * u_blur_px);  // A box of the same variance.
  do {
    float weight = seen.x != 0u ? WeightOf(weights) / kWeightOfPixel : 0.0;
    uvec4 triangle = TriangleOf(IdOf(seen.x));
    VisibleSurface surface = VisibleSurfaceOf(VertexOf(triangle.x), VertexOf(triangle.y),
                                              VertexOf(triangle.z), gl_FragCoord.xy);
    vec3 light = vec3(0.0);
#ifdef PAINT
    light = LightOn(surface, int(ComponentOf(triangle)));
#endif
    Ink piece = InkAt(FootprintOf(surface, spread), light);
    ink.kept += weight * piece.kept;
    ink.lit += weight * piece.lit;
    ink.unlit += weight * piece.unlit;
    whole += weight;
    seen = uvec4(seen.yzw, 0u);
    weights >>= 8;
  } while (seen.x != 0u);
  out_kept = vec4(ink.kept + (1.0 - whole), 1.0);
  out_lit = vec4(ink.lit, 1.0);
  out_unlit = vec4(ink.unlit, 1.0);
}
