#pragma once

#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "compositor/composer_options.h"
#include "compositor/surfaces/affected_triangles.h"
#include "compositor/surfaces/scene_surfaces.h"
#include "shadows/fading_shadow_maps.h"

namespace pleinair::compositor {

/// Shadow maps of a scene: one set with the phantoms alone, for what the picture has already, and
/// one with the virtual objects. Needs a current OpenGL context.
class SceneShadows {
 public:
  /// Sets of shadow maps, as the shaders number them.
  enum Set { kPhantomsAlone, kWithObjects, kSets };

  /// How the maps are made. `picture_px`: the longer side of the picture, for maps whose size is
  /// left open.
  static shadows::ShadowMapOptions MapOptions(const ComposerOptions& options, int picture_px);

  SceneShadows() = default;
  /// Errors as shadows::FadingShadowMaps::Create.
  static Result<SceneShadows> Create(const shadows::ShadowMapOptions& options);

  /// Redraws what changed and binds both sets. `view`: what the camera sees of the scene.
  Result<void> Update(const SceneSurfaces& surfaces, Direction<Marker> to_sun,
                      const shadows::View& view);

  /// The shaders must mix two steps of the sun.
  bool Fades() const { return sets_.front().Fades(); }
  /// Where the objects may change the sun's light, after Update().
  SunWindow Window() const;
  /// The maps with the objects, of the step of the sun that counts most.
  const shadows::ShadowMaps& maps() const { return sets_[kWithObjects].maps(); }
  const shadows::ShadowMapOptions& options() const { return sets_.front().options(); }

 private:
  bool FitsView() const;

  std::vector<shadows::FadingShadowMaps> sets_;  // kSets of them.
};

}  // namespace pleinair::compositor
