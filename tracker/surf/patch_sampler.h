#pragma once
// Internal: shared by the .cc files of this module; not installed.

#include "tracker/surf/box_levels.h"

namespace pleinair::tracker {

/// A grid of points in the image: (column, row) -> origin + column * right + row * down, px.
struct PatchGrid {
  float x = 0, y = 0;  ///< Origin, px.
  float right_x = 1, right_y = 0;
  float down_x = 0, down_y = 1;
};

/// values[i] = the level's mean (grey x 256) at the point (columns[i], rows[i]) of the grid,
/// interpolated bilinearly; outside the image that of the nearest border. `count` must be a
/// multiple of 16.
void SamplePatch(const BoxLevel& level, const PatchGrid& grid, const float* columns,
                 const float* rows, int count, float* values);

}  // namespace pleinair::tracker
