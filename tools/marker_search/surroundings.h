#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "base/image.h"
#include "tools/marker_search/random_draws.h"

namespace pleinair::marker_search {

inline constexpr int kTextureSide_px = 512;

/// Pictures of what may lie around and on markers, kTextureSide_px square: noise whose spectrum
/// falls with the frequency as natural pictures' does, and heaps of polygons.
std::vector<GreyImage> MakeTextures(int count, RandomDraws* draws);

/// The middle of photographs, as such textures.
Result<std::vector<GreyImage>> ReadPhotographs(const std::vector<std::string>& files);

}  // namespace pleinair::marker_search
