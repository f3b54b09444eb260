#pragma once

#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/shade/unmodelled_shadows.h"
#include "compositor/photometry/sun_sky_ratio.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Estimates the sun-to-sky ratio from the depth of tree shade on places that the phantoms leave
/// sunlit. An example is a marker under leaves, where no phantom's shadow edge can be measured.
///
/// A surface sample between the leaves' shadows has at most the whole sun, and one in their shade
/// at least none of it. The deepest of many places therefore give the ratio; shallower ones are
/// half-light. The result includes the crown's occlusion of the sky: it is the remaining sky beside
/// the sun.
///
/// `daylight` is the model, `marker_from_world` has the heading in use. `sun` is kShines where
/// enough places give a ratio, kUnknown otherwise. `edges` are the places, `agreeing` those deep
/// enough to count. The reported uncertainty is larger than that of EstimateSunSkyRatio().
SunSkyRatio EstimateRatioFromShade(const PhantomRays& phantoms, const UnmodelledShadows& unmodelled,
                                   const sky::SkyModel& daylight, const Mat3& marker_from_world);

}  // namespace pleinair::compositor
