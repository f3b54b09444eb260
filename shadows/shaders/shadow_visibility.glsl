// Visible share of the sun's disc at a point. For fragment shaders:
//
//   #define SHADOW_SETS 2              // how many ShadowMaps are bound; 1 by default
//   #define SHADOW_METHOD_GAUSSIAN     // ShadowMaps::ShaderDefines; the sun's disc by default
//   #include "shadows/shaders/shadow_visibility.glsl"
//   float lit = ShadowVisibility(0, position_marker, normal_marker);
//
// Bind the maps with ShadowMaps::Bind(set). `set` must be a constant. Marker coordinates, metres.
// SHADOW_CROSS_FADE: each set consists of two, for the sun's steps before and after its position,
// numbered 2 set and 2 set + 1 and cross-faded (FadingShadowMaps); SHADOW_SETS counts both.
#ifndef PLEINAIR_SHADOW_VISIBILITY
#define PLEINAIR_SHADOW_VISIBILITY
// A file is included where it is first named, so these must not be first named in a method that is
// left out.
#include "shadows/shaders/shadow_formulae.glsl"
#include "shadows/shaders/shadow_lookup.glsl"

#if defined(SHADOW_METHOD_GAUSSIAN) || defined(SHADOW_METHOD_VARIANCE) || \
    defined(SHADOW_METHOD_EXPONENTIAL)
#include "shadows/shaders/shadow_moments.glsl"
#elif defined(SHADOW_METHOD_PLAIN) || defined(SHADOW_METHOD_PCF) || defined(SHADOW_METHOD_PCSS)
#include "shadows/shaders/shadow_filters.glsl"
#else
#include "shadows/shaders/shadow_sun_disc.glsl"
#endif

// Normal of the flat triangle of the fragment, on the side of `normal`. The visibility's bias
// follows the surface: interpolated normals would cause leaks or acne.
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

// Unused texels along a map's border: half the widest box of comparisons.
const float kShadowBorder = 4.0;

// Position of a point in a slice.
struct ShadowPlace {
  int slice;  // -1: in none.
  vec2 texel;
  float depth;   // Metres.
  vec4 size;     // As ShadowSlice.
  float inside;  // Distance in texels from the usable area's border.
};

// The finest slice whose window and depths contain the point, and the next one that does. The
// number of slices is a constant, and they are selected by comparisons: Mesa's software renderer
// would fetch a slice chosen by index float by float.
void ShadowPlaces(int set, vec3 position, out ShadowPlace finest, out ShadowPlace next) {
  finest = next = ShadowPlace(-1, vec2(0.0), 0.0, vec4(1.0), 0.0);
  for (int i = SHADOW_PARTITIONS - 1; i >= 0; --i) {
    ShadowPlace p;
    p.slice = i;
    p.size = shadow_sets[set].slices[i].size;
    p.texel = ShadowTexel(shadow_sets[set].slices[i], position);
    p.depth = dot(shadow_sets[set].slices[i].depth_from_marker, vec4(position, 1.0));
    vec2 border = 0.5 * p.size.z - kShadowBorder - abs(p.texel - 0.5 * p.size.z);
    p.inside = min(border.x, border.y);
    bool holds = min(p.inside, min(p.depth, p.size.w - p.depth)) > 0.0;
    next.slice = holds ? finest.slice : next.slice;
    next.texel = holds ? finest.texel : next.texel;
    next.depth = holds ? finest.depth : next.depth;
    next.size = holds ? finest.size : next.size;
    finest.slice = holds ? p.slice : finest.slice;
    finest.texel = holds ? p.texel : finest.texel;
    finest.depth = holds ? p.depth : finest.depth;
    finest.size = holds ? p.size : finest.size;
    finest.inside = holds ? p.inside : finest.inside;
  }
}

// Visibility by one slice. Undefined, at minimum cost, if the slice is not needed.
float ShadowInSlice(int set, ShadowPlace place, vec3 normal, vec3 step_x, vec3 step_y,
                    bool wanted) {
  vec3 light_u = shadow_sets[set].light_u.xyz, light_v = shadow_sets[set].light_v.xyz;
  float facing = ShadowPlaneFacing(dot(normal, shadow_sets[set].to_sun.xyz));
  ShadowReceiver r;
  r.texel = place.texel;
  r.depth = place.depth;
  // Plane n·Δ = 0 with Δ = a u + b v − Δdepth to_sun.
  vec2 slope = vec2(dot(normal, light_u), dot(normal, light_v)) / facing;
  r.slope = slope * place.size.xy;
  r.step_x = vec2(dot(light_u, step_x), dot(light_v, step_x)) / place.size.xy;
  r.step_y = vec2(dot(light_u, step_y), dot(light_v, step_y)) / place.size.xy;
  // Half a texel of slope: the distance of the next facet of a curved surface from this one's
  // plane.
  r.rise = ShadowRise(length(r.slope), facing);
  r.bias = shadow_sets[set].settings.y + 0.5 * r.rise;
#if defined(SHADOW_METHOD_PLAIN)
  return ShadowNearest(set, place.slice, place.size, r);
#elif defined(SHADOW_METHOD_PCF)
  return ShadowBox(set, place.slice, place.size, r, SHADOW_METHOD_PCF);
#elif defined(SHADOW_METHOD_PCSS)
  return ShadowSoftBox(set, place.slice, place.size, r, shadow_sets[set].to_sun.w);
#elif defined(SHADOW_METHOD_GAUSSIAN) || defined(SHADOW_METHOD_VARIANCE) || \
    defined(SHADOW_METHOD_EXPONENTIAL)
  return ShadowFromMoments(set, place.slice, place.size, r, shadow_sets[set].settings.z);
#elif defined(SUN_DISC_SAMPLE)
  return ShadowTap(set, place.slice, place.size, r, r.texel, -1e30);
#elif defined(SUN_DISC_BOX)
  float height, occluders;
  return ShadowDense(set, place.slice, place.size, r, shadow_sets[set].to_sun.w, height, occluders);
#else
  return ShadowDiscVisibility(set, place.slice, place.size, r, shadow_sets[set].to_sun.w, wanted);
#endif
}

// Position in the finest slice's blend band: 1 at its border.
float ShadowCoarser(int set, ShadowPlace finest, ShadowPlace next) {
  float band = max(shadow_sets[set].settings.w * finest.size.z, 1e-6);
  return next.slice >= 0 ? clamp(1.0 - finest.inside / band, 0.0, 1.0) : 0.0;
}

// Index of the partition of a point, −1 for none (debug views).
float ShadowPartition(int set, vec3 position) {
  ShadowPlace finest, next;
  ShadowPlaces(set, position, finest, next);
  return mix(float(finest.slice), float(next.slice), ShadowCoarser(set, finest, next));
}

// Visibility by the maps of one step of the sun.
float ShadowAtStep(int set, vec3 position, vec3 normal, vec3 step_x, vec3 step_y) {
  ShadowPlace finest, next;
  ShadowPlaces(set, position, finest, next);
  int finest_slice = finest.slice;
  float coarser = ShadowCoarser(set, finest, next);
  // Outside all windows nothing casts shadows; a surface facing away is in its own shadow.
  bool facing = ShadowFaces(dot(normal, shadow_sets[set].to_sun.xyz));
  bool look = facing && finest_slice >= 0;
  bool again = coarser > 0.0 && look;
  float visible = 0.0;
  float weight = 1.0 - coarser;
  // Tested at its end: Mesa's software renderer runs a loop's body once more after a test at its
  // beginning fails, and both sides of every `if`.
  bool more;
  do {
    visible += weight * ShadowInSlice(set, finest, normal, step_x, step_y, look);
    more = again;
    again = false;
    finest = next;
    weight = coarser;
  } while (more);
  return !facing ? 0.0 : (finest_slice < 0 ? 1.0 : visible);
}

// Mean visibility over the pixel. `step_x`, `step_y`: change of `position` to the next pixel (dFdx,
// dFdy, to be computed in uniform control flow).
float ShadowVisibility(int set, vec3 position, vec3 normal, vec3 step_x, vec3 step_y) {
#ifdef SHADOW_CROSS_FADE
  return mix(ShadowAtStep(2 * set, position, normal, step_x, step_y),
             ShadowAtStep(2 * set + 1, position, normal, step_x, step_y),
             shadow_sets[2 * set + 1].light_u.w);
#else
  return ShadowAtStep(set, position, normal, step_x, step_y);
#endif
}

// Visibility at the point itself.
float ShadowVisibility(int set, vec3 position, vec3 normal) {
  return ShadowVisibility(set, position, normal, vec3(0.0), vec3(0.0));
}

#endif
