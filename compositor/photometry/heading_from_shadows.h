#pragma once

#include <optional>
#include <vector>

#include "base/units.h"
#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {

/// How far the stated heading is off, as the phantoms' own shadows say.
struct HeadingEstimate {
  Radians offset;         ///< To add to the stated heading.
  Radians uncertainty;    ///< One standard deviation, from leaving out an eighth of the places.
  double contrast = 0.0;  ///< Mean step of the logarithm of light across the shadows' edges.
  int cells = 0;          ///< Places with an edge at this heading.
};

/// Turns the sun about the vertical until the shadows that phantoms cast on phantoms lie where the
/// pictures are dark: the heading at which sunlit or not explains most of the brightness within
/// small cells of one material. Nothing where no heading explains it: no sun, or no edge in view.
std::optional<HeadingEstimate> EstimateHeading(const PhantomRays& phantoms,
                                               const SurfaceSamples& samples, Vec3 up, Vec3 to_sun);

/// A direction turned about an axis, counter-clockwise seen from the axis' tip.
Vec3 Turned(Vec3 direction, Vec3 unit_axis, Radians angle);

/// The farthest that a stated heading is believed to be off.
inline constexpr double kMaxHeadingError_deg = 10.0;

}  // namespace pleinair::compositor
