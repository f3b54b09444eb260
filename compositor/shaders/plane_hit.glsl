#ifndef COMPOSITOR_PLANE_HIT_GLSL
#define COMPOSITOR_PLANE_HIT_GLSL
// Intersects a pixel's ray with a triangle's plane. Arithmetic only; also compiled as C++
// (gl/glsl_as_cpp.h, tests/compositor/shaders/shader_twins_test.cc).

struct PlaneHit {
  float along;  // In units of the ray, from the eye.
  vec3 step_x, step_y;  // Change of the position to the next pixel.
};

// `across`: normal of the plane, any length. `a`, `b`, `c`: the triangle's corners relative to the
// eye. `ray_x`, `ray_y`: change of `ray` to the next pixel.
//
// At the plane's horizon a sample may show the triangle although the ray through the pixel's centre
// runs above it. The ray then meets the plane behind the eye or nowhere. The far end of the
// triangle is used instead, with steps that ignore the plane.
PlaneHit HitPlane(vec3 across, vec3 a, vec3 b, vec3 c, vec3 ray, vec3 ray_x, vec3 ray_y) {
  float facing = dot(across, ray);
  facing = abs(facing) > 1e-20f ? facing : 1e-20f;
  float along = dot(across, a) / facing;
  float far_end = max(max(dot(a, ray), dot(b, ray)), dot(c, ray)) / dot(ray, ray);
  far_end = max(far_end, 0.0f);
  // More than a thousand times the distance of the far end counts as nowhere: squares overflow so
  // near the horizon.
  bool meets = along > 0.0f && along < 1000.0f * far_end;
  along = meets ? along : far_end;
  float tilt_x = meets ? dot(across, ray_x) / facing : 0.0f;
  float tilt_y = meets ? dot(across, ray_y) / facing : 0.0f;
  PlaneHit hit;  // Field by field: not every C++ compiler supports GLSL's constructor.
  hit.along = along;
  hit.step_x = along * (ray_x - ray * tilt_x);
  hit.step_y = along * (ray_y - ray * tilt_y);
  return hit;
}

#endif
