#pragma once

#include <cstdint>
#include <string>

#include "base/error.h"
#include "base/image.h"
#include "export/print_sheets/sheet.h"
#include "tracker/marker_pattern.h"

namespace pleinair::exports {

/// Resolution of pages as pictures: 12 px/mm (304.8 dpi) puts whole millimetres on pixel edges.
constexpr int kSheetPixelsPerMm = 12;

/// The page as an 8-bit sRGB grey picture. A pixel cut by an edge gets the mean of its area in
/// linear light.
Image<std::uint8_t> RasterizeSheet(const Sheet& sheet);

/// The bare print, quiet zone included, as `pixels` × `pixels`. Modules end on whole pixels where
/// `pixels` is a multiple of the print's modules, and are smoothed as above elsewhere.
Image<std::uint8_t> RasterizeMarker(const tracker::MarkerPattern& print, int pixels);

/// A grey picture as PNG with its resolution (pHYs) and nothing that varies between runs. Errors
/// (system): no memory.
Result<std::string> EncodeGrayPng(ImageView<const std::uint8_t> gray, double pixels_per_metre);

}  // namespace pleinair::exports
