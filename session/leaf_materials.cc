#include "session/leaf_materials.h"

#include <fnmatch.h>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "compositor/surfaces/leaf_texture.h"

namespace pleinair::session {
namespace {

/// The objects' materials, for a message.
std::string MaterialNames(const std::vector<compositor::PlacedModel>& placed) {
  constexpr std::size_t kMaxLength = 160;
  std::string names;
  for (const compositor::PlacedModel& object : placed) {
    if (object.is_phantom) continue;
    for (const compositor::Material& material : object.model->materials) {
      if (material.name.empty() || names.size() > kMaxLength) continue;
      names += (names.empty() ? "" : ", ") + material.name.substr(0, 40);
    }
  }
  return names.empty() ? "the objects' materials have no names"
                       : "the objects' materials are " + names;
}

/// Replaces the materials that a pattern fits. Returns whether there are any.
bool ReplaceFitting(const std::string& pattern, const compositor::LeafSurface& leaf,
                    const compositor::LeafMapImages& maps,
                    std::vector<compositor::PlacedModel>* placed) {
  bool fits_any = false;
  for (compositor::PlacedModel& object : *placed) {
    if (object.is_phantom) continue;
    std::shared_ptr<compositor::Model> changed;
    for (std::size_t i = 0; i < object.model->materials.size(); ++i) {
      const std::string& name = object.model->materials[i].name;
      if (name.empty()) continue;
      // Names may hold brackets, which a pattern would take for a set of letters.
      if (pattern != name && fnmatch(pattern.c_str(), name.c_str(), FNM_NOESCAPE) != 0) continue;
      if (!changed) changed = std::make_shared<compositor::Model>(*object.model);
      compositor::ApplyMappedLeaf(leaf, maps, static_cast<int>(i), changed.get());
    }
    if (!changed) continue;
    object.model = std::move(changed);
    fits_any = true;
  }
  return fits_any;
}

}  // namespace

Result<void> ReplaceByLeaves(const std::vector<scene::LeafDescription>& leaves, UtcTime time,
                             std::vector<compositor::PlacedModel>* placed) {
  for (const scene::LeafDescription& description : leaves) {
    const compositor::LeafSurface leaf{scene::LeafAt(description, time),
                                       static_cast<float>(description.gloss),
                                       static_cast<float>(description.roughness)};
    PLEINAIR_ASSIGN_OR_RETURN(const compositor::LeafMapImages maps,
                              compositor::ReadLeafMaps(description.maps));
    for (const std::string& pattern : description.materials) {
      if (ReplaceFitting(pattern, leaf, maps, placed)) continue;
      return InputError(description.where,
                        "the material \"" + pattern.substr(0, 64) + "\" is in no object",
                        MaterialNames(*placed));
    }
  }
  return {};
}

}  // namespace pleinair::session
