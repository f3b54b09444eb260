#pragma once

#include "scene/scene_description.h"

namespace pleinair::compositor {

/// What the words of a scene description say of sun and sky before any frame is seen.
struct LightPrior {
  /// Probabilities that the sun shines from where the model has it, that clouds hide it, and that
  /// it stands elsewhere (a wrong time, place or heading). Their sum is 1.
  double sun = 1.0, clouds = 0.0, elsewhere = 0.0;
  /// One standard deviation of the logarithm of the sky's radiance beside the sun.
  double log_sky_error = 0.0;
};

/// People say what they see, mostly: one description in ten or twenty is wrong or outdated. Ours,
/// without a source. The sky beside the sun varies by haze that descriptions omit: a clear day's
/// horizontal sky irradiance has a relative standard deviation of about a third between days of
/// turbidity 2 to 5 (Perez, Seals, Michalsky 1993).
LightPrior PriorOf(scene::Cloudiness stated);

}  // namespace pleinair::compositor
