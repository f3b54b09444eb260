#include "compositor/photometry/estimate/shade_field.h"

#include <cmath>

#include "compositor/light/sampling.h"

namespace pleinair::compositor {
namespace {

// Distance across the sun's rays within which unmodelled shade is about the same, in metres: half
// the width of a small crown.
constexpr double kReach = 0.5;
constexpr double kFarthest = 3 * kReach;

}  // namespace

ShadeField::ShadeField(const std::vector<LightCell>& cells, Vec3 to_sun) {
  const TangentFrame across(to_sun);
  std::vector<std::pair<double, double>> places;
  places.reserve(cells.size() + 1);
  for (const LightCell& cell : cells) {
    const Vec3 place = (cell.sunny ? *cell.sunny : *cell.shaded).place.xyz;
    places.emplace_back(Dot(place, across.tangent), Dot(place, across.bitangent));
  }
  places.emplace_back(0.0, 0.0);
  neighbours_.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < cells.size(); ++j) {
      if (i == j || !cells[j].sunny) continue;
      const double distance =
          std::hypot(places[i].first - places[j].first, places[i].second - places[j].second);
      if (distance > kFarthest) continue;
      const double z = distance / kReach;
      neighbours_[i].emplace_back(static_cast<std::uint32_t>(j), std::exp(-0.5 * z * z));
    }
  }
}

std::vector<double> ShadeField::Prior(std::span<const double> posterior, std::size_t mixes) const {
  std::vector<double> prior(neighbours_.size() * mixes, 1.0 / static_cast<double>(mixes));
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    double* const row = &prior[i * mixes];
    double sum = 1.0;
    for (const auto& [j, weight] : neighbours_[i]) {
      for (std::size_t m = 0; m < mixes; ++m) row[m] += weight * posterior[j * mixes + m];
      sum += weight;
    }
    for (std::size_t m = 0; m < mixes; ++m) row[m] /= sum;
  }
  return prior;
}

}  // namespace pleinair::compositor
