#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/error.h"
#include "compositor/lens/focus_fit.h"
#include "compositor/lens/lens_figures.h"
#include "compositor/lens/thin_lens.h"
#include "scene/scene_description.h"
#include "session/lens_facts.h"
#include "session/marker_tracks.h"

namespace pleinair::session {

/// User options for the depth of field. What is set overrides the scene.
struct DefocusOptions {
  LensFactMode mode = LensFactMode::kAuto;
  std::optional<double> focus_dioptres;
  std::optional<double> aperture_m;
  /// On the stop, drawn one after another, 1…1024, or compositor::kByLayers.
  int places = compositor::kByLayers;
};

/// The lens that frames are composed with.
class FrameLens {
 public:
  FrameLens() = default;
  /// `match_look`: LightOptions::match_look; without it kAuto is off. Errors (input): kStated
  /// without focus or aperture.
  static Result<FrameLens> Create(const scene::SceneDescription& scene,
                                  const DefocusOptions& options, bool match_look);

  LensFactSource source() const { return source_; }
  /// True if the frames may tell what is neither stated nor recorded.
  bool MayBeMeasured() const { return may_be_measured_; }
  /// What is known before measuring.
  compositor::KnownLens Known() const;
  /// Uses what was measured, if anything was; `frames`: all of the recording.
  void UseMeasured(const compositor::FocusFit& fit, const std::vector<FrameTime>& frames);

  /// The lens at a frame; nothing where all is in focus. Frames beyond a list have its last focus.
  std::optional<compositor::ThinLens> Of(std::int64_t frame_index) const;

 private:
  LensFactSource source_ = LensFactSource::kOff;
  bool may_be_measured_ = false;
  scene::LensDescription lens_;
};

}  // namespace pleinair::session
