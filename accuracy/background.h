#pragma once

#include <cstdint>
#include <string_view>

#include "base/image.h"

namespace pleinair::accuracy {

/// Synthetic background behind the markers, linear light: ground with a natural spectrum (amplitude
/// falling with frequency), overlaid with edges, boxes, discs, gratings, checkered patches and rows
/// of signs, all of which may resemble parts of a marker. Determined by key and seed.
Image<float> MakeBackground(int width, int height, std::uint64_t seed, std::string_view key);

}  // namespace pleinair::accuracy
