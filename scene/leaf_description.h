#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/utc_time.h"
#include "scene/leaf_contents.h"

namespace pleinair::scene {

/// Contents of a leaf at midnight UTC of a date.
struct LeafStage {
  UtcTime date;
  LeafContents contents;
};

/// Images of how a leaf varies over it; compositor/leaf/leaf_maps.h. Empty: not given.
struct LeafMapFiles {
  std::filesystem::path structure;  ///< Makes those of the others that are not given.
  std::filesystem::path pigment, gloss, thickness;
};

/// A leaf that replaces materials of virtual objects.
struct LeafDescription {
  std::string where;                   ///< "scene.toml:12", for messages.
  std::vector<std::string> materials;  ///< Names, or patterns with * and ?.
  Leaf leaf;
  double roughness = 0.35;  ///< γ of the gloss, 0.05…1.
  double gloss = 1.0;       ///< 0…4.
  LeafMapFiles maps;
  std::vector<LeafStage> stages;  ///< In the order of their dates.
};

/// The leaf at a time: between two stages linear, outside them held. Without stages it is constant.
Leaf LeafAt(const LeafDescription& description, UtcTime time);

}  // namespace pleinair::scene
