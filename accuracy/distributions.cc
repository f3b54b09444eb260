#include "accuracy/distributions.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pleinair::accuracy {
namespace {

/// Polynomial with its constant term first.
template <std::size_t kCount>
double Polynomial(const std::array<double, kCount>& coefficients, double x) {
  double value = 0.0;
  for (std::size_t i = kCount; i-- > 0;) value = value * x + coefficients[i];
  return value;
}

// Wichura 1988, PPND16.
constexpr std::array<double, 8> kA{3.3871328727963666080e0,  1.3314166789178437745e+2,
                                   1.9715909503065514427e+3, 1.3731693765509461125e+4,
                                   4.5921953931549871457e+4, 6.7265770927008700853e+4,
                                   3.3430575583588128105e+4, 2.5090809287301226727e+3};
constexpr std::array<double, 8> kB{1.0,
                                   4.2313330701600911252e+1,
                                   6.8718700749205790830e+2,
                                   5.3941960214247511077e+3,
                                   2.1213794301586595867e+4,
                                   3.9307895800092710610e+4,
                                   2.8729085735721942674e+4,
                                   5.2264952788528545610e+3};
constexpr std::array<double, 8> kC{1.42343711074968357734e0,  4.63033784615654529590e0,
                                   5.76949722146069140550e0,  3.64784832476320460504e0,
                                   1.27045825245236838258e0,  2.41780725177450611770e-1,
                                   2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr std::array<double, 8> kD{1.0,
                                   2.05319162663775882187e0,
                                   1.67638483018380384940e0,
                                   6.89767334985100004550e-1,
                                   1.48103976427480074590e-1,
                                   1.51986665636164571966e-2,
                                   5.47593808499534494600e-4,
                                   1.05075007164441684324e-9};
constexpr std::array<double, 8> kE{6.65790464350110377720e0,  5.46378491116411436990e0,
                                   1.78482653991729133580e0,  2.96560571828504891230e-1,
                                   2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                   2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr std::array<double, 8> kF{1.0,
                                   5.99832206555887937690e-1,
                                   1.36929880922735805310e-1,
                                   1.48753612908506148525e-2,
                                   7.86869131145613259100e-4,
                                   1.84631831751005468180e-5,
                                   1.42151175831644588870e-7,
                                   2.04426310338993978564e-15};

// Of continued fractions and series.
constexpr int kMaxTerms = 100000;
constexpr double kDone = 1e-16, kTiny = 1e-300;

/// Regularised lower incomplete gamma function P(a, x).
double LowerGamma(double a, double x) {
  const double log_front = a * std::log(x) - x - std::lgamma(a);
  if (x < a + 1.0) {  // A&S 6.5.29.
    double term = 1.0 / a, sum = term;
    for (int i = 1; i < kMaxTerms && term > sum * kDone; ++i) {
      term *= x / (a + i);
      sum += term;
    }
    return std::exp(log_front) * sum;
  }
  // A&S 6.5.31, evaluated forwards after Lentz.
  double b = x + 1.0 - a, c = 1.0 / kTiny, d = 1.0 / b, fraction = d;
  for (int i = 1; i < kMaxTerms; ++i) {
    const double an = -i * (i - a);
    b += 2.0;
    d = an * d + b;
    if (std::fabs(d) < kTiny) d = kTiny;
    c = b + an / c;
    if (std::fabs(c) < kTiny) c = kTiny;
    d = 1.0 / d;
    fraction *= d * c;
    if (std::fabs(d * c - 1.0) < kDone) break;
  }
  return 1.0 - std::exp(log_front) * fraction;
}

/// The regularised incomplete beta function I_x(a, b), for x below (a + 1) / (a + b + 2): A&S
/// 26.5.8, evaluated forwards after Lentz.
double LowerBeta(double x, double a, double b) {
  if (x <= 0.0) return 0.0;
  const double log_front = std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) +
                           b * std::log1p(-x) - std::log(a);
  double c = 1.0 / kTiny, d = 1.0, fraction = 1.0;
  for (int i = 1; i < kMaxTerms; ++i) {
    const int m = i / 2;
    const double term = i % 2 == 0 ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                                   : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1.0 + term * d;
    d = 1.0 / (std::fabs(d) < kTiny ? kTiny : d);
    c = 1.0 + term / c;
    if (std::fabs(c) < kTiny) c = kTiny;
    fraction *= c * d;
    if (std::fabs(c * d - 1.0) < kDone) break;
  }
  return std::exp(log_front) * fraction;
}

}  // namespace

double NormalQuantile(double p) {
  const double q = p - 0.5;
  if (std::fabs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * Polynomial(kA, r) / Polynomial(kB, r);
  }
  const double r = std::sqrt(-std::log(q < 0.0 ? p : 1.0 - p));
  const double z = r <= 5.0 ? Polynomial(kC, r - 1.6) / Polynomial(kD, r - 1.6)
                            : Polynomial(kE, r - 5.0) / Polynomial(kF, r - 5.0);
  return q < 0.0 ? -z : z;
}

double NormalCdf(double z) { return 0.5 * std::erfc(-z * std::sqrt(0.5)); }

double ChiSquareCdf(double x, double degrees) {
  return x <= 0.0 ? 0.0 : LowerGamma(0.5 * degrees, 0.5 * x);
}

double ChiSquareQuantile(double p, double degrees) {
  // Wilson & Hilferty 1931: the cube root of χ²/degrees is about normal.
  const double spread = 2.0 / (9.0 * degrees);
  const double guess =
      degrees * std::pow(std::max(1e-3, 1.0 - spread + NormalQuantile(p) * std::sqrt(spread)), 3);
  double low = 0.5 * guess, high = 2.0 * guess;
  while (low > 0.0 && ChiSquareCdf(low, degrees) > p) low *= 0.5;
  while (ChiSquareCdf(high, degrees) < p) high *= 2.0;
  for (int i = 0; i < 200 && high - low > 1e-14 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (ChiSquareCdf(middle, degrees) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double StudentCdf(double t, double degrees) {
  // A&S 26.7.1: both tails together are I_x(ν/2, 1/2) with x = ν / (ν + t²).
  const double x = degrees / (degrees + t * t), a = 0.5 * degrees, b = 0.5;
  const double both =
      x < (a + 1.0) / (a + b + 2.0) ? LowerBeta(x, a, b) : 1.0 - LowerBeta(1.0 - x, b, a);
  return t > 0.0 ? 1.0 - 0.5 * both : 0.5 * both;
}

double StudentQuantile(double p, double degrees) {
  if (p < 0.5) return -StudentQuantile(1.0 - p, degrees);
  double low = 0.0, high = 1.0;
  while (StudentCdf(high, degrees) < p) high *= 2.0;
  for (int i = 0; i < 200 && high - low > 1e-14 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (StudentCdf(middle, degrees) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double FairCoinCdf(std::int64_t k, std::int64_t n) {
  double sum = 0.0;
  const double count = static_cast<double>(n);
  for (std::int64_t i = 0; i <= std::min(k, n); ++i) {
    const double heads = static_cast<double>(i);
    sum += std::exp(std::lgamma(count + 1.0) - std::lgamma(heads + 1.0) -
                    std::lgamma(count - heads + 1.0) - count * std::log(2.0));
  }
  return std::min(sum, 1.0);
}

}  // namespace pleinair::accuracy
