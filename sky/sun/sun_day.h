#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/units.h"
#include "base/utc_time.h"
#include "sky/sun/sun_position.h"

namespace pleinair::sky {

/// Elevations at which the almanacs begin and end something; airless, of the disc's centre.
enum class SunHorizon {
  kSunrise,  ///< −0.8333°: the upper limb on the sea's horizon (34′ of refraction, 16′ of disc).
  kCivil,         ///< −6°: civil twilight.
  kNautical,      ///< −12°: nautical twilight.
  kAstronomical,  ///< −18°: astronomical twilight.
};
inline constexpr std::size_t kSunHorizons = 4;
Radians HorizonElevation(SunHorizon horizon);

/// How the sun passes one of these elevations in a span of time.
struct HorizonPassages {
  std::vector<UtcTime> rises;  ///< In time's order; more than one where the span holds them.
  std::vector<UtcTime> sets;
  double seconds_above = 0.0;  ///< How much of the span the sun is higher.

  bool Never() const { return rises.empty() && sets.empty() && seconds_above <= 0.0; }
  bool Always() const { return rises.empty() && sets.empty() && seconds_above > 0.0; }
};

/// All that the sun does from `begin` (included) to `end` (excluded).
struct SunDay {
  UtcTime begin, end;
  std::array<HorizonPassages, kSunHorizons> passages;  ///< By SunHorizon.
  std::vector<UtcTime> noons;                          ///< Upper transits.
  std::vector<UtcTime> midnights;                      ///< Lower transits.

  const HorizonPassages& At(SunHorizon horizon) const {
    return passages[static_cast<std::size_t>(horizon)];
  }
};

/// Every passage to 0.1 s of the model, also those of a sun that only just touches the horizon: the
/// highest and lowest points are sought first, and between them the elevation is monotonic. The
/// span is a calendar day or what the caller likes, up to some weeks (a position every quarter of
/// an hour); near midnight sun a calendar day may hold two sunsets, or only one of a pair.
SunDay ComputeSunDay(const Observer& observer, UtcTime begin, UtcTime end,
                     SunModel model = SunModel::kPrecise);

}  // namespace pleinair::sky
