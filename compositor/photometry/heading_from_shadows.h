#pragma once

#include <optional>
#include <vector>

#include "base/units.h"
#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {

/// Error of the described heading, estimated from the shadows that phantoms cast on phantoms.
struct HeadingEstimate {
  Radians offset;         ///< To be added to the described heading.
  Radians uncertainty;    ///< One standard deviation, by a jackknife over eight groups of cells.
  double contrast = 0.0;  ///< Mean step of the logarithm of light across the shadow boundaries.
  int cells = 0;          ///< Cells that contain a shadow boundary at this heading.
  /// Share of the brightness' variance, in cells that some heading divides, that it explains.
  double explained_share = 0.0;
};

/// Estimates the heading from the shadows that phantoms cast on phantoms. The search rotates the
/// sun about the vertical. The best heading's sun visibility explains most of the brightness within
/// small cells of one material. Returns nothing where no heading explains it: no sun, or no shadow
/// boundary in view.
std::optional<HeadingEstimate> EstimateHeading(const PhantomRays& phantoms,
                                               const SurfaceSamples& samples, Vec3 up, Vec3 to_sun);

/// Rotates a direction about an axis, counter-clockwise seen from the tip of the axis.
Vec3 Turned(Vec3 direction, Vec3 unit_axis, Radians angle);

/// Maximum accepted error of a described heading.
inline constexpr double kMaxHeadingError_deg = 10.0;

}  // namespace pleinair::compositor
