#pragma once

#include <optional>

#include "app/options/local_time.h"
#include "base/units.h"
#include "base/utc_time.h"
#include "base/vector.h"
#include "export/plots/vector_drawing.h"
#include "sky/sun/sun_position.h"

namespace pleinair::app {

/// Content of a sun-path diagram.
struct SunPathFacts {
  sky::Observer observer;
  int year = 2025;
  UtcOffset offset;  ///< Clock of the hours drawn.
  sky::SunModel model = sky::SunModel::kPrecise;
  std::optional<UtcTime> moment;  ///< Also marks the sun at that time.
};

/// Position of a direction in the diagram: stereographic projection of the upper hemisphere onto
/// its horizon, seen from above like a map. The zenith is in the centre, north up, east right, r =
/// R tan((90° − elevation) / 2). Circles of the sky are circles in it.
Vec2 ProjectOnSunPath(Radians azimuth, Radians elevation);

/// Draws the sun-path diagram of a place, as architects use it. It shows the sun's path on the 21st
/// of each month, and the hours of a clock. Each hour is an analemma, a figure of eight due to the
/// equation of time. It also shows rings of elevation every 10° and the compass. Positions include
/// refraction. The first half of the year is solid, the second half (from June to December) dashed.
exports::VectorDrawing DrawSunPath(const SunPathFacts& facts);

}  // namespace pleinair::app
