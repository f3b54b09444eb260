#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include "base/utc_time.h"
#include "base/vector.h"
#include "compositor/light/sun_transmittance_map.h"
#include "session/baked_lighting.h"
#include "session/light_follower.h"
#include "sky/clouds/cloud_shadow.h"
#include "sky/clouds/cloud_shadow_map.h"
#include "sky/sun/sun_position.h"

namespace pleinair::session {

/// The light of each frame by the layers of clouds that a scene states
/// (LightChangeMode::kStated). A baked light has the sky of its moment and the sun above the
/// clouds. Frames change their strengths: the sun by the shadow of the layers on the scene, the sky
/// by its illuminance of level ground. The sky's illuminance is computed each second and is linear
/// between.
class StatedLight {
 public:
  explicit StatedLight(clouds::CloudFields fields) : fields_(std::move(fields)) {}

  const clouds::CloudFields& fields() const { return fields_; }

  struct OfFrame {
    FollowedLight followed;
    std::shared_ptr<const compositor::SunTransmittanceMap> shadow;
  };
  /// The light of a frame, relative to `baked`, which has these layers. `sun`: that of the frame.
  OfFrame At(const std::shared_ptr<const BakedLighting>& baked, UtcTime time,
             const sky::SunPosition& sun);

 private:
  LinearRgb SkyAt(const BakedLighting& baked, double seconds);
  const LinearRgb& SkyOfSecond(const BakedLighting& baked, std::int64_t second);
  LinearRgb SkyOf(const BakedLighting& baked, double seconds) const;

  clouds::CloudFields fields_;
  std::shared_ptr<const BakedLighting> baked_;  ///< Baked for the values below.
  clouds::GroundBox box_;
  LinearRgb baked_sky_;                          ///< As SkyOf(), at its time.
  std::map<std::int64_t, LinearRgb> by_second_;  ///< The last seconds.
};

}  // namespace pleinair::session
