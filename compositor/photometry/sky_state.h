#pragma once

#include <memory>

#include "base/vector.h"
#include "compositor/light/sun_transmittance_map.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Skies of a day whose light was measured or described.
struct SkyState {
  std::shared_ptr<const sky::SkySource> source;
  LinearRgb scale{1.0, 1.0, 1.0};  ///< Multiplies the sky; the sun stays.
  /// True if unmodelled objects such as trees may shade what the phantoms leave sunlit.
  bool unmodelled_shadows = true;
  /// Sun transmittance of unmodelled objects, across the sun's rays; null: all of it. A light's own
  /// map is null once the sun has left the position that the map was made for.
  std::shared_ptr<const SunTransmittanceMap> sun_transmittance{};
  /// Multiplies the camera's exposure scale. Above 1 where leaves shade the whole marker.
  LinearRgb marker_shade{1.0, 1.0, 1.0};
};

}  // namespace pleinair::compositor
