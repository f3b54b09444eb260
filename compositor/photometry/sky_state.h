#pragma once

#include <memory>

#include "base/vector.h"
#include "compositor/light/sun_transmittance_map.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Skies of a day whose light was measured or stated.
struct SkyState {
  std::shared_ptr<const sky::SkySource> source;
  LinearRgb scale{1.0, 1.0, 1.0};  ///< To multiply the sky with; the sun stays.
  /// Whether trees and the like may shade what the phantoms leave in the sun.
  bool unmodelled_shadows = true;
  /// How much of the sun these leave, across its rays; null: all. A light's own is null once the
  /// sun has left the place that the map was made for.
  std::shared_ptr<const SunTransmittanceMap> sun_transmittance{};
  /// To multiply the camera's exposure scale with: above 1 where leaves shade all of the print.
  LinearRgb marker_shade{1.0, 1.0, 1.0};
};

}  // namespace pleinair::compositor
