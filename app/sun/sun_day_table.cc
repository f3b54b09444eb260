#include "app/sun/sun_day_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "app/sun/sun_rows.h"
#include "app/terminal/progress_bar.h"
#include "files/result_file.h"
#include "sky/sun/sun_clock.h"
#include "sky/sun/sun_day.h"
#include "sky/sun/sun_events.h"

namespace pleinair::app {
namespace {

constexpr double kDaySeconds = 86'400.0;

/// Names by sky::SunHorizon.
struct HorizonNames {
  const char* rise;
  const char* set;
  const char* above;  ///< Reason if there is no passage.
  const char* below;
};
constexpr std::array<HorizonNames, sky::kSunHorizons> kNames = {{
    {"sunrise", "sunset", "sun stays up", "sun stays down"},
    {"civil_dawn", "civil_dusk", "sun stays above -6 degrees", "sun stays below -6 degrees"},
    {"nautical_dawn", "nautical_dusk", "sun stays above -12 degrees",
     "sun stays below -12 degrees"},
    {"astronomical_dawn", "astronomical_dusk", "sun stays above -18 degrees",
     "sun stays below -18 degrees"},
}};

std::string JsonTime(const std::optional<UtcTime>& time, UtcOffset clock) {
  return time ? '"' + FormatLocal(*time, clock) + '"' : "null";
}

std::string Clock(double seconds) {
  const std::int64_t whole = std::llround(std::fabs(seconds));
  return fmt::format("{}{:02}:{:02}:{:02}", seconds < 0.0 && whole != 0 ? "-" : "", whole / 3600,
                     whole / 60 % 60, whole % 60);
}

/// Degrees that do not round up to 360.
double RoundedAzimuth(const sky::SunPosition& sun) {
  constexpr double kLastDigit = 1e-4;
  const double degrees = std::round(ToDegrees(sun.azimuth) / kLastDigit) * kLastDigit;
  return degrees >= 360.0 - 0.5 * kLastDigit ? 0.0 : degrees;
}

const char* Presence(sky::SunPresence presence) {
  return presence == sky::SunPresence::kStaysUp     ? "stays up"
         : presence == sky::SunPresence::kStaysDown ? "stays down"
                                                    : "rises or sets";
}

sky::SunPresence PresenceIn(const sky::HorizonPassages& passages) {
  return passages.Always()  ? sky::SunPresence::kStaysUp
         : passages.Never() ? sky::SunPresence::kStaysDown
                            : sky::SunPresence::kPasses;
}

/// Reason for a missing passage of an elevation; " on this day" if the sun crosses it otherwise.
std::string WhyNone(sky::SunPresence presence, std::size_t horizon) {
  switch (presence) {
    case sky::SunPresence::kStaysUp:
      return std::string(": ") + kNames[horizon].above;
    case sky::SunPresence::kStaysDown:
      return std::string(": ") + kNames[horizon].below;
    case sky::SunPresence::kPasses:
      break;
  }
  return " on this day";
}

/// An event of the sun, for the list of a day.
struct Happening {
  UtcTime time;
  const char* name;
};

std::vector<Happening> InOrder(const sky::SunDay& day) {
  std::vector<Happening> list;
  for (std::size_t h = 0; h < sky::kSunHorizons; ++h) {
    for (const UtcTime time : day.passages[h].rises) list.push_back({time, kNames[h].rise});
    for (const UtcTime time : day.passages[h].sets) list.push_back({time, kNames[h].set});
  }
  for (const UtcTime time : day.noons) list.push_back({time, "noon"});
  for (const UtcTime time : day.midnights) list.push_back({time, "midnight"});
  std::sort(list.begin(), list.end(),
            [](const Happening& a, const Happening& b) { return a.time < b.time; });
  return list;
}

/// A day with the values that the output adds to the passages.
struct DayFacts {
  sky::SunDay day;
  std::optional<UtcTime> noon;  ///< The first one.
  UtcTime reference;            ///< The noon, or the day's middle.
  sky::SunPosition at_noon;     ///< At the reference time.
  double equation_of_time_s = 0.0;

  /// If there are several, the one next to noon, on its side.
  std::optional<UtcTime> Rise(std::size_t h) const {
    std::optional<UtcTime> found;
    for (const UtcTime time : day.passages[h].rises) {
      if (time <= reference || !found) found = time;
    }
    return found;
  }
  std::optional<UtcTime> Set(std::size_t h) const {
    std::optional<UtcTime> found;
    for (const UtcTime time : day.passages[h].sets) {
      if (!found || *found < reference) found = time;
    }
    return found;
  }
};

DayFacts ComputeDay(const sky::Observer& observer, UtcTime midnight, sky::SunModel model) {
  DayFacts facts;
  facts.day = ComputeSunDay(observer, midnight, midnight.PlusSeconds(kDaySeconds), model);
  if (!facts.day.noons.empty()) facts.noon = facts.day.noons.front();
  facts.reference = facts.noon.value_or(midnight.PlusSeconds(0.5 * kDaySeconds));
  facts.at_noon = ComputeSunPosition(observer, facts.reference, model);
  facts.equation_of_time_s =
      sky::EquationOfTimeSeconds(facts.reference, observer.ut1_minus_utc_s, model);
  return facts;
}

std::string DayJson(const sky::Observer& observer, const DayFacts& facts, UtcOffset offset,
                    sky::SunModel model) {
  const sky::HorizonPassages& horizon = facts.day.At(sky::SunHorizon::kSunrise);
  std::string json = fmt::format(
      R"({{"day":"{}","utc_offset":"{}","lat":{:.9g},"lon":{:.9g},"height_m":{:.9g},"sun":"{}")",
      FormatLocalDate(facts.day.begin, offset), ToString(offset), ToDegrees(observer.latitude),
      ToDegrees(observer.longitude), observer.height.value(), Presence(PresenceIn(horizon)));
  for (std::size_t h = 0; h < sky::kSunHorizons; ++h) {
    json += fmt::format(R"(,"{}":{},"{}":{})", kNames[h].rise, JsonTime(facts.Rise(h), offset),
                        kNames[h].set, JsonTime(facts.Set(h), offset));
  }
  json += fmt::format(
      R"(,"noon":{},"noon_elevation_deg":{:.6f},"day_length_s":{:.1f},"equation_of_time_s":{:.2f},)"
      R"("angular_radius_deg":{:.7f},"events":[)",
      JsonTime(facts.noon, offset), ToDegrees(facts.at_noon.elevation), horizon.seconds_above,
      facts.equation_of_time_s, ToDegrees(facts.at_noon.AngularRadius()));
  const char* separator = "";
  for (const Happening& happening : InOrder(facts.day)) {
    const sky::SunPosition sun = ComputeSunPosition(observer, happening.time, model);
    json +=
        fmt::format(R"({}{{"event":"{}","time":"{}","azimuth_deg":{:.4f},"elevation_deg":{:.4f}}})",
                    separator, happening.name, FormatLocal(happening.time, offset),
                    ToDegrees(sun.azimuth), ToDegrees(sun.elevation));
    separator = ",";
  }
  return json + "]}\n";
}

std::string DayText(const sky::Observer& observer, const DayFacts& facts, UtcOffset offset,
                    sky::SunModel model) {
  std::string text =
      fmt::format("{:<25}{}\n{:<25}{}\n", "day", FormatLocalDate(facts.day.begin, offset),
                  "utc_offset", ToString(offset));
  for (std::size_t h = sky::kSunHorizons; h-- > 0;) {
    const sky::HorizonPassages& passages = facts.day.passages[h];
    if (!passages.rises.empty() && !passages.sets.empty()) continue;
    const std::string why = WhyNone(PresenceIn(passages), h);
    if (passages.rises.empty()) text += fmt::format("{:<25}none{}\n", kNames[h].rise, why);
    if (passages.sets.empty()) text += fmt::format("{:<25}none{}\n", kNames[h].set, why);
  }
  if (facts.day.noons.empty()) text += fmt::format("{:<25}none on this day\n", "noon");
  for (const Happening& happening : InOrder(facts.day)) {
    const sky::SunPosition sun = ComputeSunPosition(observer, happening.time, model);
    text += fmt::format("{:<25}{}  azimuth {:8.4f}  elevation {:8.4f}\n", happening.name,
                        FormatLocal(happening.time, offset), RoundedAzimuth(sun),
                        ToDegrees(sun.elevation));
  }
  return text + fmt::format("{:<25}{}\n{:<25}{:.1f}\n{:<25}{:.5f}\n", "day_length",
                            Clock(facts.day.At(sky::SunHorizon::kSunrise).seconds_above),
                            "equation_of_time_s", facts.equation_of_time_s, "angular_radius_deg",
                            ToDegrees(facts.at_noon.AngularRadius()));
}

}  // namespace

Result<void> WriteSunMoment(const sky::Observer& observer, UtcTime time,
                            std::optional<UtcOffset> calendar, UtcOffset clock,
                            const SunDayOptions& options) {
  const sky::SunPosition sun = ComputeSunPosition(observer, time, options.model);
  const sky::SunEvents events =
      calendar ? ComputeSunEventsNear(observer, sky::MiddleOfDay(time, calendar->seconds()),
                                      options.model)
               : ComputeSunEvents(observer, time, options.model);
  const double equation_s =
      sky::EquationOfTimeSeconds(time, observer.ut1_minus_utc_s, options.model);
  const double radius_deg = ToDegrees(sun.AngularRadius());
  PLEINAIR_ASSIGN_OR_RETURN(files::ResultFile output, files::ResultFile::Open(options.output));
  std::ostream& out = output.stream();
  if (options.json) {
    out << '{' << SunPositionJson(time, observer, sun)
        << fmt::format(R"(,"angular_radius_deg":{:.7f},"equation_of_time_s":{:.2f},"sun":"{}")",
                       radius_deg, equation_s, Presence(events.Presence(sky::SunHorizon::kSunrise)))
        << ",\"noon\":" << JsonTime(events.noon, clock);
    for (std::size_t h = 0; h < sky::kSunHorizons; ++h) {
      out << fmt::format(R"(,"{}":{},"{}":{})", kNames[h].rise, JsonTime(events.dawns[h], clock),
                         kNames[h].set, JsonTime(events.dusks[h], clock));
    }
    out << "}\n";
    return output.Finish();
  }
  const auto or_none = [&](const std::optional<UtcTime>& t, std::size_t h) -> std::string {
    return t ? FormatLocal(*t, clock) : "none" + WhyNone(events.presences[h], h);
  };
  const auto line = [&](const char* name, const std::string& value) {
    out << fmt::format("{:<25}{}\n", name, value);
  };
  line("azimuth_deg", fmt::format("{:.6f}", ToDegrees(sun.azimuth)));
  line("elevation_deg", fmt::format("{:.6f}", ToDegrees(sun.elevation)));
  line("elevation_refracted_deg", fmt::format("{:.6f}", ToDegrees(sun.elevation_refracted)));
  line("distance_au", fmt::format("{:.8f}", sun.distance_au));
  line("sunrise", or_none(events.sunrise, 0));
  line("noon", FormatLocal(events.noon, clock));
  line("sunset", or_none(events.sunset, 0));
  for (std::size_t h = 1; h < sky::kSunHorizons; ++h) {
    line(kNames[h].rise, or_none(events.dawns[h], h));
    line(kNames[h].set, or_none(events.dusks[h], h));
  }
  line("angular_radius_deg", fmt::format("{:.6f}", radius_deg));
  line("equation_of_time_s", fmt::format("{:.1f}", equation_s));
  return output.Finish();
}

Result<void> WriteSunDay(const sky::Observer& observer, UtcTime midnight, UtcOffset offset,
                         const SunDayOptions& options) {
  const DayFacts facts = ComputeDay(observer, midnight, options.model);
  PLEINAIR_ASSIGN_OR_RETURN(files::ResultFile output, files::ResultFile::Open(options.output));
  output.stream() << (options.json ? DayJson(observer, facts, offset, options.model)
                                   : DayText(observer, facts, offset, options.model));
  return output.Finish();
}

Result<void> WriteSunAlmanac(const sky::Observer& observer, UtcTime midnight, UtcOffset offset,
                             int days, const SunDayOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(files::ResultFile output, files::ResultFile::Open(options.output));
  std::ostream& out = output.stream();
  if (!options.json) {
    out << "date,utc_offset,astronomical_dawn,nautical_dawn,civil_dawn,sunrise,noon,sunset,"
           "civil_dusk,nautical_dusk,astronomical_dusk,noon_elevation_deg,day_length_s,"
           "equation_of_time_s,sun\n";
  }
  ProgressBar bar("sun", days, "days");
  for (int i = 0; i < days && out; ++i, bar.Advance()) {
    const DayFacts facts =
        ComputeDay(observer, midnight.PlusSeconds(kDaySeconds * i), options.model);
    if (options.json) {
      out << DayJson(observer, facts, offset, options.model);
      continue;
    }
    const auto cell = [&](const std::optional<UtcTime>& time) {
      return time ? FormatLocal(*time, offset) : std::string();
    };
    out << FormatLocalDate(facts.day.begin, offset) << ',' << ToString(offset);
    for (std::size_t h = sky::kSunHorizons; h-- > 0;) out << ',' << cell(facts.Rise(h));
    out << ',' << cell(facts.noon);
    for (std::size_t h = 0; h < sky::kSunHorizons; ++h) out << ',' << cell(facts.Set(h));
    const sky::HorizonPassages& horizon = facts.day.At(sky::SunHorizon::kSunrise);
    out << fmt::format(",{:.4f},{:.1f},{:.2f},{}\n", ToDegrees(facts.at_noon.elevation),
                       horizon.seconds_above, facts.equation_of_time_s,
                       Presence(PresenceIn(horizon)));
  }
  return output.Finish();
}

}  // namespace pleinair::app
