#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "base/units.h"
#include "sky/clouds/cloud_sky.h"
#include "sky/clouds/film/film_layer.h"
#include "sky/daylight.h"

namespace pleinair::clouds::testing {

inline Direction<World> SunAbove(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kRadiansPerDegree;
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {{std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
           std::sin(elevation)}};
}

inline FilmSky SkyOfFilm(Direction<World> to_sun) {
  return {[to_sun](double) { return to_sun; }, sky::CreateDaylight({})->ForSun(to_sun, 1.0), 0.2};
}

/// What a camera would see of a layer's light: `noise` of both, relative, and an exposure of its
/// own.
struct MadeFilm {
  std::vector<FilmLight> frames;
  FilmCourse truth;  ///< Without noise.
};

inline MadeFilm FilmLayerOfClouds(const CloudLayer& layer, const FilmSky& sky, double length_s,
                                  int frames, double noise, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  const CloudFields fields = MakeFields({layer});
  const CloudSky first(sky.clear, fields, sky.ground_albedo, 0.0);
  const double cosine = sky.clear->ToSun().xyz.z;
  const double clear_sun = Luminance(sky.clear->SunNormalIrradiance()) * cosine;
  const double clear_sky = Luminance(sky.clear->SkyHorizontalIrradiance());
  const double exposure = 1e-5;
  // The sky changes slowly: it is computed at some times.
  constexpr int kSkies = 32;
  std::vector<double> sky_times, skies;
  for (int i = 0; i < kSkies; ++i) {
    sky_times.push_back(length_s * i / (kSkies - 1));
    skies.push_back(Luminance(CloudSky(first, sky_times.back()).DomeIlluminance(32)) / clear_sky);
  }
  MadeFilm film;
  for (int i = 0; i < frames; ++i) {
    const double seconds = length_s * i / (frames - 1);
    film.truth.seconds.push_back(seconds);
    film.truth.sun.push_back(SunTransmittance(fields, {}, sky.clear->ToSun(), seconds));
    film.truth.sky.push_back(ValueAt(sky_times, skies, seconds));
    film.frames.push_back(
        {seconds,
         exposure * clear_sun *
             std::max(0.0, film.truth.sun.back() * (1.0 + noise * normal(engine)) +
                               0.3 * noise * normal(engine)),
         exposure * clear_sky * film.truth.sky.back() * (1.0 + noise * normal(engine))});
  }
  return film;
}

}  // namespace pleinair::clouds::testing
