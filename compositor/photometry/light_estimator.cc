#include "compositor/photometry/light_estimator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "compositor/light/scaled_sky.h"
#include "compositor/photometry/heading_from_shadows.h"
#include "compositor/photometry/marker/marker_shade.h"
#include "compositor/photometry/marker/marker_shadow_edge.h"
#include "compositor/photometry/overcast_test.h"
#include "compositor/photometry/shade/ratio_from_shade.h"
#include "compositor/photometry/shade/unmodelled_shadows.h"
#include "compositor/photometry/sun_sky_ratio.h"
#include "scene/marker_heading.h"
#include "scene/sun_over_place.h"

namespace pleinair::compositor {
namespace {

// Logarithmic, between planes of one material: what an overcast sky may leave unexplained.
constexpr double kMostPlaneContrast = 0.6;
// The same, of planes that an overcast sky explains: patterns, bumps and stated places of phantoms.
constexpr double kPlaneContrastUnderCloud = 0.3;
// Planes of several materials, compared by their stated colours: of so many, facing so many ways.
// Logarithmic, root mean square: at least so much must be unexplained under each sun, and so many
// times what is under clouds. Rough colours add to both alike.
constexpr int kFewestSurfaces = 4, kFewestDirections = 3;
constexpr double kLeastAmongPlanes = 0.2, kTimesWorse = 2.0;
// Frames in which the print must be divided by a shadow, where so many were looked at.
constexpr int kFewestDivided = 2;
// Skies that a sun may have beside it, of the words': as they say, and in haze.
constexpr std::array kSkiesWithSun{1.0, 2.0, 4.0};

// How much stronger than the words' sky that is under which the shade of trees is looked for first,
// before its strength is known. A guess: words miss haze more often than anything else, shallower
// shade is found under a stronger sky only, and deeper shade under either.
constexpr LinearRgb kHazierSky{2.0, 2.0, 2.0};

/// How planes agree with the words' sun beside each of kSkiesWithSun.
template <typename Contrast>
std::vector<PlaneContrast> SunlitContrasts(const Contrast& contrast_under,
                                           const sky::SkyModel& day) {
  std::vector<PlaneContrast> contrasts;
  contrasts.reserve(kSkiesWithSun.size());
  for (const double sky : kSkiesWithSun) {
    contrasts.push_back(
        contrast_under(ScaledDaylight(day, LinearRgb{1, 1, 1} * sky, {1.0, 1.0, 1.0})));
  }
  return contrasts;
}

/// Whether planes agree with an overcast sky and with none that has a sun: those of one material
/// by themselves, or those of several materials by their stated colours.
bool IsLitByCloudsAlone(const PlaneContrast& clouds, const std::vector<PlaneContrast>& sunlit) {
  const bool within = clouds.within < kPlaneContrastUnderCloud &&
                      std::all_of(sunlit.begin(), sunlit.end(),
                                  [](const auto& sun) { return sun.within > kMostPlaneContrast; });
  const bool comparable =
      clouds.surfaces >= kFewestSurfaces && clouds.directions >= kFewestDirections;
  const bool among =
      comparable && std::all_of(sunlit.begin(), sunlit.end(), [&](const auto& sun) {
        return sun.among > kLeastAmongPlanes && sun.among > kTimesWorse * clouds.among;
      });
  return within || among;
}

bool MayShine(scene::Cloudiness stated) {
  return stated == scene::Cloudiness::kClear || stated == scene::Cloudiness::kHazy;
}

}  // namespace

LightLook::LightLook(std::shared_ptr<const LightSolver> solver, const CameraModel& camera,
                     const scene::MarkerPrint& print, const scene::SceneDescription& scene,
                     const LightOverrides& overrides, UtcTime time, const CameraResponse& response)
    : solver_(std::move(solver)),
      camera_(camera),
      scene_(scene),
      overrides_(overrides),
      time_(time),
      sun_(scene::SunOver(scene.place_time, time)),
      day_(SunlitSky(scene)->ForSun(sun_.ToSun(), sun_.distance_au)),
      samples_(*solver_, camera, print, response),
      meter_(print, *solver_, *day_, scene::MarkerFromWorld(scene.marker), response) {}

void LightLook::Add(ImageView<const std::uint8_t> rgb,
                    const Transform<Camera, Marker>& camera_from_marker) {
  if (const auto reading = meter_.Measure(rgb, camera_, camera_from_marker)) {
    gain_ = reading->gain;
    dappled_ += reading->dappled ? 1 : 0;
    // Leaves make two levels now and then, but neither is the open sun.
    const auto shadow = meter_.FindShadow(rgb, camera_, camera_from_marker);
    if (shadow && !reading->dappled) print_shadows_.push_back(*shadow);
  }
  samples_.AddFrame(rgb, camera_from_marker, gain_);
}

bool LightLook::IsPrintDivided(const UnmodelledShade& shade) const {
  const auto divided = static_cast<int>(print_shadows_.size());
  return divided > 0 && divided >= std::min(kFewestDivided, samples_.frames()) &&
         2 * divided >= samples_.frames() && !shade.ShadesPrint() &&
         (shade.crossed > 0 || MayShine(scene_.cloudiness));
}

void LightLook::SettleAsStated(FoundLight* found) const {
  const auto skies = StatedSky(scene_);
  const auto day = skies->ForSun(sun_.ToSun(), sun_.distance_au);
  const double ratio = SunToSky(*day);
  // Without a sun there is no shade to be found.
  if (ratio <= 0.0 || overrides_.sun_to_sky.value_or(ratio) <= 0.0) return;
  const double sky_scale = ratio / overrides_.sun_to_sky.value_or(ratio);
  const UnmodelledShade shade =
      FindUnmodelledShade(*solver_, samples_, meter_, *day, scene::MarkerFromWorld(scene_.marker),
                          LinearRgb{1, 1, 1} * sky_scale);
  if (shade.sunlit == 0) return;
  found->skies = {skies, {1.0, 1.0, 1.0}, shade.Matters()};
  found->measured.shaded = shade.shaded;
}

/// Where leaves and the like shade the ground, and whether they shade the print.
void LightLook::TakeShade(UnmodelledShade shade, FoundLight* found) const {
  found->skies.sunlight = std::make_shared<const SeenSunlight>(std::move(shade.sunlight));
  if (2 * dappled_ > samples_.frames() || shade.ShadesPrint()) {
    found->skies.print_shade =
        PrintShade(shade.open_gain, shade.sun_on_print, shade.ambient_on_print);
  }
  found->measured.print_shade = std::exp(MeanLog(found->skies.print_shade));
}

void LightLook::UseHeading(const LightMemory& memory, FoundLight* found) const {
  const auto known = overrides_.heading_deg ? std::nullopt : memory.Heading(time_);
  const HeadingOffset offset = known.value_or(HeadingOffset{});
  found->heading = Radians(scene_.marker.heading.value() + offset.offset.value());
  found->measured.heading_offset = offset.offset;
  found->measured.heading_error = known ? std::optional(offset.error) : std::nullopt;
  found->measured.heading_source =
      known ? MeasuredLight::Source::kMeasured : MeasuredLight::Source::kStated;
}

SunSkyReading LightLook::SettleHeading(LightMemory* memory, FoundLight* found) const {
  scene::MarkerDescription marker = scene_.marker;
  const Mat3 stated = scene::MarkerFromWorld(marker);
  LightMemory with_reading = *memory;
  if (!overrides_.heading_deg) {
    const Vec3 up = stated * Vec3{0.0, 0.0, 1.0};
    if (const auto heading = ReadHeading(*solver_, samples_, up, stated * day_->ToSun().xyz)) {
      with_reading.AddHeading(WeighedHeading(*heading), time_);
    }
  }
  UseHeading(with_reading, found);
  marker.heading = found->heading;
  const SunSkyReading reading =
      ReadSunAndSky(FindShadowEdges(*solver_, samples_, *day_, scene::MarkerFromWorld(marker)));
  if (reading.sun == SunSkyReading::Sun::kShines) {
    *memory = with_reading;
  } else {
    // Without a sun it was not shadows that the heading was read from.
    UseHeading(*memory, found);
  }
  found->measured.edges = reading.edges;
  found->measured.edges_agreeing = reading.agreeing;
  found->measured.edges_with_contrast = reading.share_with_contrast;
  return reading;
}

FoundLight LightLook::Settle(LightMemory* memory) const {
  FoundLight found;
  found.heading = scene_.marker.heading;
  MeasuredLight& light = found.measured;
  light.frames = samples_.frames();
  if (overrides_.as_stated) {
    SettleAsStated(&found);
    return found;
  }
  const SunSkyReading reading = SettleHeading(memory, &found);
  using Sun = SunSkyReading::Sun;
  scene::MarkerDescription marker = scene_.marker;
  marker.heading = found.heading;
  const auto shade_under = [&](LinearRgb sky_scale) {
    return FindUnmodelledShade(*solver_, samples_, meter_, *day_, scene::MarkerFromWorld(marker),
                               sky_scale);
  };
  const bool overridden = overrides_.sun_to_sky.has_value();
  if (overridden && *overrides_.sun_to_sky <= 0.0) return found;
  LinearRgb scale = reading.sky_scale;
  const auto known = overridden ? std::nullopt : memory->SkyBesideSun(time_);
  if (known && reading.sun != Sun::kShines) scale = known->scale;
  if (overridden) scale = LinearRgb{1, 1, 1} * (SunToSky(*day_) / *overrides_.sun_to_sky);
  UnmodelledShade shade = shade_under(scale);
  const bool may_shine = MayShine(scene_.cloudiness);
  const auto plane_contrast = [&](const sky::SkyModel& day) {
    return FindPlaneContrast(*solver_, samples_, day, scene::MarkerFromWorld(marker));
  };
  const auto overcast = OvercastSky();
  const auto settle_overcast = [&] {
    light.sun_source = MeasuredLight::Source::kMeasured;
    found.skies.source = overcast;
    memory->AddClouds();
    memory->Keep(light, found.skies);
    return found;
  };
  const auto settle_as_before = [&] {
    memory->Recall(time_, &light, &found.skies);
    return found;
  };
  const auto contrast_under_cloud = [&] {
    return plane_contrast(*overcast->ForSun(sun_.ToSun(), sun_.distance_au));
  };
  // Soft shade is wide where it is looked for as shallow as haze makes it, too.
  const bool edges_hidden =
      may_shine && shade.HidesEdges() &&
      (shade.CastBySun() || shade.IsWide() || shade_under(kHazierSky).IsWide());
  if (reading.sun == Sun::kHidden && !edges_hidden) {
    // Who gives the ratio says that the sun shines; where it does is not seen, nor then its shade.
    if (overridden) return found;
    light.sun_doubtful = shade.CastBySun() || contrast_under_cloud().within > kMostPlaneContrast;
    // Where the sun stands is doubtful, too: what lies in its shade would be a guess.
    if (light.sun_doubtful) return settle_as_before();
    return settle_overcast();
  }
  // Too few edges to tell, behind a house, say: planes that are lit as no sun would tell as well.
  if (!overridden && may_shine && reading.sun == Sun::kUnknown && !shade.CastBySun() &&
      IsLitByCloudsAlone(contrast_under_cloud(), SunlitContrasts(plane_contrast, *day_))) {
    light.edges_agreeing = 0;
    return settle_overcast();
  }
  const auto use_sun = [&](const SunSkyReading& seen) {
    memory->AddSun(WeighedScale(seen, scene_.cloudiness), time_);
    const auto with_seen = memory->SkyBesideSun(time_);
    scale = with_seen->scale;
    light.sun_to_sky_error = with_seen->relative_error;
  };
  if (!overridden && reading.sun == Sun::kShines) {
    light.sun_source = MeasuredLight::Source::kMeasured;
    SunSkyReading edges = reading;
    if (shade.HidesEdges()) {
      // Half-light on the sunny side makes the sky look too strong, there and between the leaves:
      // the weaker counts.
      const SunSkyReading depth =
          ReadShadeDepth(*solver_, shade, *day_, scene::MarkerFromWorld(marker));
      if (depth.sun == Sun::kShines && depth.sky_scale.g < reading.sky_scale.g) {
        edges = depth;
        light.sun_source = MeasuredLight::Source::kShade;
        light.shade_places = depth.agreeing;
      }
    }
    use_sun(edges);
    if (light.sun_source == MeasuredLight::Source::kShade) shade = shade_under(scale);
  } else if (!overridden) {
    // One material and a sharp edge: surer than the deepest of the trees' shade.
    SunSkyReading seen;
    if (IsPrintDivided(shade)) {
      seen = ReadPrintShadow(*solver_, print_shadows_, *day_, scene::MarkerFromWorld(marker));
    }
    if (seen.sun == Sun::kShines) {
      light.sun_source = MeasuredLight::Source::kMarker;
    } else {
      if (!may_shine || shade.sunlit == 0) return settle_as_before();
      // Half as deep a shade as the words have it is looked for, too: haze is what they miss.
      const UnmodelledShade probe = shade_under(kHazierSky);
      if (probe.Matters()) {
        seen = ReadShadeDepth(*solver_, probe, *day_, scene::MarkerFromWorld(marker));
      }
      if (seen.sun == Sun::kShines) {
        light.sun_source = MeasuredLight::Source::kShade;
        light.shade_places = seen.agreeing;
      }
    }
    if (seen.sun == Sun::kShines) {
      use_sun(seen);
      shade = shade_under(scale);
    }
  }
  const bool told = overridden || light.sun_source != MeasuredLight::Source::kStated;
  if (!told && memory->SawClouds()) return settle_as_before();
  if (!told) memory->RecallReasons(time_, &light);
  if (told || known) {
    const MeasuredSky sky = SkyScaledBesideSun(*day_, scale, sun_.distance_au);
    found.skies = {sky.skies, sky.sky_scale, shade.Matters()};
  } else {
    found.skies = {StatedSky(scene_), {1.0, 1.0, 1.0}, shade.Matters()};
  }
  light.shaded = shade.shaded;
  if (shade.Matters()) TakeShade(std::move(shade), &found);
  if (!overridden) memory->Keep(light, found.skies);
  return found;
}

}  // namespace pleinair::compositor
