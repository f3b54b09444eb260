#pragma once

#include <vector>

#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/estimate/light_cell.h"
#include "compositor/photometry/surface_samples.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Extracts the evidence of sun and sky from surface samples, and traces the modelled light on it.
/// The number of traced cells is bounded. At most 120 contain the end of a phantom's shadow: those
/// with the most samples. At most 160 sunlit and 48 shaded cells are traced, spread evenly.
///
/// `day` has a sun, `clouds` is overcast. `marker_from_world` has the heading in use.
std::vector<LightCell> FindLightCells(const PhantomRays& phantoms, const SurfaceSamples& samples,
                                      const sky::SkyModel& day, const sky::SkyModel& clouds,
                                      const Mat3& marker_from_world);

/// True for each sample that is seen and that the phantoms leave in the sun.
std::vector<std::uint8_t> FindSunlitSamples(const PhantomRays& phantoms,
                                            const SurfaceSamples& samples, Vec3 to_sun);

/// Finds two levels of brightness in some samples of a cell: few values lie between them, and they
/// lie apart or are sharp. Returns nothing where there is one level, or a gradient.
std::optional<CellStep> FindStep(const SurfaceSamples& samples,
                                 const std::vector<std::uint32_t>& part);

/// Cosine between the sun and a surface below which it counts as turned away.
inline constexpr double kGrazingCosine = 0.1;
/// Cosine between the normals of cells on one plane: within 14°.
inline constexpr double kOnePlane = 0.97;

}  // namespace pleinair::compositor
