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

/// Which part of a day a time-lapse shows, and how often.
struct TimeLapseOptions {
  /// Minutes after midnight on a clock; without an offset, the hour nearest to local solar time.
  struct Hours {
    int from_min = 0, until_min = 0;
    std::optional<UtcOffset> clock;
  };
  /// Nothing: from half an hour before sunrise to half an hour after sunset.
  std::optional<Hours> hours;
  double every_s = 600.0;             ///< Between pictures.
  std::optional<std::int64_t> frame;  ///< Whose camera looks on; nothing: the middle one's.
};

/// "day", or "05:00..21:00", with the clock's offset after it ("05:00..21:00+02:00") where it is
/// not the hour nearest to local solar time. `every`: "10min", "90s", "1h". Errors (input):
/// anything else, an end before its beginning.
Result<TimeLapseOptions> ParseTimeLapse(const std::string& hours, const std::string& every);

struct TimeLapseMoments {
  std::vector<UtcTime> times;
  UtcOffset clock;
};

/// The moments of the day, on the clock, in which the recording begins. Errors (input): no sunrise
/// on a day that is asked for by it, more than a day's minutes of pictures.
Result<TimeLapseMoments> MomentsOf(const TimeLapseOptions& options, const scene::PlaceTime& place);

}  // namespace pleinair::app
