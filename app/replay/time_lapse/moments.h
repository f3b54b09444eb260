#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/options/local_time.h"
#include "base/error.h"
#include "base/utc_time.h"
#include "scene/scene_description.h"

namespace pleinair::app {

/// The part of a day, or the days, that a time-lapse shows, and its time step.
struct TimeLapseOptions {
  /// Minutes after midnight on a clock. Without an offset, the clock is the whole hour nearest to
  /// local solar time.
  struct Hours {
    int from_min = 0, until_min = 0;
    std::optional<UtcOffset> clock;
  };
  /// One time of each day. Days since 1970, on the clock.
  struct Dates {
    std::int64_t from_day = 0, until_day = 0;
    std::optional<int> at_min;  ///< Nothing: the time at which the recording begins.
    std::optional<UtcOffset> clock;
  };
  /// Nothing, without `dates` too: from half an hour before sunrise to half an hour after sunset.
  std::optional<Hours> hours;
  std::optional<Dates> dates;
  double every_s = 600.0;             ///< Between images.
  std::optional<std::int64_t> frame;  ///< Frame of the camera pose; nothing: the middle one.
};

/// Parses `hours`: "day" or "05:00..21:00", optionally with the clock's offset
/// ("05:00..21:00+02:00"). Or dates, "2025-04-15..2025-10-15", optionally with a time of day
/// ("2025-04-15..2025-10-15@12:00+02:00"). The default clock is the whole hour nearest to local
/// solar time. `every`: "10min", "90s", "1h"; of dates "1d", "2w"; nothing: 10 minutes, or a day.
/// Errors (input): other text, an end before its start.
Result<TimeLapseOptions> ParseTimeLapse(const std::string& hours,
                                        const std::optional<std::string>& every);

struct TimeLapseMoments {
  std::vector<UtcTime> times;
  UtcOffset clock;
  bool over_dates = false;
};

/// Returns the times: those of `dates`, or on the day, by the clock, in which the recording begins.
/// Errors (input): "day" without a sunrise, more than 1440 images (one per minute of a day).
Result<TimeLapseMoments> MomentsOf(const TimeLapseOptions& options, const scene::PlaceTime& place);

}  // namespace pleinair::app
