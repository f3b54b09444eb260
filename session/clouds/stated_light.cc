#include "session/clouds/stated_light.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "compositor/light/sky_table.h"
#include "scene/sun_over_place.h"
#include "session/clouds/cloud_shadow.h"
#include "sky/clouds/cloud_sky.h"

namespace pleinair::session {
namespace {

/// Factor on the light that the marker reflects.
LinearRgb MarkerLightFactor(const BakedLighting& baked, const CloudShadow& shadow, LinearRgb sky) {
  LinearRgb of_sun;
  if (baked.meter && baked.meter->in_sun()) {
    const LinearRgb all = baked.meter->light_on_marker();
    const double cosine = std::max(0.0, (baked.marker_from_world * baked.sun.ToSun().xyz).z);
    const LinearRgb direct = baked.daylight.SunNormalIrradiance() * cosine;
    const auto share = [](double part, double whole) {
      return whole > 0.0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0;
    };
    of_sun = {share(direct.r, all.r), share(direct.g, all.g), share(direct.b, all.b)};
  }
  const LinearRgb one{1.0, 1.0, 1.0};
  return of_sun * shadow.at_marker + (one + of_sun * -1.0) * sky;
}

}  // namespace

LinearRgb StatedLight::SkyOf(const BakedLighting& baked, double seconds) const {
  const UtcTime time = baked.request.place.start.PlusSeconds(seconds);
  const clouds::CloudSky sky(
      WithScaledSky(ClearSkyOf(baked.request, scene::SunOver(baked.request.place, time)),
                    baked.request.skies.scale),
      fields_, compositor::kLandAlbedo, seconds);
  return sky.SkyHorizontalIrradiance();
}

const LinearRgb& StatedLight::SkyOfSecond(const BakedLighting& baked, std::int64_t second) {
  const auto found = by_second_.find(second);
  if (found != by_second_.end()) return found->second;
  constexpr int kKept = 4;
  while (std::ssize(by_second_) >= kKept) by_second_.erase(by_second_.begin());
  return by_second_.emplace(second, SkyOf(baked, static_cast<double>(second))).first->second;
}

LinearRgb StatedLight::SkyAt(const BakedLighting& baked, double seconds) {
  const double whole = std::floor(seconds);
  const auto second = static_cast<std::int64_t>(whole);
  const LinearRgb before = SkyOfSecond(baked, second);
  const double part = seconds - whole;
  if (part <= 0.0) return before;
  return before * (1.0 - part) + SkyOfSecond(baked, second + 1) * part;
}

StatedLight::OfFrame StatedLight::At(const std::shared_ptr<const BakedLighting>& baked,
                                     UtcTime time, const sky::SunPosition& sun) {
  const LightingRequest& request = baked->request;
  if (baked != baked_) {
    baked_ = baked;
    box_ = BoxOf(baked->meshes, baked->marker_from_world);
    by_second_.clear();
    baked_sky_ = SkyAt(*baked, request.CloudSeconds(request.time));
  }
  const double seconds = request.CloudSeconds(time);
  const CloudShadow shadow =
      MakeCloudShadow(fields_, box_, sun.ToSun(), baked->marker_from_world, seconds);
  const LinearRgb none{1e-9, 1e-9, 1e-9};
  OfFrame frame;
  frame.shadow = shadow.map;
  frame.followed.mix.sun = LinearRgb{1.0, 1.0, 1.0} * shadow.sun;
  frame.followed.mix.sky = (SkyAt(*baked, seconds) + none) / (baked_sky_ + none);
  frame.followed.marker_light = MarkerLightFactor(*baked, shadow, frame.followed.mix.sky);
  frame.followed.source = compositor::FrameLight::Source::kStated;
  return frame;
}

}  // namespace pleinair::session
