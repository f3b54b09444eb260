#ifndef COMPOSITOR_LINEAR_SHADOW_RATIO_GLSL
#define COMPOSITOR_LINEAR_SHADOW_RATIO_GLSL
// Must match compositor/surfaces/linear_shadow_ratio.h; reads its five texels. Arithmetic only;
// also compiled as C++ (gl/glsl_as_cpp.h, tests/compositor/shaders/shader_twins_test.cc).

struct LinearRatioPoint {
  vec3 position_m;
  vec3 ratio;
};

// Evaluates the linear ratio along a ray from the eye. The ray through a pixel's centre may miss a
// triangle that only one sample shows. It may also meet the triangle's plane behind the eye, or
// nowhere. The ratio stays within the range of the corners, while the position may lie anywhere
// along the ray.
LinearRatioPoint LinearRatioAlong(vec3 eye_m, vec3 ray, vec4 plane, vec4 red, vec4 green, vec4 blue,
                        vec4 range) {
  float facing = dot(vec3(plane), ray);
  facing = abs(facing) > 1e-20f ? facing : 1e-20f;
  float along = (plane.w - dot(vec3(plane), eye_m)) / facing;
  along = clamp(along, 0.0f, 1e6f);
  LinearRatioPoint place;  // Field by field: not every C++ compiler supports GLSL's constructor.
  place.position_m = eye_m + along * ray;
  vec3 ratio = vec3(dot(vec3(red), place.position_m) + red.w,
                    dot(vec3(green), place.position_m) + green.w,
                    dot(vec3(blue), place.position_m) + blue.w);
  place.ratio = clamp(ratio, range.x, range.y);
  return place;
}

#endif
