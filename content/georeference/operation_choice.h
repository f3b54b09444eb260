#pragma once

// Internal: chooses PROJ's coordinate operation for a place.

#include <string>
#include <vector>

#include "base/error.h"
#include "content/georeference/coordinate_system.h"

namespace pleinair::content {

/// A coordinate operation, x east and y north on either side, degrees where a side is geographic.
struct ChosenOperation {
  ProjObject object;
  std::string name;
  double accuracy_m = 0.0;  ///< As its authority states it; 0: a conversion without a datum change.
  /// True if PROJ knows no relation between the two datums and assumes that they are equal.
  bool ballpark = false;
  /// Grids of a more accurate operation that are not installed, as "us_nga_egm08_25.tif".
  std::vector<std::string> missing_grids;
};

/// What the operation must preserve.
enum class Heights { kKept, kTransformed };

/// Chooses the operation from `source` to `target` that PROJ ranks first around `place`, among
/// those whose grids are installed. One operation serves all points, so that a layer has no seams.
/// Errors (input): none exists; with kTransformed, each one that is installed would leave the
/// heights as they are. The error names the missing grid and how to install it.
Result<ChosenOperation> ChooseOperation(PJ_CONTEXT* context, const CoordinateSystem& source,
                                        const CoordinateSystem& target, const GeodeticPoint& place,
                                        Heights heights, const std::string& where);

/// "install it with `projsync …`": how to get a grid.
std::string GridRemedy(const std::string& grid);

}  // namespace pleinair::content
