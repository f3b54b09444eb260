#include "scene/time_zone.h"

#include <exception>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include <date/tz.h>

#include "scene/near_names.h"

namespace pleinair::scene {
namespace {

constexpr const char* kFolder = "/usr/share/zoneinfo";
constexpr const char* kOffsetInstead = "give the time's offset from UTC, for example +02:00";

tl::unexpected<Error> NoDatabase() {
  return SystemError(kFolder, "the machine has no time-zone database",
                     std::string("install the package tzdata, or ") + kOffsetInstead);
}

tl::unexpected<Error> Unreadable(const std::string& name) {
  return SystemError(kFolder + ("/" + name), "is no readable time zone",
                     std::string("reinstall the package tzdata, or ") + kOffsetInstead);
}

/// The names of all zones; empty without a database.
std::vector<std::string> ZoneNames() {
  std::vector<std::string> names;
  try {
    for (const date::time_zone& zone : date::get_tzdb().zones) names.push_back(zone.name());
  } catch (const std::exception&) {
    names.clear();  // The folder does not exist.
  }
  return names;
}

/// Content of a zone's file (RFC 8536); empty if it cannot be read.
std::string ZoneFile(const std::string& name) {
  std::ifstream file(kFolder + ("/" + name), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Whether the rule at the end of a zone's file (RFC 8536, section 3.3) has daylight-saving time,
/// as in "CET-1CEST,M3.5.0,M10.5.0/3". The date library ignores that rule.
bool EndsWithYearlyChange(std::string_view zone_file) {
  if (zone_file.size() < 2 || zone_file.back() != '\n') return false;
  const std::size_t line = zone_file.rfind('\n', zone_file.size() - 2);
  return line != std::string_view::npos && zone_file.find(',', line) != std::string_view::npos;
}

/// Whether `info` belongs to the last entry of a zone's file.
bool IsLast(const date::sys_info& info) {
  return info.end - date::sys_seconds{} > std::chrono::hours(24 * 366 * 1000);
}

/// Queries the date library and catches its exceptions; nullopt if the zone's file cannot be read.
template <typename Time>
auto InfoOf(const std::string& name, Time time)
    -> std::optional<decltype(date::locate_zone(name)->get_info(time))> {
  try {
    return date::locate_zone(name)->get_info(time);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

tl::unexpected<Error> AfterTheDatabase(const std::string& name) {
  return InputError("", "lies after the clock changes that the machine knows of " + name,
                    kOffsetInstead);
}

}  // namespace

Result<TimeZone> TimeZone::Find(std::string_view name) {
  const std::vector<std::string> names = ZoneNames();
  if (names.empty()) return NoDatabase();
  for (const std::string& known : names) {
    if (known != name) continue;
    const std::string file = ZoneFile(known);
    // The date library aborts on a file without this magic number.
    if (!file.starts_with("TZif")) return Unreadable(known);
    return TimeZone(known, EndsWithYearlyChange(file));
  }
  std::string near;
  for (const std::string& candidate : NearNames(name, names)) {
    near += (near.empty() ? "" : " or ") + candidate;
  }
  return InputError("", "names the unknown zone \"" + std::string(name) + "\"",
                    near.empty() ? "name a zone of the IANA database, for example Europe/Prague"
                                 : "did you mean " + near + "?");
}

Result<std::chrono::seconds> TimeZone::OffsetAt(UtcTime time) const {
  const date::sys_time<std::chrono::nanoseconds> moment{
      std::chrono::nanoseconds(time.nanoseconds_since_1970())};
  const std::optional<date::sys_info> info = InfoOf(name_, moment);
  if (!info) return Unreadable(name_);
  if (keeps_changing_ && IsLast(*info)) return AfterTheDatabase(name_);
  return info->offset;
}

Result<LocalOffsets> TimeZone::OffsetsOfReading(UtcTime reading) const {
  const date::local_time<std::chrono::nanoseconds> local{
      std::chrono::nanoseconds(reading.nanoseconds_since_1970())};
  const std::optional<date::local_info> info = InfoOf(name_, local);
  if (!info) return Unreadable(name_);
  using Kind = LocalOffsets::Kind;
  if (info->result == date::local_info::nonexistent) {
    return LocalOffsets{Kind::kNever, info->first.offset, info->second.offset};
  }
  if (info->result == date::local_info::ambiguous) {
    return LocalOffsets{Kind::kTwice, info->first.offset, info->second.offset};
  }
  if (keeps_changing_ && IsLast(info->first)) return AfterTheDatabase(name_);
  return LocalOffsets{Kind::kOnce, info->first.offset, info->first.offset};
}

}  // namespace pleinair::scene
