#include "compositor/passes/frame_daylight.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "compositor/light/environment_map.h"
#include "compositor/passes/glm_vectors.h"
#include "compositor/passes/scene_view.h"

namespace pleinair::compositor {
Result<FrameDaylight> FrameDaylight::Create() {
  FrameDaylight light;
  PLEINAIR_ASSIGN_OR_RETURN(
      light.environment_,
      gl::GlTexture::Create2DArray(GL_RGB32F, EnvironmentMap::kWidth, EnvironmentMap::kHeight,
                                   EnvironmentMap::kLevels));
  light.environment_.SetWrap(GL_REPEAT);
  PLEINAIR_RETURN_IF_ERROR(light.trees_.Upload());
  PLEINAIR_RETURN_IF_ERROR(light.clouds_.Upload());
  return light;
}

void FrameDaylight::SetDay(const sky::SkyModel& day, const Mat3& marker_from_world) {
  SetSun(day, marker_from_world);
  air_ = AerialFog(day, marker_from_world);
  up_ = ToGlm(marker_from_world * Vec3{0.0, 0.0, 1.0});
  level_sun_ = day.SunNormalIrradiance() * std::max(0.0, day.ToSun().xyz.z);
  level_sky_ = day.SkyHorizontalIrradiance();
  mix_ = {};
}

void FrameDaylight::SetSun(const sky::SkyModel& day, const Mat3& marker_from_world) {
  to_sun_ = marker_from_world * day.ToSun().xyz;
  sun_normal_lux_ = day.SunNormalIrradiance();
}

void FrameDaylight::SetEnvironment(const sky::SkyModel& day, const Mat3& marker_from_world,
                                   LinearRgb from_below) {
  const EnvironmentMap map = BuildEnvironmentMap(day, marker_from_world, from_below);
  for (int level = 0; level < EnvironmentMap::kLevels; ++level) {
    environment_.UploadLayer(level, GL_RGB, GL_FLOAT, map.levels[level].data());
  }
}

Result<void> FrameDaylight::Shade::Set(const std::shared_ptr<const SunTransmittanceMap>& other) {
  if (other == map) return {};
  map = other;
  return Upload();
}

Result<void> FrameDaylight::Shade::Upload() {
  const int width = Shades() ? map->width : 1, height = Shades() ? map->height : 1;
  if (texture.width() != width || texture.height() != height) {
    PLEINAIR_ASSIGN_OR_RETURN(texture, gl::GlTexture::Create2D(GL_R16F, width, height));
  }
  constexpr float kAll = 1.0F;
  texture.Upload(GL_RED, GL_FLOAT, Shades() ? map->share.data() : &kAll);
  return {};
}

std::array<glm::vec4, 2> FrameDaylight::Shade::TextureFromMarker() const {
  std::array<glm::vec4, 2> rows{};
  if (!Shades()) return rows;
  const auto from = map->TextureFromMarker();
  for (int i = 0; i < 2; ++i) rows[i] = {from[i][0], from[i][1], from[i][2], from[i][3]};
  return rows;
}

Result<void> FrameDaylight::SetShade(const SunShade& shade) {
  PLEINAIR_RETURN_IF_ERROR(trees_.Set(shade.trees));
  return clouds_.Set(shade.clouds);
}

void FrameDaylight::BindShade() const {
  constexpr int kTreeUnit = 5, kCloudUnit = 22;
  trees_.texture.Bind(kTreeUnit);
  clouds_.texture.Bind(kCloudUnit);
}

void FrameDaylight::SetUniforms(FrameUniforms* frame) const {
  if (HasSun()) frame->to_sun = ToGlm(to_sun_);
  frame->sun_normal_lux = ToGlm(SunNow());
  // In the night both are 0.
  const LinearRgb none{1e-9, 1e-9, 1e-9};
  const LinearRgb level =
      (level_sun_ * mix_.sun + level_sky_ * mix_.sky + none) / (level_sun_ + level_sky_ + none);
  frame->environment = {ToGlm(mix_.sky), ToGlm(level), up_};
  frame->shade_from_marker = {trees_.TextureFromMarker(), clouds_.TextureFromMarker()};
}

void FrameDaylight::SetFog(const shadows::Box& objects, const shadows::View& view,
                           const ComposerOptions& options, FrameUniforms* frame) const {
  frame->fog = FogBefore(objects, air_, view, frame->eye_m, options);
  for (glm::vec3& light : frame->fog.inscattered) light *= frame->environment.below_mix;
  frame->needs_airlight = frame->IsNoticed(frame->fog.inscattered.back());
}

}  // namespace pleinair::compositor
