#include "compositor/passes/frame_programs.h"

#include <utility>

namespace pleinair::compositor {

Result<const SurfacePrograms*> FramePrograms::For(const shadows::ShadowMapOptions& maps,
                                                  const SceneMaterials& materials, Needs needs) {
  std::optional<SurfacePrograms>& made = made_[needs.fades ? 1 : 0][needs.airlight ? 1 : 0];
  if (!made) {
    PLEINAIR_ASSIGN_OR_RETURN(
        SurfacePrograms programs,
        SurfacePrograms::Create(maps, {.fades = needs.fades,
                                       .needs_airlight = needs.airlight,
                                       .textured = materials.HasTextures(),
                                       .blended = materials.HasBlended(),
                                       .detailed = materials.HasDetails(),
                                       .translucent = materials.HasTranslucent(),
                                       .glossy = materials.HasGloss()}));
    made.emplace(std::move(programs));
  }
  return &*made;
}

}  // namespace pleinair::compositor
