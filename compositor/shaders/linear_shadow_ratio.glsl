#ifndef COMPOSITOR_LINEAR_SHADOW_RATIO_GLSL
#define COMPOSITOR_LINEAR_SHADOW_RATIO_GLSL
// Twin of compositor/surfaces/linear_shadow_ratio.h, from its five texels. Numbers alone; compiled as C++ too
// (gl/glsl_as_cpp.h, tests/compositor/shaders/shader_twins_test.cc).

struct LinearRatioPoint {
  vec3 position_m;
  vec3 ratio;
};

// What a ray from the eye shows. Where it runs beside the triangle, or meets its plane behind the
// eye or nowhere, as the middle of a pixel may of which a sample alone shows the triangle, the ratio
// keeps within its corners', while the place may lie anywhere along the ray.
LinearRatioPoint LinearRatioAlong(vec3 eye_m, vec3 ray, vec4 plane, vec4 red, vec4 green, vec4 blue,
                        vec4 range) {
  float facing = dot(vec3(plane), ray);
  facing = abs(facing) > 1e-20f ? facing : 1e-20f;
  float along = (plane.w - dot(vec3(plane), eye_m)) / facing;
  along = clamp(along, 0.0f, 1e6f);
  LinearRatioPoint place;  // Field by field: not every C++ compiler knows GLSL's constructor.
  place.position_m = eye_m + along * ray;
  vec3 ratio = vec3(dot(vec3(red), place.position_m) + red.w,
                    dot(vec3(green), place.position_m) + green.w,
                    dot(vec3(blue), place.position_m) + blue.w);
  place.ratio = clamp(ratio, range.x, range.y);
  return place;
}

#endif
