#include "export/trajectories/place_pairs.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "export/trajectories/text_lines.h"

namespace pleinair::exports {

Result<std::vector<PlacePair>> ParsePlacePairs(std::string_view text, const std::string& name) {
  constexpr std::size_t kMaxPlaces = 10'000;
  constexpr double kMaxCoordinate = 1e6;
  std::vector<PlacePair> places;
  TextLines lines(text, name);
  while (lines.Next()) {
    if (lines.fields().size() != 6) {
      return InputError(lines.Where(),
                        fmt::format("has {} fields instead of 6", lines.fields().size()),
                        "write X Y Z in the trajectory's frame of reference, then x y z in the "
                        "marker's");
    }
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<double> n, lines.Numbers(0, 6));
    for (const double coordinate : n) {
      if (std::abs(coordinate) <= kMaxCoordinate) continue;
      return InputError(lines.Where(), "has a coordinate beyond 1e6", "correct the line");
    }
    if (places.size() == kMaxPlaces) {
      return InputError(lines.Where(), "is beyond the 10,000 places that a file may have",
                        "keep the best ones");
    }
    places.push_back({{{n[0], n[1], n[2]}}, {{n[3], n[4], n[5]}}});
  }
  if (places.size() < 3) {
    return InputError(name, fmt::format("holds {} places", places.size()),
                      "give three that do not lie on a line");
  }
  return places;
}

}  // namespace pleinair::exports
