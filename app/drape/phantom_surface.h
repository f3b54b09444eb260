#pragma once

#include <vector>

#include "base/error.h"
#include "content/draping/surface_index.h"
#include "scene/scene_description.h"

namespace pleinair::compositor {
struct PlacedModel;
}

namespace pleinair::app {

/// The triangles of placed phantoms, east, north and up from the marker's origin. The number of a
/// surface is that of its phantom; virtual objects are left out. `phantoms`: in the order of the
/// scene. `marker_from_world`: the heading of the marker. Error (input): those of
/// content::SurfaceIndex::Create().
Result<content::SurfaceIndex> SurfaceOfPhantoms(
    const std::vector<compositor::PlacedModel>& phantoms, const Mat3& marker_from_world);

/// Loads the phantoms of a scene and places them. Errors: those of session::PlaceModel().
Result<content::SurfaceIndex> SurfaceOfScene(const scene::SceneDescription& scene);

/// The rule of a drape's `on`, in a scene that has the phantom it names.
content::SurfaceRule RuleOf(const scene::DrapeDescription& drape,
                            const scene::SceneDescription& scene);

}  // namespace pleinair::app
