#pragma once

#include <cstdint>

namespace pleinair::accuracy {

// By Boost.Math, in double precision; not a number outside a distribution's range.

/// Standard normal distribution function.
double NormalCdf(double z);

/// P(X <= x) of χ² with `degrees` > 0 of freedom.
double ChiSquareCdf(double x, double degrees);

/// Inverse of ChiSquareCdf, 0 < p < 1.
double ChiSquareQuantile(double p, double degrees);

/// P(T <= t) of Student's t with `degrees` > 0 of freedom.
double StudentCdf(double t, double degrees);

/// Inverse of StudentCdf, 0 < p < 1.
double StudentQuantile(double p, double degrees);

/// P(X <= k) for the number X of heads of `n` fair coins.
double FairCoinCdf(std::int64_t k, std::int64_t n);

}  // namespace pleinair::accuracy
