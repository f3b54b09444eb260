#pragma once

#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "compositor/composer_options.h"
#include "compositor/surfaces/affected_triangles.h"
#include "compositor/surfaces/scene_surfaces.h"
#include "shadows/fading_shadow_maps.h"

namespace pleinair::compositor {

/// Shadow maps of a scene. One set has the phantoms alone, whose shadows are already in the image.
/// The other set also has the virtual objects. Needs a current OpenGL context.
class SceneShadows {
 public:
  /// Sets of shadow maps, as the shaders number them.
  enum Set { kPhantomsAlone, kWithObjects, kSets };

  /// Options of the maps. `picture_px` is the longer side of the image, for maps without a given
  /// size.
  static shadows::ShadowMapOptions MapOptions(const ComposerOptions& options, int picture_px);

  SceneShadows() = default;
  /// Errors as shadows::FadingShadowMaps::Create.
  static Result<SceneShadows> Create(const shadows::ShadowMapOptions& options);

  /// Redraws the maps that changed and binds both sets. `view` is the camera's view of the scene.
  Result<void> Update(const SceneSurfaces& surfaces, Direction<Marker> to_sun,
                      const shadows::View& view);

  /// True if the shaders must mix two steps of the sun.
  bool Fades() const { return sets_.front().Fades(); }
  /// Bounds in which the objects may change the sun's light, after Update().
  SunWindow Window() const;
  /// Maps with the objects, at the sun step with the larger weight.
  const shadows::ShadowMaps& maps() const { return sets_[kWithObjects].maps(); }
  const shadows::ShadowMapOptions& options() const { return sets_.front().options(); }

 private:
  bool FitsView() const;

  std::vector<shadows::FadingShadowMaps> sets_;  // kSets of them.
};

}  // namespace pleinair::compositor
