#include "content/flow/files/cf_time.h"

#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

namespace pleinair::content {
namespace {

constexpr std::array<std::pair<const char*, double>, 17> kTimeUnits = {{
    {"second", 1.0},
    {"seconds", 1.0},
    {"sec", 1.0},
    {"secs", 1.0},
    {"s", 1.0},
    {"minute", 60.0},
    {"minutes", 60.0},
    {"min", 60.0},
    {"mins", 60.0},
    {"hour", 3600.0},
    {"hours", 3600.0},
    {"hr", 3600.0},
    {"hrs", 3600.0},
    {"h", 3600.0},
    {"day", 86400.0},
    {"days", 86400.0},
    {"d", 86400.0},
}};

}  // namespace

std::optional<CfTimeUnit> ParseCfTimeUnit(std::string_view text) {
  const std::string all(text.substr(0, 100));
  std::array<char, 32> word{};
  int at = 0;
  if (std::sscanf(all.c_str(), " %31[A-Za-z] since %n", word.data(), &at) != 1 || at == 0) {
    return std::nullopt;
  }
  std::string name;
  for (const char* c = word.data(); *c != '\0'; ++c) {
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(*c)));
  }
  CfTimeUnit unit;
  bool is_known = false;
  for (const auto& [known, seconds] : kTimeUnits) {
    if (name != known) continue;
    unit.seconds = seconds;
    is_known = true;
  }
  if (!is_known) return std::nullopt;
  int year = 0, month = 0, day = 0, read = 0;
  const char* date = all.c_str() + at;
  if (std::sscanf(date, "%d-%d-%d%n", &year, &month, &day, &read) != 3) return unit;
  int hour = 0, minute = 0, zone_hour = 0, zone_minute = 0;
  double second = 0.0;
  const char* clock = date + read;
  while (*clock == 'T' || *clock == 't' || *clock == ' ') ++clock;
  read = 0;
  std::sscanf(clock, "%2d:%2d%n", &hour, &minute, &read);
  const char* rest = clock + read;
  if (*rest == ':') {
    int more = 0;
    std::sscanf(rest, ":%lf%n", &second, &more);
    rest += more;
  }
  while (*rest == ' ') ++rest;
  if (*rest == '+' || *rest == '-') {
    const double sign = *rest == '-' ? -1.0 : 1.0;
    std::sscanf(rest + 1, "%2d:%2d", &zone_hour, &zone_minute);
    second -= sign * (3600.0 * zone_hour + 60.0 * zone_minute);
  }
  std::array<char, 64> plain{};
  std::snprintf(plain.data(), plain.size(), "%04d-%02d-%02dT%02d:%02d:00Z", year, month, day, hour,
                minute);
  const auto since = UtcTime::Parse(plain.data());
  if (since && std::isfinite(second)) unit.since = since->PlusSeconds(second);
  return unit;
}

}  // namespace pleinair::content
