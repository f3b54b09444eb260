#pragma once

#include <cstdint>
#include <string_view>

#include "base/image.h"

namespace pleinair::accuracy {

/// What lies behind the markers, in linear light: ground as rough as nature's (amplitude falling
/// with frequency), with edges, boxes, discs, gratings, checkered patches and rows of signs before
/// it, all of which may look like parts of a marker. The key and the seed say all.
Image<float> MakeBackground(int width, int height, std::uint64_t seed, std::string_view key);

}  // namespace pleinair::accuracy
