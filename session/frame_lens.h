#pragma once

#include <cstdint>
#include <optional>

#include "base/error.h"
#include "compositor/lens/lens_figures.h"
#include "compositor/lens/thin_lens.h"
#include "scene/scene_description.h"

namespace pleinair::session {

/// Where focus and aperture come from.
enum class DefocusMode {
  kAuto,    ///< Stated by scene or options, else by the recording; else nothing is defocused.
  kOff,     ///< Nothing is defocused by its distance.
  kStated,  ///< Stated by scene or options.
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
enum class DefocusSource { kOff, kStated, kMetadata };

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
  /// The lens at a frame; nothing where all is in focus. Frames beyond a list have its last focus.
  std::optional<compositor::ThinLens> Of(std::int64_t frame_index) const;

 private:
  DefocusSource source_ = DefocusSource::kOff;
  scene::LensDescription lens_;
};

}  // namespace pleinair::session
