#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.h"
#include "compositor/ink/ink_shape.h"
#include "content/draping/draped_layer.h"
#include "scene/drape_description.h"

namespace pleinair::app {

/// Ink of draped features: for each, the fill of its area and then its lines. `colors`: for each
/// feature from `first_feature` on, its own color; empty: all have that of `ink`.
std::vector<compositor::InkShape> InkShapesOf(const content::DrapedLayer& layer,
                                              const scene::InkDescription& ink,
                                              std::span<const std::optional<LinearRgb>> colors,
                                              std::uint32_t first_feature);

/// Orients closed rings as InkShape::rings asks: those inside an odd number of others are holes.
void OrientRings(std::vector<std::vector<glm::vec2>>* rings);

}  // namespace pleinair::app
