#ifndef COMPOSITOR_SURFACE_GRADIENT_GLSL
#define COMPOSITOR_SURFACE_GRADIENT_GLSL
// Bumps as gradients of a height over the surface (Mikkelsen 2020, "Surface Gradient-Based Bump
// Mapping Framework", JCGT 9 (3)). They need no tangents: the frame of a triangle follows from the
// changes of position and texture coordinates from pixel to pixel. Arithmetic only; also compiled as
// C++ (gl/glsl_as_cpp.h, tests/compositor/shaders/shader_twins_test.cc).
//
// Deviation: the frame is that of the flat triangle, not MikkTSpace's, which is interpolated between
// vertices. The directions of bumps differ by the angle between the triangle and the smooth surface.

// Least z of a normal map's texel: a bump is at most 86 degrees steep.
const float kMinBumpZ = 0.0625f;

// Gradient of a normal map's texel `bump` (x right in the texture, y up, z out), in the coordinates
// of the positions. Arguments: the changes to the next pixel in x and y of position and texture
// coordinates (v down).
vec3 SurfaceGradient(vec3 bump, vec3 position_x, vec3 position_y, vec2 uv_x, vec2 uv_y) {
  float det = uv_x.x * uv_y.y - uv_x.y * uv_y.x;
  float side = det < 0.0f ? -1.0f : 1.0f;
  vec3 along_u = side * (uv_y.y * position_x - uv_x.y * position_y);
  vec3 along_v = side * (uv_x.x * position_y - uv_y.x * position_x);
  vec3 normal = cross(position_x, position_y);
  float size = length(along_u), area = length(normal);
  if (size < 1e-20f || area < 1e-20f) return vec3(0.0f);
  vec3 tangent = along_u / size;
  vec3 up = cross(normal, tangent) / area;
  up *= dot(up, along_v) > 0.0f ? -1.0f : 1.0f;
  return -(bump.x * tangent + bump.y * up) / max(bump.z, kMinBumpZ);
}

// The normal of the surface with its bumps. `gradient` may have a part along the normal, which
// changes nothing.
vec3 BumpedNormal(vec3 normal, vec3 gradient) {
  return normalize(normal - (gradient - normal * dot(gradient, normal)));
}

#endif
