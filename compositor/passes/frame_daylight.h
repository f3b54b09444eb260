#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/light/light_mix.h"
#include "compositor/light/sun_transmittance_map.h"
#include "compositor/passes/aerial_fog.h"
#include "compositor/passes/frame_uniforms.h"
#include "gl/texture.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// The daylight that shades the surfaces of a frame: sun, air, mirrored environment, and the shade
/// of unmodelled geometry. Marker coordinates; light in lux, linear Rec.709. Needs a current OpenGL
/// context; move-only.
class FrameDaylight {
 public:
  FrameDaylight() = default;
  /// Makes a light without a sun. Errors (system): no memory.
  static Result<FrameDaylight> Create();

  /// Sets sun, sky and air, with a mix of 1.
  void SetDay(const sky::SkyModel& day, const Mat3& marker_from_world);
  /// Moves the sun; the air stays.
  void SetSun(const sky::SkyModel& day, const Mat3& marker_from_world);
  /// Sets what glossy surfaces mirror. `from_below`: radiance from below the horizon.
  void SetEnvironment(const sky::SkyModel& day, const Mat3& marker_from_world,
                      LinearRgb from_below);
  /// Sets the strengths of sun and sky over those of SetDay().
  void SetMix(const LightMix& mix) { mix_ = mix; }
  /// Sets the sun transmittance of unmodelled geometry; null or empty: there is none. Errors
  /// (system): no memory.
  Result<void> SetTransmittance(std::shared_ptr<const SunTransmittanceMap> transmittance);

  const LightMix& mix() const { return mix_; }
  /// False for a sun below the horizon or behind clouds: it lights nothing and casts no shadow.
  bool HasSun() const { return Luminance(SunNow()) > 0.0; }
  Vec3 to_sun() const { return to_sun_; }  ///< Unit vector.
  /// The sun of the current mix on a surface that faces it.
  LinearRgb SunNow() const { return sun_normal_lux_ * mix_.sun; }
  bool IsShadedByUnmodelled() const { return transmittance_ && !transmittance_->share.empty(); }
  const AerialFog& air() const { return air_; }
  const gl::GlTexture& environment() const { return environment_; }
  /// One texel with all of the sun where there is no unmodelled shade.
  const gl::GlTexture& transmittance() const { return transmittance_texture_; }

  /// Sets sun, environment and the place of the transmittance.
  void SetUniforms(FrameUniforms* frame) const;

 private:
  Result<void> Upload(const SunTransmittanceMap& transmittance);

  gl::GlTexture environment_, transmittance_texture_;
  AerialFog air_;
  Vec3 to_sun_;
  LinearRgb sun_normal_lux_;
  glm::vec3 up_{0.0F, 0.0F, 1.0F};
  LinearRgb level_sun_, level_sky_;  // Illuminance of level ground.
  LightMix mix_;
  std::shared_ptr<const SunTransmittanceMap> transmittance_;
};

}  // namespace pleinair::compositor
