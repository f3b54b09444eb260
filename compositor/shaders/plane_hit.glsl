#ifndef COMPOSITOR_PLANE_HIT_GLSL
#define COMPOSITOR_PLANE_HIT_GLSL
// Where a pixel's ray meets a triangle's plane. Numbers alone; compiled as C++ too
// (gl/glsl_as_cpp.h, tests/compositor/shaders/shader_twins_test.cc).

struct PlaneHit {
  float along;          // Times the ray, from the eye on.
  vec3 step_x, step_y;  // How far the place moves to the next pixel.
};

// `across`: normal of the plane, any length; `a`, `b`, `c`: the triangle's corners from the eye; `ray`
// and how it changes to the next pixel. A triangle that a sample of the pixel shows at its plane's
// horizon may have the ray through the pixel's middle run above it: it meets the plane behind the eye
// or nowhere, and what the pixel shows lies at the triangle's far end, whose plane tells no step.
PlaneHit HitPlane(vec3 across, vec3 a, vec3 b, vec3 c, vec3 ray, vec3 ray_x, vec3 ray_y) {
  float facing = dot(across, ray);
  facing = abs(facing) > 1e-20f ? facing : 1e-20f;
  float along = dot(across, a) / facing;
  float far_end = max(max(dot(a, ray), dot(b, ray)), dot(c, ray)) / dot(ray, ray);
  far_end = max(far_end, 0.0f);
  // A thousand times as far as the far end is nowhere, too: so near the horizon squares overflow.
  bool meets = along > 0.0f && along < 1000.0f * far_end;
  along = meets ? along : far_end;
  float tilt_x = meets ? dot(across, ray_x) / facing : 0.0f;
  float tilt_y = meets ? dot(across, ray_y) / facing : 0.0f;
  PlaneHit hit;  // Field by field: not every C++ compiler knows GLSL's constructor.
  hit.along = along;
  hit.step_x = along * (ray_x - ray * tilt_x);
  hit.step_y = along * (ray_y - ray * tilt_y);
  return hit;
}

#endif
