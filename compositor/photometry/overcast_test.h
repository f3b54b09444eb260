#pragma once

#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/surface_samples.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Compares the brightness of planes, such as the top and the side of a box, with the light of a
/// modelled day. The test needs no shadow edges: planes are lit by their orientation, wherever
/// shadows fall.
struct OvercastTest {
  /// Unexplained logarithmic brightness difference of two planes of one material, for the pair that
  /// differs most. 0 where no surface shows two planes.
  double within = 0.0;
  /// The same among all surfaces and the marker, compared by their described colors. Logarithmic
  /// root mean square about the mean, with equal weight per surface. Described colors are rough.
  double among = 0.0;
  int surfaces = 0;    ///< Compared surfaces, including the marker.
  int directions = 0;  ///< Orientations of their planes, at least 30° apart.
};

/// Compares planes in the light of `day`, with the sun visibility that the phantoms leave.
OvercastTest TestForOvercast(const PhantomRays& phantoms, const SurfaceSamples& samples,
                             const sky::SkyModel& day, const Mat3& marker_from_world);

}  // namespace pleinair::compositor
