// Mean light over a day against observers' records.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/units.h"
#include "sky/clouds/cloud_sky.h"
#include "sky/daylight.h"

namespace pleinair::clouds {
namespace {

/// Share of the dome, by solid angle, in which an observer sees cloud: the mean over places.
double ShareOfDome(const CloudField& field) {
  constexpr int kPlaces = 40, kRays = 400;
  int cloudy = 0;
  for (int place = 0; place < kPlaces; ++place) {
    const Vec3 at{std::fmod(place * 7129.0, kCoverSquare_m),
                  std::fmod(place * 3571.0, kCoverSquare_m), 0.0};
    for (int ray = 0; ray < kRays; ++ray) {
      const double up = (ray + 0.5) / kRays, azimuth = 2.399963 * ray + place;
      const double level = std::sqrt(1.0 - up * up);
      cloudy += field.DepthAlong(at, {level * std::sin(azimuth), level * std::cos(azimuth), up},
                                 0.0) > CloudyDepth(field.layer());
    }
  }
  return cloudy / static_cast<double>(kPlaces * kRays);
}

/// Light of a midsummer day at 50° north, over that of a clear one.
double ShareOfLight(const CloudFields& fields) {
  const double latitude = 50.0 * kRadiansPerDegree, declination = 23.4 * kRadiansPerDegree;
  double light = 0.0, clear_light = 0.0;
  for (int hour = -6; hour <= 6; hour += 3) {
    const double angle = 15.0 * hour * kRadiansPerDegree;
    const double up = std::sin(latitude) * std::sin(declination) +
                      std::cos(latitude) * std::cos(declination) * std::cos(angle);
    const double level = std::sqrt(1.0 - up * up);
    const Direction<World> to_sun{{-level * std::sin(angle), -level * std::cos(angle), up}};
    const auto clear = sky::CreateDaylight({})->ForSun(to_sun, 1.0);
    const AreaLight area = ComputeAreaLight(fields, *clear, 0.2, 0.0);
    light += Luminance(area.sun_horizontal + area.sky_horizontal);
    clear_light +=
        Luminance(clear->SunNormalIrradiance()) * up + Luminance(clear->SkyHorizontalIrradiance());
  }
  return light / clear_light;
}

// Kasten & Czeplak 1980: 1 - 0.75 N^3.4, where N is the share of the sky that an observer sees
// covered. Clouds with sides cover more of it than of the ground.
TEST(MeanLight, IsThatOfObserversWhoSeeAsMuchCloud) {
  // By a mean sky: under an overcast one, a quarter of the light is left at an optical depth of 40.
  for (const char* text :
       {"kind=cumulus,cover=0.25", "kind=cumulus,cover=0.4", "kind=stratocumulus,cover=0.25",
        "kind=stratocumulus,cover=0.6", "kind=cumulus,cover=0.5,optical_depth=40",
        "kind=cumulus,cover=0.75,optical_depth=40", "kind=cumulus,cover=1,optical_depth=40"}) {
    const CloudLayer layer = ParseCloudLayer(text).value();
    const CloudFields fields = MakeFields({layer});
    const double seen = ShareOfDome(*fields.front());
    EXPECT_GE(seen, layer.cover) << text;
    EXPECT_NEAR(ShareOfLight(fields), 1.0 - 0.75 * std::pow(seen, 3.4), 0.08) << text << seen;
  }
}

// The default optical depths leave more light under an overcast sky than that formula. A
// homogeneous layer, by adding-doubling alone, shows the same.
TEST(MeanLight, OfThinnerOvercastIsThatOfItsDepth) {
  for (const double depth : {12.0, 20.0}) {
    CloudLayer slab = ParseCloudLayer("kind=slab").value();
    slab.optical_depth = depth;
    EXPECT_GT(ShareOfLight(MakeFields({slab})), 0.25 + 0.08) << depth;
  }
}

}  // namespace
}  // namespace pleinair::clouds
