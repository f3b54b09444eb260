#pragma once

#include <vector>

namespace pleinair::sky {

/// Nodes and weights of Gauss–Legendre quadrature on [0, 1], nodes ascending.
struct GaussRule {
  std::vector<double> nodes, weights;
};

/// The rule with `count` nodes, by Newton's method for the roots of the Legendre polynomial. Exact
/// for polynomials up to the degree 2 · count − 1.
GaussRule GaussOnUnitInterval(int count);

}  // namespace pleinair::sky
