#pragma once

#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/shade/unmodelled_shadows.h"
#include "compositor/photometry/sun_sky_ratio.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// How strong the sky is beside the sun, from how deep the shade of trees is where it crosses what
/// the model has in the sun: the marker under leaves, say, where no phantom's own edge can be read.
/// A surface sample of the ground between leaves has no more than the whole sun and in their shade
/// no less than none of it, so that the deepest places of many tell the ratio; shallower ones are
/// half-light. What the crown takes of the sky is in it: it is the sky beside the sun that is left
/// there.
///
/// `sun` is kShines where enough places tell, kUnknown otherwise; `edges` are the places,
/// `agreeing` those deep enough to count. Less certain than EstimateSunSkyRatio(), and says so.
/// `daylight` is the model, `marker_from_world` with the heading in use.
SunSkyRatio EstimateRatioFromShade(const PhantomRays& phantoms, const UnmodelledShadows& unmodelled,
                                   const sky::SkyModel& daylight, const Mat3& marker_from_world);

}  // namespace pleinair::compositor
