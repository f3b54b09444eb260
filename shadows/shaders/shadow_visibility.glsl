// Share of the sun's disc that a point sees. For fragment shaders:
//
//   #define SHADOW_SETS 2              // how many ShadowMaps are bound; 1 by default
//   #define SHADOW_METHOD_GAUSSIAN     // ShadowMaps::ShaderDefines; the sun's disc by default
//   #include "shadows/shaders/shadow_visibility.glsl"
//   float lit = ShadowVisibility(0, position_marker, normal_marker);
//
// Bind the maps with ShadowMaps::Bind(set). `set` must be a constant. Marker coordinates, metres.
#ifndef PLEINAIR_SHADOW_VISIBILITY
#define PLEINAIR_SHADOW_VISIBILITY
// A file is included where it is first named: these must not first be named in a method left out.
#include "shadows/shaders/shadow_formulae.glsl"
#include "shadows/shaders/shadow_lookup.glsl"

#if defined(SHADOW_METHOD_GAUSSIAN) || defined(SHADOW_METHOD_VARIANCE) || \
    defined(SHADOW_METHOD_EXPONENTIAL)
#include "shadows/shaders/shadow_moments.glsl"
#elif defined(SHADOW_METHOD_PLAIN) || defined(SHADOW_METHOD_PCF) || defined(SHADOW_METHOD_PCSS)
#include "shadows/shaders/shadow_filters.glsl"
#else
#ifndef SHADOW_METHOD_SUN_DISC
#define SHADOW_METHOD_SUN_DISC
#endif
#include "shadows/shaders/shadow_sun_disc.glsl"
#endif

// Normal of the flat triangle that the fragment lies on, turned to the side of `normal`. The bias
// of the visibility follows the surface: interpolated normals would make it leak or scar.
vec3 ShadowGeometricNormal(vec3 position, vec3 normal) {
  vec3 flat_normal = cross(dFdx(position), dFdy(position));
  float size = length(flat_normal);
  if (!(size > 1e-20)) return normal;
  return (dot(flat_normal, normal) < 0.0 ? -flat_normal : flat_normal) / size;
}

vec2 ShadowTexel(ShadowSlice s, vec3 position) {
  return vec2(dot(s.u_from_marker.xyz, position) + s.u_from_marker.w,
              dot(s.v_from_marker.xyz, position) + s.v_from_marker.w);
}

// Texels along a map's border that nothing is looked up in: half the widest box of comparisons.
const float kShadowBorder = 4.0;

// The finest slice from `first` on whose window and depths hold the point; -1: none.
int ShadowFinestSlice(int set, vec3 position, int first) {
  int slice = -1;
  for (int i = int(shadow_sets[set].settings.x) - 1; i >= first; --i) {
    ShadowSlice s = shadow_sets[set].slices[i];
    vec2 inside = 0.5 * s.size.z - kShadowBorder - abs(ShadowTexel(s, position) - 0.5 * s.size.z);
    float depth = dot(s.depth_from_marker.xyz, position) + s.depth_from_marker.w;
    if (min(min(inside.x, inside.y), min(depth, s.size.w - depth)) > 0.0) slice = i;
  }
  return slice;
}

// What one slice says of a point.
float ShadowInSlice(int set, int slice, vec3 position, vec3 normal, vec3 step_x, vec3 step_y) {
  float facing = dot(normal, shadow_sets[set].to_sun.xyz);
  ShadowSlice s = shadow_sets[set].slices[slice];
  ShadowReceiver r;
  r.texel = ShadowTexel(s, position);
  r.depth = dot(s.depth_from_marker.xyz, position) + s.depth_from_marker.w;
  // Plane n·Δ = 0 with Δ = a u + b v − Δdepth to_sun.
  vec2 slope = vec2(dot(normal, shadow_sets[set].light_u.xyz),
                    dot(normal, shadow_sets[set].light_v.xyz)) / max(facing, 0.02);
  r.slope = slope * s.size.xy;
  r.step_x = vec2(dot(s.u_from_marker.xyz, step_x), dot(s.v_from_marker.xyz, step_x));
  r.step_y = vec2(dot(s.u_from_marker.xyz, step_y), dot(s.v_from_marker.xyz, step_y));
  r.bias = shadow_sets[set].settings.y + 0.05 * length(r.slope);
#if defined(SHADOW_METHOD_SUN_DISC)
  return ShadowDiscVisibility(set, slice, s.size, r, shadow_sets[set].to_sun.w);
#elif defined(SHADOW_METHOD_PLAIN)
  return ShadowNearest(set, slice, s.size, r);
#elif defined(SHADOW_METHOD_PCF)
  return ShadowBox(set, slice, s.size, r, SHADOW_METHOD_PCF);
#elif defined(SHADOW_METHOD_PCSS)
  return ShadowSoftBox(set, slice, s.size, r, shadow_sets[set].to_sun.w);
#else
  return ShadowFromMoments(set, slice, s.size, r, shadow_sets[set].settings.z);
#endif
}

// Share of the way from a slice's inner edge of its blend band to its border, 0…1.
float ShadowBand(int set, int slice, vec3 position) {
  ShadowSlice s = shadow_sets[set].slices[slice];
  vec2 to_border = 0.5 * s.size.z - abs(ShadowTexel(s, position) - 0.5 * s.size.z);
  float band = shadow_sets[set].settings.w * s.size.z;
  return clamp(1.0 - (min(to_border.x, to_border.y) - kShadowBorder) / max(band, 1e-6), 0.0, 1.0);
}

// Mean over the pixel: `step_x`, `step_y` are how far `position` moves to the next pixel (dFdx,
// dFdy, taken where all pixels run).
float ShadowVisibility(int set, vec3 position, vec3 normal, vec3 step_x, vec3 step_y) {
  int slice = ShadowFinestSlice(set, position, 0);
  int next = ShadowFinestSlice(set, position, slice + 1);
  float coarser = slice >= 0 && next >= 0 ? ShadowBand(set, slice, position) : 0.0;
  // Outside every window nothing casts; a surface turned away is in its own shade. Loops that may
  // not run in place of branches: Mesa's software renderer runs both sides of an `if`.
  bool facing = dot(normal, shadow_sets[set].to_sun.xyz) > 0.0;
  int count = slice < 0 || !facing ? 0 : (coarser > 0.0 ? 2 : 1);
  float visible = slice < 0 && facing ? 1.0 : 0.0;
  for (int i = 0; i < count; ++i) {
    visible += (i == 0 ? 1.0 - coarser : coarser) *
               ShadowInSlice(set, i == 0 ? slice : next, position, normal, step_x, step_y);
  }
  return visible;
}

// At the point alone.
float ShadowVisibility(int set, vec3 position, vec3 normal) {
  return ShadowVisibility(set, position, normal, vec3(0.0), vec3(0.0));
}

// Whether `position` lies in the finest partition of the set's maps. Outside it, maps fitted to a
// region (ShadowMaps::UpdateForRegion) with and without the region's objects give the same.
bool ShadowInFinestPartition(int set, vec3 position) {
  ShadowSlice s = shadow_sets[set].slices[0];
  vec2 texel = ShadowTexel(s, position);
  return all(greaterThan(texel, vec2(0.0))) && all(lessThan(texel, vec2(s.size.z)));
}

#endif
