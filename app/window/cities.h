#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace pleinair::app {

/// A place that people know by name; degrees, north and east positive.
struct City {
  std::string_view name;
  double latitude_deg = 0.0, longitude_deg = 0.0;
};

/// Some cities all over the world, by name.
std::span<const City> Cities();

/// Those whose name, or a word of it, begins with `text`; case and accents do not matter. All for
/// an empty text.
std::vector<City> FindCities(std::string_view text);

}  // namespace pleinair::app
