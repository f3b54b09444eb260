#pragma once

#include "scene/scene_description.h"

namespace pleinair::compositor {

/// Prior of sun and sky from the scene description, before any frame.
struct LightPrior {
  /// Probabilities that the sun shines from where the model has it, that clouds hide it, and that
  /// it stands elsewhere. The last means a wrong time, place or heading. Their sum is 1.
  double sun = 1.0, clouds = 0.0, elsewhere = 0.0;
  /// One standard deviation of the logarithm of the sky's radiance beside the sun.
  double log_sky_error = 0.0;
};

/// Returns the prior for a described cloudiness. One description in ten or twenty is assumed to be
/// wrong or outdated. This is our figure, without a source. The sky beside the sun varies by haze
/// that descriptions omit. Between days of turbidity 2 to 5, a clear sky's horizontal irradiance
/// has a relative standard deviation of about a third (Perez, Seals, Michalsky 1993).
LightPrior PriorOf(scene::Cloudiness stated);

}  // namespace pleinair::compositor
