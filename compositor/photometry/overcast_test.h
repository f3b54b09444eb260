#pragma once

#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/surface_samples.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// How the brightness of planes, the top of a box and its side, say, agrees with the light that a
/// day would have on them. Whatever casts shadows lights planes by how they face it, wherever its
/// shadows fall.
struct OvercastTest {
  /// How much brighter one plane of a surface is than another of the same material, beyond what
  /// the light explains: logarithmic, of the pair that differs most; 0 where no surface shows two
  /// planes.
  double within = 0.0;
  /// The same among all surfaces and the marker, by their stated colors: root mean square about
  /// the mean, logarithmic, surfaces counting alike. Stated colors are rough.
  double among = 0.0;
  int surfaces = 0;    ///< That were compared, the marker among them.
  int directions = 0;  ///< That their planes face, 30° apart at least.
};

/// Compares planes in the light of `day`, its sun as the phantoms leave it.
OvercastTest TestForOvercast(const PhantomRays& phantoms, const SurfaceSamples& samples,
                             const sky::SkyModel& day, const Mat3& marker_from_world);

}  // namespace pleinair::compositor
