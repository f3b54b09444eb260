#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/error.h"
#include "compositor/lens/focus_fit.h"
#include "compositor/lens/lens_figures.h"
#include "compositor/lens/thin_lens.h"
#include "scene/scene_description.h"
#include "session/marker_tracks.h"

namespace pleinair::session {

/// Where focus and aperture come from.
enum class DefocusMode {
  kAuto,      ///< Stated by scene or options, else by the recording, else measured.
  kOff,       ///< Nothing is defocused by its distance.
  kStated,    ///< Stated by scene or options.
  kMeasured,  ///< Measured in the frames of a recording (session/lens_measurement.h).
};

/// User options for the depth of field. What is set overrides the scene.
struct DefocusOptions {
  DefocusMode mode = DefocusMode::kAuto;
  std::optional<double> focus_dioptres;
  std::optional<double> aperture_m;
  /// On the stop, drawn one after another, 1…1024, or compositor::kByLayers.
  int places = compositor::kByLayers;
};

/// Which of them is in use.
enum class DefocusSource { kOff, kStated, kMetadata, kMeasured };

/// As reports name it.
const char* NameOf(DefocusSource source);

/// The lens that frames are composed with.
class FrameLens {
 public:
  FrameLens() = default;
  /// `match_look`: LightOptions::match_look; without it kAuto is off. Errors (input): kStated
  /// without focus or aperture.
  static Result<FrameLens> Create(const scene::SceneDescription& scene,
                                  const DefocusOptions& options, bool match_look);

  DefocusSource source() const { return source_; }
  /// True if the frames may tell what is neither stated nor recorded.
  bool MayBeMeasured() const { return may_be_measured_; }
  /// What is known before measuring.
  compositor::KnownLens Known() const;
  /// Uses what was measured, if anything was; `frames`: all of the recording.
  void UseMeasured(const compositor::FocusFit& fit, const std::vector<FrameTime>& frames);

  /// The lens at a frame; nothing where all is in focus. Frames beyond a list have its last focus.
  std::optional<compositor::ThinLens> Of(std::int64_t frame_index) const;

 private:
  DefocusSource source_ = DefocusSource::kOff;
  bool may_be_measured_ = false;
  scene::LensDescription lens_;
};

}  // namespace pleinair::session
