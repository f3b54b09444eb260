#pragma once

#include <optional>

#include "app/options/local_time.h"
#include "base/units.h"
#include "base/utc_time.h"
#include "base/vector.h"
#include "export/plots/vector_drawing.h"
#include "sky/sun/sun_position.h"

namespace pleinair::app {

/// What a sun-path picture shows.
struct SunPathFacts {
  sky::Observer observer;
  int year = 2025;
  UtcOffset offset;  ///< Of the clock whose hours are drawn.
  sky::SunModel model = sky::SunModel::kPrecise;
  std::optional<UtcTime> moment;  ///< Marks the sun of that moment too.
};

/// Where in the picture a direction lies: stereographic projection of the upper hemisphere on its
/// horizon, seen from above as a map is: the zenith in the centre, north up, east right,
/// r = R tan((90° − elevation) / 2). Circles of the sky are circles in it.
Vec2 ProjectOnSunPath(Radians azimuth, Radians elevation);

/// The sun-path diagram of a place, as architects draw it: the sun's way on the 21st of each month,
/// the hours of a clock (a figure of eight each, by the equation of time), rings of elevation every
/// 10° and the compass. The sun is where it is seen, refraction included. First half of the year
/// solid, second half (from June to December) dashed.
exports::VectorDrawing DrawSunPath(const SunPathFacts& facts);

}  // namespace pleinair::app
