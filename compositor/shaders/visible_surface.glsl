#ifndef COMPOSITOR_VISIBLE_SURFACE_GLSL
#define COMPOSITOR_VISIBLE_SURFACE_GLSL
// Surface attributes at a pixel, from its triangle number. They are those that a rasteriser
// interpolates, evaluated once per pixel for any number of triangles.

#include "compositor/shaders/plane_hit.glsl"
#include "compositor/shaders/visibility_buffer.glsl"

uniform vec3 u_eye_m;  // Centre of projection, marker coordinates.
// Ray through gl_FragCoord (x, y): u_ray + x u_ray_x + y u_ray_y. Marker coordinates, not unit.
uniform vec3 u_ray;
uniform vec3 u_ray_x;
uniform vec3 u_ray_y;
uniform float u_place_side = 1.0;  // Side of the part of the pixel that is shaded, pixels.

struct VisibleSurface {
  vec3 position_m, normal;
  vec3 flat_normal;  // Normal of the triangle on the side of `normal`; unit.
  vec3 step_x, step_y;  // Change of the position along the sides of the shaded part, metres.
  vec3 ambient_with, ambient_without;
  vec3 lift;  // To the curved surface that the normals describe, where that is farther out.
};

// Share of the way from a point of a triangle to the tangent plane of one of its corners, if that
// lies above (Hanika 2021, "Hacking the shadow terminator", Ray Tracing Gems II).
vec3 Bulge(BufferVertex corner, vec3 point, float share) {
  return share * max(dot(corner.position_m - point, corner.normal), 0.0) * corner.normal;
}

VisibleSurface VisibleSurfaceOf(BufferVertex a, BufferVertex b, BufferVertex c, vec2 pixel) {
  vec3 ab = b.position_m - a.position_m, ac = c.position_m - a.position_m;
  vec3 across = cross(ab, ac);
  vec3 ray = u_ray + pixel.x * u_ray_x + pixel.y * u_ray_y;
  PlaneHit hit = HitPlane(across, a.position_m - u_eye_m, b.position_m - u_eye_m,
                          c.position_m - u_eye_m, ray, u_ray_x, u_ray_y);
  VisibleSurface seen;
  seen.position_m = u_eye_m + hit.along * ray;
  seen.step_x = u_place_side * hit.step_x;
  seen.step_y = u_place_side * hit.step_y;

  // Barycentric coordinates. The ray through the pixel's centre may miss the triangle that a sample
  // shows. Light is therefore not extrapolated beyond the triangle. The position moves beyond it by
  // no more than the pixel's reach.
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
  seen.lift = Bulge(a, inside, share.x) + Bulge(b, inside, share.y) + Bulge(c, inside, share.z);
  return seen;
}

#endif
