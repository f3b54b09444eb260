#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "base/image.h"
#include "tools/marker_search/random_draws.h"

namespace pleinair::marker_search {

inline constexpr int kTextureSide_px = 512;

/// Textures for the surroundings and occluders of markers, square, with side kTextureSide_px. Half
/// are noise with the spectrum of natural images, half are overlapping polygons.
std::vector<GreyImage> MakeTextures(int count, RandomDraws* draws);

/// The centres of photographs, as such textures.
Result<std::vector<GreyImage>> ReadPhotographs(const std::vector<std::string>& files);

}  // namespace pleinair::marker_search
