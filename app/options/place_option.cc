#include "app/options/place_option.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "files/csv.h"

namespace pleinair::app {

Result<devices::FilmTags::Place> ParsePlace(const std::string& text) {
  std::vector<std::optional<double>> numbers;
  std::string_view rest = text;
  for (bool more = true; more && numbers.size() < 4;) {
    const std::size_t comma = rest.find(',');
    more = comma != std::string_view::npos;
    std::string_view part = rest.substr(0, comma);
    while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
    numbers.push_back(files::ParseNumber(part));
    if (more) rest.remove_prefix(comma + 1);
  }
  const auto within = [&](std::size_t i, double most) {
    return numbers[i] && std::abs(*numbers[i]) <= most;
  };
  constexpr double kPole_deg = 90.0, kDateLine_deg = 180.0, kHighest_m = 10'000.0;
  const bool is_place = (numbers.size() == 2 || numbers.size() == 3) && within(0, kPole_deg) &&
                        within(1, kDateLine_deg) && (numbers.size() == 2 || within(2, kHighest_m));
  if (!is_place) {
    return InputError("--at", "\"" + text.substr(0, 60) + "\" is not a place",
                      "write latitude and longitude in degrees and, if known, metres above sea "
                      "level, for example 50.0875,14.4213,220");
  }
  devices::FilmTags::Place place{*numbers[0], *numbers[1], {}};
  if (numbers.size() == 3) place.height_m = numbers[2];
  return place;
}

}  // namespace pleinair::app
