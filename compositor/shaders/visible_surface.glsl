#ifndef COMPOSITOR_VISIBLE_SURFACE_GLSL
#define COMPOSITOR_VISIBLE_SURFACE_GLSL
// What a pixel shows of a surface, from its triangle's number: what a rasteriser would hand to
// a shader, but once for a pixel however many triangles meet in it.

#include "compositor/shaders/plane_hit.glsl"
#include "compositor/shaders/visibility_buffer.glsl"

uniform vec3 u_eye_m;  // Centre of projection, marker coordinates.
// Direction of a pixel's ray at gl_FragCoord, not unit: first + x, y times these. Marker coordinates.
uniform vec3 u_ray;
uniform vec3 u_ray_x;
uniform vec3 u_ray_y;

struct VisibleSurface {
  vec3 position_m, normal;
  vec3 flat_normal;     // Of the triangle, on the side of `normal`; unit.
  vec3 step_x, step_y;  // How far the position moves to the next pixel, metres.
  vec3 ambient_with, ambient_without;
};

VisibleSurface VisibleSurfaceOf(BufferVertex a, BufferVertex b, BufferVertex c, vec2 pixel) {
  vec3 ab = b.position_m - a.position_m, ac = c.position_m - a.position_m;
  vec3 across = cross(ab, ac);
  vec3 ray = u_ray + pixel.x * u_ray_x + pixel.y * u_ray_y;
  PlaneHit hit = HitPlane(across, a.position_m - u_eye_m, b.position_m - u_eye_m,
                          c.position_m - u_eye_m, ray, u_ray_x, u_ray_y);
  VisibleSurface seen;
  seen.position_m = u_eye_m + hit.along * ray;
  seen.step_x = hit.step_x;
  seen.step_y = hit.step_y;

  // Barycentric coordinates. The ray through the pixel's middle may pass beside the triangle that a
  // sample shows: light is not extrapolated to there, where it could be anything, and the place not
  // farther than the pixel reaches.
  vec3 from_a = seen.position_m - a.position_m;
  float area = max(dot(across, across), 1e-30);
  float to_b = dot(cross(from_a, ac), across) / area, to_c = dot(cross(ab, from_a), across) / area;
  vec3 share = clamp(vec3(1.0 - to_b - to_c, to_b, to_c), 0.0, 1.0);
  share /= max(share.x + share.y + share.z, 1e-6);
  vec3 inside = mat3(a.position_m, b.position_m, c.position_m) * share;
  vec3 aside = seen.position_m - inside;
  float reach = length(seen.step_x) + length(seen.step_y);
  seen.position_m = inside + aside * min(reach / max(length(aside), 1e-20), 1.0);
  seen.normal = normalize(mat3(a.normal, b.normal, c.normal) * share);
  float size = length(across);
  seen.flat_normal = size > 1e-20 ? (dot(across, seen.normal) < 0.0 ? -across : across) / size : seen.normal;
  seen.ambient_with = mat3(a.ambient_with, b.ambient_with, c.ambient_with) * share;
  seen.ambient_without = mat3(a.ambient_without, b.ambient_without, c.ambient_without) * share;
  return seen;
}

#endif
