#include "compositor/passes/frame_uniforms.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pleinair::compositor {
namespace {

// Half of an 8-bit step at black, sRGB. Less airlight changes no image.
constexpr float kNoticeableAir = 0.5F / 255.0F / 12.92F;

}  // namespace

bool FrameUniforms::IsNoticed(const glm::vec3& airlight) const {
  const glm::vec3 shown = exposure_scale * airlight;
  return std::max({shown.r, shown.g, shown.b}) > kNoticeableAir;
}

FrameUniforms FrameUniforms::SeenThrough(glm::vec2 offset_px, glm::vec2 size_px, int number,
                                         int count) const {
  FrameUniforms frame = *this;
  frame.place = {1.0F / std::sqrt(static_cast<float>(count)), number, count, place.behind};
  frame.ray[0] += offset_px.x * ray[1] + offset_px.y * ray[2];
  glm::mat4 shift(1.0F);  // By the homogeneous coordinate, in clip space.
  shift[3] = {-2.0F * offset_px.x / size_px.x, -2.0F * offset_px.y / size_px.y, 0.0F, 1.0F};
  frame.clip_from_marker = shift * clip_from_marker;
  return frame;
}

void FrameUniforms::Set(const gl::GlProgram& program) const {
  program.Set("u_eye_m", eye_m);
  program.Set("u_exposure_scale", exposure_scale);
  program.Set("u_to_sun", to_sun);
  program.Set("u_sun_normal_lux", sun_normal_lux);
}

void FrameUniforms::DrawSides(const gl::GlProgram& program,
                              const std::function<void()>& draw) const {
  program.Set("u_clip_from_marker", clip_from_marker);
  const BehindNearest& behind = place.behind;
  if (behind.dioptres == nullptr) {
    draw();
    return;
  }
  behind.dioptres->Bind(23);
  program.Set("u_near_dioptres", behind.near_dioptres);
  program.Set("u_far_dioptres", behind.far_dioptres);
  glDisable(GL_CULL_FACE);
  draw();
  glEnable(GL_CULL_FACE);
}

void FrameUniforms::SetRays(const gl::GlProgram& program) const {
  program.Set("u_ray", ray[0]);
  program.Set("u_ray_x", ray[1]);
  program.Set("u_ray_y", ray[2]);
  program.Set("u_place_side", place.side);
}

void FrameUniforms::SetFog(const gl::GlProgram& program) const {
  program.SetArray("u_fog_split_m",
                   std::vector<float>(fog.distance_m.begin(), fog.distance_m.end()));
  program.SetArray("u_fog_optical_depth",
                   std::vector<glm::vec3>(fog.optical_depth.begin(), fog.optical_depth.end()));
  program.SetArray("u_fog_inscattered",
                   std::vector<glm::vec3>(fog.inscattered.begin(), fog.inscattered.end()));
}

void FrameUniforms::SetEnvironment(const gl::GlProgram& program) const {
  program.Set("u_sky_mix", environment.sky_mix);
  program.Set("u_below_mix", environment.below_mix);
  program.Set("u_up", environment.up);
}

void FrameUniforms::SetSunTransmittance(const gl::GlProgram& program) const {
  program.Set("u_sun_transmittance_s", shade_from_marker[0][0]);
  program.Set("u_sun_transmittance_t", shade_from_marker[0][1]);
  program.Set("u_cloud_transmittance_s", shade_from_marker[1][0]);
  program.Set("u_cloud_transmittance_t", shade_from_marker[1][1]);
}

}  // namespace pleinair::compositor
