#pragma once

#include <cstdint>
#include <string>

#include "base/error.h"
#include "base/image.h"
#include "export/print_sheets/sheet.h"
#include "tracker/marker_pattern.h"

namespace pleinair::exports {

/// Resolution of pages as images: 12 px/mm (304.8 dpi) puts whole millimetres on pixel edges.
constexpr int kSheetPixelsPerMm = 12;

/// The page as an 8-bit sRGB grey image. A pixel crossed by an edge gets the mean of its area in
/// linear light.
Image<std::uint8_t> RasterizeSheet(const Sheet& sheet);

/// The marker without legend, quiet zone included, as `pixels` × `pixels`. If `pixels` is a
/// multiple of the number of modules, modules end at whole pixels. Otherwise they are antialiased
/// as above.
Image<std::uint8_t> RasterizeMarker(const tracker::MarkerPattern& print, int pixels);

/// Encodes a grey image as PNG with its resolution (pHYs) and no data that varies between runs.
/// Errors (system): no memory.
Result<std::string> EncodeGrayPng(ImageView<const std::uint8_t> gray, double pixels_per_metre);

}  // namespace pleinair::exports
