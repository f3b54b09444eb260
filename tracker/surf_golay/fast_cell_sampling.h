#pragma once

// Internal: between the .cc files of this module; not installed.

#include <cstdint>
#include <optional>

#include "base/image.h"
#include "base/vector.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/golay/soft_golay_decoder.h"

namespace pleinair::tracker {

/// The cells of a marker that lies open in even light, by a few pixels each: for about a
/// microsecond, where the fit of the border and CellReader take hundreds. Nothing where the quiet
/// zone and the rim do not show one plane of light, where a cell is neither black nor white, or
/// where the marker is cut by the image's edge: then only the longer way can tell.
std::optional<CellLikelihoods> SampleCellsFast(ImageView<const std::uint8_t> grey,
                                               const LensGrid& lens,
                                               const Mat3& modules_from_undistorted);

}  // namespace pleinair::tracker
