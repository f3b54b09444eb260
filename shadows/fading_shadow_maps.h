#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "shadows/shadow_maps.h"
#include "shadows/sun_steps.h"

namespace pleinair::shadows {

/// Shadow maps of a moving sun. Maps are drawn for sun directions in steps of
/// ShadowMapOptions::sun_step and stay unchanged between. Around the middle between two steps, over
/// kFadeShare of the way, the shadows of both are cross-faded. A map is redrawn only while its
/// weight is zero. Needs a current GL context; move-only.
class FadingShadowMaps {
 public:
  /// Errors as ShadowMaps::Create().
  static Result<FadingShadowMaps> Create(const ShadowMapOptions& options);

  /// As in ShadowMaps. Both return the number of redrawn maps.
  Result<int> UpdateForView(std::span<const ShadowCaster> casters, Direction<Marker> to_sun,
                            const View& view);
  Result<int> UpdateForRegion(std::span<const ShadowCaster> casters, Direction<Marker> to_sun,
                              const Box& focus);

  /// True while two steps are cross-faded. Shaders then need the defines of ShaderDefines(…, true).
  /// All FadingShadowMaps of one program must be updated for the same sun.
  bool Fades() const { return fade_ > 0.0 && fade_ < 1.0; }

  /// Binds the maps as set number `set` of shadow_visibility.glsl; it occupies two sets during a
  /// cross-fade.
  void Bind(int set) const;

  static std::vector<std::string> ShaderDefines(const ShadowMapOptions& options, int sets,
                                                bool fades);

  /// The maps with the larger weight (debug views, measurements).
  const ShadowMaps& maps() const { return maps_[fade_ < 0.5 ? from_ : to_]; }
  const ShadowMapOptions& options() const { return maps_.front().options(); }

  /// Share of a step over which shadows are cross-faded. With ½ the sun is at most a quarter of a
  /// step from the direction of its maps, and every second frame is drawn at the cost of one step's
  /// maps.
  static constexpr double kFadeShare = 0.5;

 private:
  explicit FadingShadowMaps(double step_rad) : steps_(step_rad) {}
  template <typename Update>
  Result<int> UpdateSteps(Direction<Marker> to_sun, const Update& update);
  /// Index of the maps for a sun: those drawn for it, or else a free one other than `kept`.
  Result<std::size_t> MapsFor(const glm::dvec3& sun, std::size_t kept);

  SunSteps steps_;
  std::vector<ShadowMaps> maps_;  // One until the first cross-fade.
  std::vector<glm::dvec3> suns_;  // Sun directions for which they were drawn.
  std::size_t from_ = 0, to_ = 0;
  double fade_ = 0.0;
};

}  // namespace pleinair::shadows
