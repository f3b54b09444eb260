#pragma once

#include <cstdint>

namespace pleinair::accuracy {

/// Inverse of the standard normal distribution function; 0 < p < 1, right to about 1e-16. Wichura
/// 1988, "Algorithm AS 241: the percentage points of the normal distribution", PPND16.
double NormalQuantile(double p);

/// Standard normal distribution function.
double NormalCdf(double z);

/// P(X <= x) of χ² with `degrees` of freedom: the regularised lower incomplete gamma function
/// P(degrees/2, x/2) by its series or its continued fraction (Abramowitz & Stegun 1964, 6.5.29 and
/// 6.5.31).
double ChiSquareCdf(double x, double degrees);

/// Inverse of ChiSquareCdf: bisection from the approximation of Wilson & Hilferty 1931.
double ChiSquareQuantile(double p, double degrees);

/// P(T <= t) of Student's t with `degrees` of freedom, by the incomplete beta function's continued
/// fraction (Abramowitz & Stegun 1964, 26.7.1 and 26.5.8).
double StudentCdf(double t, double degrees);

/// Inverse of StudentCdf, 0 < p < 1, by bisection.
double StudentQuantile(double p, double degrees);

/// P(X <= k) of `n` fair coins' heads.
double FairCoinCdf(std::int64_t k, std::int64_t n);

}  // namespace pleinair::accuracy
