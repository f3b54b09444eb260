#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cstdint>
#include <optional>

#include "base/image.h"
#include "base/vector.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/golay/soft_golay_decoder.h"

namespace pleinair::tracker {

/// Fast cell sampling: reads the cells of an unoccluded, uniformly lit marker from a few pixels
/// each. Takes about a microsecond, where the fit of the border and CellReader take hundreds.
/// Returns nullopt if quiet zone and border do not fit one plane of light, if a cell is neither
/// black nor white, or if the image cuts the marker: these need the full decoder.
std::optional<CellLikelihoods> SampleCellsFast(ImageView<const std::uint8_t> grey,
                                               const LensGrid& lens,
                                               const Mat3& modules_from_undistorted);

}  // namespace pleinair::tracker
