#include "app/light_look.h"

#include <algorithm>
#include <utility>

#include "compositor/shadow_contrast.h"
#include "compositor/shadow_heading.h"
#include "compositor/unmodelled_shade.h"

namespace pleinair::app {
namespace {

// Leaves let through this much at the least in their brightest gaps; more is another's mistake.
constexpr double kDeepestPrintShade = 1.6;

}  // namespace

LightLook::LightLook(std::shared_ptr<const compositor::LightSolver> solver,
                     const CameraModel& camera, const compositor::MarkerPrint& print,
                     const devices::SceneDescription& scene, const LightOverrides& overrides,
                     UtcTime time, const CameraResponse& response)
    : solver_(std::move(solver)),
      camera_(camera),
      scene_(scene),
      overrides_(overrides),
      sun_(SunOver(scene.place_time, time)),
      day_(SunlitSky(scene)->ForSun(sun_.ToSun(), sun_.distance_au)),
      samples_(*solver_, camera, print, response),
      meter_(print, *solver_, *day_, MarkerFromWorld(scene.marker), response) {}

void LightLook::Add(ImageView<const std::uint8_t> rgb,
                    const Transform<Camera, Marker>& camera_from_marker) {
  if (const auto reading = meter_.Measure(rgb, camera_, camera_from_marker)) {
    gain_ = reading->gain;
    dappled_ += reading->dappled ? 1 : 0;
  }
  samples_.AddFrame(rgb, camera_from_marker, gain_);
}

FoundLight LightLook::Settle() const {
  FoundLight found;
  found.heading = scene_.marker.heading;
  MeasuredLight& light = found.measured;
  light.frames = samples_.frames();
  devices::MarkerDescription marker = scene_.marker;
  const Mat3 stated = MarkerFromWorld(marker);
  if (!overrides_.heading_deg) {
    const Vec3 up = stated * Vec3{0.0, 0.0, 1.0};
    if (const auto heading =
            compositor::ReadHeading(*solver_, samples_, up, stated * day_->ToSun().xyz)) {
      WeighHeading(*heading, &light);
      marker.heading = Radians(found.heading.value() + light.heading_offset.value());
    }
  }
  const compositor::SunSkyReading reading = compositor::ReadSunAndSky(
      compositor::FindShadowEdges(*solver_, samples_, *day_, MarkerFromWorld(marker)));
  light.edges = reading.edges;
  light.edges_agreeing = reading.agreeing;
  using Sun = compositor::SunSkyReading::Sun;
  if (reading.sun != Sun::kShines && light.heading_source == MeasuredLight::Source::kMeasured) {
    // Without a sun it was not shadows that the heading was read from.
    marker.heading = found.heading;
    light.heading_offset = light.heading_error = {};
    light.heading_source = MeasuredLight::Source::kStated;
  }
  found.heading = marker.heading;
  if (overrides_.sun_to_sky || reading.sun == Sun::kUnknown) return found;
  compositor::UnmodelledShade shade = compositor::FindUnmodelledShade(
      *solver_, samples_, *day_, MarkerFromWorld(marker), reading.sky_scale);
  if (reading.sun == Sun::kHidden && shade.CastBySun()) {
    light.sun_doubtful = true;
    return found;
  }
  light.sun_source = MeasuredLight::Source::kMeasured;
  if (reading.sun == Sun::kHidden) {
    found.skies.source = OvercastSky();
    return found;
  }
  const LinearRgb scale = WeighedScale(reading, scene_.cloudiness, &light.sun_to_sky_error);
  const LinearRgb share = day_->SkyHorizontalIrradiance() / day_->SunNormalIrradiance() * scale;
  const MeasuredSky measured = SkyWithShare(share, day_->ToSun(), sun_.distance_au);
  found.skies = {measured.skies, measured.sky_scale, shade.Matters()};
  light.shaded = shade.shaded;
  if (shade.Matters()) {
    found.skies.sunlight =
        std::make_shared<const compositor::SeenSunlight>(std::move(shade.sunlight));
    if (2 * dappled_ > samples_.frames()) {
      found.skies.print_shade = std::clamp(shade.open_gain, 1.0, kDeepestPrintShade);
    }
    light.print_shade = found.skies.print_shade;
  }
  return found;
}

}  // namespace pleinair::app
