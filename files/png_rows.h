#pragma once

#include <cstdint>
#include <cstdio>

#include "base/image.h"

namespace pleinair::files {

/// How a PNG is written.
struct PngStyle {
  /// Level 3 of zlib and two filters: a third of the default's time for a few per cent more bytes.
  bool fast = false;
  std::uint32_t pixels_per_metre = 0;  ///< 0: the file says no size.
};

/// Writes an 8-bit picture, grey (1 channel) or RGB (3), in sRGB as PNG to an open file, with
/// nothing that varies between runs. False where that fails; errno says why if the file is at
/// fault.
bool WritePngRows(ImageView<const std::uint8_t> picture, PngStyle style, std::FILE* file);

}  // namespace pleinair::files
