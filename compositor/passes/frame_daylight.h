#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/composer_options.h"
#include "compositor/light/light_mix.h"
#include "compositor/light/sun_transmittance_map.h"
#include "compositor/passes/aerial_fog.h"
#include "compositor/passes/frame_uniforms.h"
#include "gl/texture.h"
#include "shadows/light_window.h"
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
  /// Errors (system): no memory.
  Result<void> SetShade(const SunShade& shade);

  const LightMix& mix() const { return mix_; }
  /// False for a sun below the horizon or behind clouds: it lights nothing and casts no shadow.
  bool HasSun() const { return Luminance(SunNow()) > 0.0; }
  Vec3 to_sun() const { return to_sun_; }  ///< Unit vector.
  /// The sun of the current mix on a surface that faces it.
  LinearRgb SunNow() const { return sun_normal_lux_ * mix_.sun; }
  /// True if trees or clouds take a part of the sun that differs from place to place.
  bool IsShaded() const { return trees_.Shades() || clouds_.Shades(); }
  const gl::GlTexture& environment() const { return environment_; }
  /// For shaders/sun_transmittance_map.glsl.
  void BindShade() const;

  /// Sets sun, environment and the places of the maps of transmittance.
  void SetUniforms(FrameUniforms* frame) const;
  /// After SetUniforms(): sets the fog before the `objects`, and whether it is noticeable.
  void SetFog(const shadows::Box& objects, const shadows::View& view,
              const ComposerOptions& options, FrameUniforms* frame) const;

 private:
  /// A map of transmittance; one texel with all of the sun where nothing takes any.
  struct Shade {
    std::shared_ptr<const SunTransmittanceMap> map;
    gl::GlTexture texture;

    bool Shades() const { return map && !map->share.empty(); }
    Result<void> Set(const std::shared_ptr<const SunTransmittanceMap>& other);
    Result<void> Upload();
    std::array<glm::vec4, 2> TextureFromMarker() const;
  };

  gl::GlTexture environment_;
  AerialFog air_;
  Vec3 to_sun_;
  LinearRgb sun_normal_lux_;
  glm::vec3 up_{0.0F, 0.0F, 1.0F};
  LinearRgb level_sun_, level_sky_;  // Illuminance of level ground.
  LightMix mix_;
  Shade trees_, clouds_;
};

}  // namespace pleinair::compositor
