#include "compositor/passes/frame_daylight.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

#include "compositor/light/environment_map.h"
#include "compositor/passes/glm_vectors.h"

namespace pleinair::compositor {
Result<FrameDaylight> FrameDaylight::Create() {
  FrameDaylight light;
  PLEINAIR_ASSIGN_OR_RETURN(
      light.environment_,
      gl::GlTexture::Create2DArray(GL_RGB32F, EnvironmentMap::kWidth, EnvironmentMap::kHeight,
                                   EnvironmentMap::kLevels));
  light.environment_.SetWrap(GL_REPEAT);
  PLEINAIR_RETURN_IF_ERROR(light.Upload({}));
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

Result<void> FrameDaylight::SetTransmittance(
    std::shared_ptr<const SunTransmittanceMap> transmittance) {
  if (transmittance == transmittance_) return {};
  PLEINAIR_RETURN_IF_ERROR(Upload(transmittance ? *transmittance : SunTransmittanceMap{}));
  transmittance_ = std::move(transmittance);
  return {};
}

Result<void> FrameDaylight::Upload(const SunTransmittanceMap& transmittance) {
  const bool empty = transmittance.share.empty();
  PLEINAIR_ASSIGN_OR_RETURN(transmittance_texture_,
                            gl::GlTexture::Create2D(GL_R16F, empty ? 1 : transmittance.width,
                                                    empty ? 1 : transmittance.height));
  constexpr float kAll = 1.0F;
  transmittance_texture_.Upload(GL_RED, GL_FLOAT, empty ? &kAll : transmittance.share.data());
  return {};
}

void FrameDaylight::SetUniforms(FrameUniforms* frame) const {
  if (HasSun()) frame->to_sun = ToGlm(to_sun_);
  frame->sun_normal_lux = ToGlm(SunNow());
  // In the night both are 0.
  const LinearRgb none{1e-9, 1e-9, 1e-9};
  const LinearRgb level =
      (level_sun_ * mix_.sun + level_sky_ * mix_.sky + none) / (level_sun_ + level_sky_ + none);
  frame->environment = {ToGlm(mix_.sky), ToGlm(level), up_};
  if (!IsShadedByUnmodelled()) return;
  const auto rows = transmittance_->TextureFromMarker();
  for (int i = 0; i < 2; ++i) {
    frame->texture_from_marker[i] = {rows[i][0], rows[i][1], rows[i][2], rows[i][3]};
  }
}

}  // namespace pleinair::compositor
