#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "shadows/shadow_maps.h"
#include "shadows/sun_steps.h"

namespace pleinair::shadows {

/// Shadow maps of a moving sun. They are drawn for steps of ShadowMapOptions::sun_step along its
/// way and stay as they are between; midway from one step to the next, over kFadeShare of the way,
/// the two steps' shadows are mixed. A map is redrawn when its share is nought. Needs a current GL
/// context; move-only.
class FadingShadowMaps {
 public:
  /// Errors as ShadowMaps::Create.
  static Result<FadingShadowMaps> Create(const ShadowMapOptions& options);

  /// As ShadowMaps'. Both return how many maps were redrawn.
  Result<int> UpdateForView(std::span<const ShadowCaster> casters, Direction<Marker> to_sun,
                            const View& view);
  Result<int> UpdateForRegion(std::span<const ShadowCaster> casters, Direction<Marker> to_sun,
                              const Box& focus);

  /// Whether two steps are being mixed: then shaders must be made with ShaderDefines(…, true) to
  /// look them up. Every FadingShadowMaps that a program uses must be updated for the same sun.
  bool Fades() const { return fade_ > 0.0 && fade_ < 1.0; }

  /// Makes the maps set number `set` of shadow_visibility.glsl, which is two where they fade.
  void Bind(int set) const;

  static std::vector<std::string> ShaderDefines(const ShadowMapOptions& options, int sets,
                                                bool fades);

  /// The maps that count most (debug views, measurements).
  const ShadowMaps& maps() const { return maps_[fade_ < 0.5 ? from_ : to_]; }
  const ShadowMapOptions& options() const { return maps_.front().options(); }

  /// Share of a step over which shadows are mixed. With a half the sun is at most a quarter of a
  /// step from where the maps have it, and every other frame is drawn at the cost of one step's
  /// maps.
  static constexpr double kFadeShare = 0.5;

 private:
  explicit FadingShadowMaps(double step_rad) : steps_(step_rad) {}
  template <typename Update>
  Result<int> UpdateSteps(Direction<Marker> to_sun, const Update& update);
  /// Which maps to use for a sun: those drawn for it, or others than `kept`.
  Result<std::size_t> MapsFor(const glm::dvec3& sun, std::size_t kept);

  SunSteps steps_;
  std::vector<ShadowMaps> maps_;  // One until two steps were mixed for the first time.
  std::vector<glm::dvec3> suns_;  // That they were last drawn for.
  std::size_t from_ = 0, to_ = 0;
  double fade_ = 0.0;
};

}  // namespace pleinair::shadows
