#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/units.h"
#include "base/utc_time.h"
#include "sky/sun/sun_position.h"

namespace pleinair::sky {

/// Elevations of the disc's centre, airless, at which the almanacs define rise, set and twilight.
enum class SunHorizon {
  kSunrise,  ///< −0.8333°: the upper limb on the sea's horizon (34′ of refraction, 16′ of disc).
  kCivil,         ///< −6°: civil twilight.
  kNautical,      ///< −12°: nautical twilight.
  kAstronomical,  ///< −18°: astronomical twilight.
};
inline constexpr std::size_t kSunHorizons = 4;
Radians HorizonElevation(SunHorizon horizon);

/// Passages of the sun through one of these elevations in a time span.
struct HorizonPassages {
  std::vector<UtcTime> rises;  ///< In order of time; more than one where the span contains several.
  std::vector<UtcTime> sets;
  double seconds_above = 0.0;  ///< Time in the span with the sun above the elevation.

  bool Never() const { return rises.empty() && sets.empty() && seconds_above <= 0.0; }
  bool Always() const { return rises.empty() && sets.empty() && seconds_above > 0.0; }
};

/// Events of the sun from `begin` (included) to `end` (excluded).
struct SunDay {
  UtcTime begin, end;
  std::array<HorizonPassages, kSunHorizons> passages;  ///< By SunHorizon.
  std::vector<UtcTime> noons;                          ///< Upper transits.
  std::vector<UtcTime> midnights;                      ///< Lower transits.

  const HorizonPassages& At(SunHorizon horizon) const {
    return passages[static_cast<std::size_t>(horizon)];
  }
};

/// Finds every passage to 0.1 s of the model, also when the sun barely touches the elevation: it
/// locates the extrema first, and between them the elevation is monotonic. The span is any time
/// span up to some weeks, usually a calendar day (cost: one sun position per quarter of an hour).
/// Near midnight sun, a calendar day may contain two sunsets, or only one of sunrise and sunset.
SunDay ComputeSunDay(const Observer& observer, UtcTime begin, UtcTime end,
                     SunModel model = SunModel::kPrecise);

}  // namespace pleinair::sky
