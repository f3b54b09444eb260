#pragma once

#include <cstdint>
#include <cstdio>

#include "base/image.h"

namespace pleinair::files {

/// Options of PNG encoding.
struct PngStyle {
  /// zlib level 3 and two filters: a third of the default's time for a few per cent more bytes.
  bool fast = false;
  std::uint32_t pixels_per_metre = 0;  ///< 0: the file gives no physical size.
};

/// Writes an 8-bit sRGB image, grey (1 channel) or RGB (3), as PNG to an open file. The output is
/// deterministic. Returns false on failure; for a file error, errno has the cause.
bool WritePngRows(ImageView<const std::uint8_t> picture, PngStyle style, std::FILE* file);

}  // namespace pleinair::files
