#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/error.h"
#include "compositor/lens/exposure_fit.h"
#include "scene/scene_description.h"
#include "session/lens_facts.h"

namespace pleinair::session {

/// User options for motion blur. What is set overrides the scene.
struct MotionBlurOptions {
  LensFactMode mode = LensFactMode::kAuto;
  std::optional<double> exposure_s;
  int max_views = 64;  ///< Composer::SetMotion().
};

/// For how long the frames are exposed.
class FrameExposure {
 public:
  FrameExposure() = default;
  /// `match_look`: LightOptions::match_look; without it kAuto is off. Errors (input): kStated
  /// without an exposure.
  static Result<FrameExposure> Create(const scene::SceneDescription& scene,
                                      const MotionBlurOptions& options, bool match_look);

  /// True if the frames may show what is neither stated nor recorded.
  bool MayBeMeasured() const { return may_be_measured_; }
  /// True if no frame has an exposure, whatever its camera reports.
  bool IsOff() const { return is_off_; }
  /// Uses what was measured, if anything was.
  void UseMeasured(const compositor::ExposureFit& fit);

  /// An exposure and its source.
  struct Exposure {
    LensFactSource source = LensFactSource::kOff;
    double seconds = 0.0;  ///< 0: not known, or off.
  };
  /// The exposure of a frame. `own_s`: as its camera reports it with the frame. Frames beyond a
  /// list have its last exposure.
  Exposure Of(std::int64_t frame_index, const std::optional<double>& own_s) const;

 private:
  bool is_off_ = true, may_be_measured_ = false;
  bool uses_own_ = false;  // Exposures that come with the frames count.
  LensFactSource source_ = LensFactSource::kOff;
  std::vector<double> exposures_s_;  // None, one, or one a frame.
};

}  // namespace pleinair::session
