#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace pleinair::app {

/// A city by name; degrees, north and east positive.
struct City {
  std::string_view name;
  double latitude_deg = 0.0, longitude_deg = 0.0;
};

/// Cities all over the world, by name.
std::span<const City> Cities();

/// Returns the cities whose name, or a word of it, begins with `text`. Case and accents do not
/// matter. An empty text matches all.
std::vector<City> FindCities(std::string_view text);

}  // namespace pleinair::app
