#include "compositor/lens/lens_view.h"

#include <glm/glm.hpp>

namespace pleinair::compositor {

FrameUniforms SeenThroughPlace(const FrameUniforms& frame, const shadows::View& view,
                               const ThinLens& lens, Vec2 place_m) {
  // A point (X, Y, Z) of the camera is drawn at X − u (1 − Z / z_f), which is X in focus.
  glm::dmat4 shear(1.0);
  shear[3] = glm::dvec4(-place_m.x, -place_m.y, 0.0, 1.0);
  shear[2] = glm::dvec4(place_m.x * lens.focus_dioptres, place_m.y * lens.focus_dioptres, 1.0, 0.0);
  FrameUniforms seen = frame;
  seen.clip_from_marker =
      glm::mat4(glm::dmat4(frame.clip_from_marker) * glm::inverse(view.camera_from_marker) * shear *
                view.camera_from_marker);
  const glm::vec3 aside_m(glm::transpose(glm::dmat3(view.camera_from_marker)) *
                          glm::dvec3(place_m.x, place_m.y, 0.0));
  seen.eye_m += aside_m;
  seen.ray[0] -= aside_m * static_cast<float>(lens.focus_dioptres);
  return seen;
}

void SetLensDepth(const gl::GlProgram& program, const shadows::View& view, int samples) {
  program.Set("u_samples", samples);
  program.Set("u_near_dioptres", static_cast<float>(1.0 / view.near_m));
  program.Set("u_far_dioptres", static_cast<float>(1.0 / view.far_m));
}

}  // namespace pleinair::compositor
