#include "sky/gauss_rule.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace pleinair::sky {

GaussRule GaussOnUnitInterval(int count) {
  const auto size = static_cast<std::size_t>(count);
  GaussRule rule{std::vector<double>(size), std::vector<double>(size)};
  for (int i = 0; i < count; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 1.0;
    for (int iteration = 0; iteration < 50; ++iteration) {
      double p = 1.0, previous = 0.0;
      for (int n = 1; n <= count; ++n) {
        const double next = ((2.0 * n - 1.0) * x * p - (n - 1.0) * previous) / n;
        previous = p;
        p = next;
      }
      slope = count * (x * p - previous) / (x * x - 1.0);
      x -= p / slope;
    }
    const std::size_t at = size - 1 - static_cast<std::size_t>(i);
    rule.nodes[at] = 0.5 * (1.0 + x);
    rule.weights[at] = 1.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace pleinair::sky
