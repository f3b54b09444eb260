#include "accuracy/distributions.h"

#include <algorithm>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace pleinair::accuracy {
namespace {

namespace math = boost::math;
namespace policies = boost::math::policies;

/// No exceptions; results do not depend on a machine's long double.
using Policy = policies::policy<
    policies::promote_double<false>, policies::domain_error<policies::ignore_error>,
    policies::pole_error<policies::ignore_error>, policies::overflow_error<policies::ignore_error>,
    policies::evaluation_error<policies::ignore_error>>;
using Normal = math::normal_distribution<double, Policy>;
using ChiSquare = math::chi_squared_distribution<double, Policy>;
using Student = math::students_t_distribution<double, Policy>;
using Binomial = math::binomial_distribution<double, Policy>;

}  // namespace

double NormalCdf(double z) { return math::cdf(Normal(), z); }

double ChiSquareCdf(double x, double degrees) { return math::cdf(ChiSquare(degrees), x); }

double ChiSquareQuantile(double p, double degrees) { return math::quantile(ChiSquare(degrees), p); }

double StudentCdf(double t, double degrees) { return math::cdf(Student(degrees), t); }

double StudentQuantile(double p, double degrees) { return math::quantile(Student(degrees), p); }

double FairCoinCdf(std::int64_t k, std::int64_t n) {
  const double heads = static_cast<double>(std::min(k, n));
  return math::cdf(Binomial(static_cast<double>(n), 0.5), heads);
}

}  // namespace pleinair::accuracy
