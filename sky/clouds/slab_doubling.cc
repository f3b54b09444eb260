#include "sky/clouds/slab_doubling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "sky/gauss_rule.h"

namespace pleinair::clouds {
namespace {

constexpr int kDirections = 24;
/// The first layer is thinner than this part of the smallest cosine: the error of the diamond
/// difference is cubic in it.
constexpr double kThinness = 0.02;

/// A square matrix, row-major.
class Square {
 public:
  explicit Square(std::size_t size) : size_(size), values_(size * size) {}
  static Square Identity(std::size_t size) {
    Square identity(size);
    for (std::size_t i = 0; i < size; ++i) identity(i, i) = 1.0;
    return identity;
  }

  double& operator()(std::size_t row, std::size_t column) { return values_[row * size_ + column]; }
  double operator()(std::size_t row, std::size_t column) const {
    return values_[row * size_ + column];
  }
  std::size_t size() const { return size_; }

  Square operator*(const Square& o) const {
    Square product(size_);
    for (std::size_t row = 0; row < size_; ++row) {
      for (std::size_t k = 0; k < size_; ++k) {
        const double factor = (*this)(row, k);
        if (factor == 0.0) continue;
        for (std::size_t column = 0; column < size_; ++column) {
          product(row, column) += factor * o(k, column);
        }
      }
    }
    return product;
  }
  Square Plus(const Square& o, double factor) const {
    Square sum = *this;
    for (std::size_t i = 0; i < values_.size(); ++i) sum.values_[i] += factor * o.values_[i];
    return sum;
  }

 private:
  std::size_t size_;
  std::vector<double> values_;
};

/// X with a X = b, by Gaussian elimination with pivots.
Square Solve(Square a, Square b) {
  const std::size_t n = a.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t row = k + 1; row < n; ++row) {
      if (std::fabs(a(row, k)) > std::fabs(a(pivot, k))) pivot = row;
    }
    for (std::size_t column = 0; pivot != k && column < n; ++column) {
      std::swap(a(k, column), a(pivot, column));
      std::swap(b(k, column), b(pivot, column));
    }
    for (std::size_t row = 0; row < n; ++row) {
      const double factor = a(row, k) / a(k, k);
      if (row == k || factor == 0.0) continue;
      for (std::size_t column = k; column < n; ++column) a(row, column) -= factor * a(k, column);
      for (std::size_t column = 0; column < n; ++column) b(row, column) -= factor * b(k, column);
    }
  }
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t column = 0; column < n; ++column) b(row, column) /= a(row, row);
  }
  return b;
}

/// Cosines of the quadrature, followed by those of the sun, whose weight is 0.
struct Streams {
  std::vector<double> cosines, weights;
};

Streams MakeStreams(const std::vector<double>& sun_cosines) {
  sky::GaussRule rule = sky::GaussOnUnitInterval(kDirections);
  Streams streams{std::move(rule.nodes), std::move(rule.weights)};
  streams.cosines.insert(streams.cosines.end(), sun_cosines.begin(), sun_cosines.end());
  streams.weights.resize(streams.cosines.size(), 0.0);
  return streams;
}

/// Legendre polynomials P_0…P_{terms−1} at x.
std::vector<double> Legendre(double x, int terms) {
  std::vector<double> p(static_cast<std::size_t>(terms), 1.0);
  if (terms > 1) p[1] = x;
  for (int l = 2; l < terms; ++l) {
    p[l] = ((2.0 * l - 1.0) * x * p[l - 1] - (l - 1.0) * p[l - 2]) / l;
  }
  return p;
}

/// Half the azimuthal mean of the phase function, times weights: rows are directions of leaving.
struct ScatteringShares {
  Square forward, backward;  ///< To the same hemisphere, and to the other.
};

/// `moments`: Legendre moments χ_l of the phase function.
ScatteringShares MakeShares(const Streams& streams, const std::vector<double>& moments) {
  const std::size_t n = streams.cosines.size();
  const int terms = static_cast<int>(moments.size());
  std::vector<std::vector<double>> legendre;
  legendre.reserve(n);
  for (const double cosine : streams.cosines) legendre.push_back(Legendre(cosine, terms));
  ScatteringShares shares{Square(n), Square(n)};
  for (std::size_t to = 0; to < n; ++to) {
    for (std::size_t from = 0; from < n; ++from) {
      double same = 0.0, opposite = 0.0;
      for (int l = 0; l < terms; ++l) {
        const double term = (2.0 * l + 1.0) * moments[l] * legendre[to][l] * legendre[from][l];
        same += term;
        opposite += l % 2 == 0 ? term : -term;
      }
      shares.forward(to, from) = 0.5 * same * streams.weights[from];
      shares.backward(to, from) = 0.5 * opposite * streams.weights[from];
    }
  }
  return shares;
}

struct Layer {
  Square reflection, transmission;  ///< Radiance out = matrix × radiance in.
};

/// Diamond difference: radiance inside is the mean of both faces'.
Layer ThinLayer(const Streams& streams, const ScatteringShares& shares, double albedo,
                double depth) {
  const std::size_t n = streams.cosines.size();
  const Square one = Square::Identity(n);
  Square a(n), b(n);
  for (std::size_t row = 0; row < n; ++row) {
    const double half = 0.5 * depth / streams.cosines[row];
    for (std::size_t column = 0; column < n; ++column) {
      a(row, column) = half * ((row == column ? 1.0 : 0.0) - albedo * shares.forward(row, column));
      b(row, column) = half * albedo * shares.backward(row, column);
    }
  }
  const Square inverse = Solve(one.Plus(a, 1.0), one);  // (1 + A)⁻¹
  const Square g = Solve(one.Plus(a, 1.0).Plus(b * inverse * b, -1.0), one);
  const Square once = g * b * inverse;
  return {once.Plus(once, 1.0), g.Plus(g, 1.0).Plus(one, -1.0)};
}

Layer Doubled(const Layer& half) {
  const Square one = Square::Identity(half.reflection.size());
  // What leaves the middle downwards, after all reflections between the two halves.
  const Square down = Solve(one.Plus(half.reflection * half.reflection, -1.0), half.transmission);
  return {half.reflection.Plus(half.transmission * (half.reflection * down), 1.0),
          half.transmission * down};
}

/// Reflectances and transmittances by flux. Light from the sun's directions has no weight in the
/// quadrature; reciprocity gives them from isotropic light: R(μ₀) is the radiance that leaves along
/// μ₀ when unit radiance arrives from everywhere.
SlabFluxes FluxesOf(const Layer& layer, const Streams& streams) {
  const std::size_t n = streams.cosines.size();
  SlabFluxes fluxes;
  fluxes.direct.reserve(n - kDirections);
  double incident = 0.0;
  for (std::size_t to = 0; to < n; ++to) {
    SlabFluxes::Direct direct;
    for (std::size_t from = 0; from < kDirections; ++from) {
      direct.reflected += layer.reflection(to, from);
      direct.transmitted += layer.transmission(to, from);
    }
    // The unscattered light of a direction without weight stands on the diagonal.
    if (to >= kDirections) {
      direct.transmitted += layer.transmission(to, to);
      fluxes.direct.push_back(direct);
    }
    const double projected = streams.weights[to] * streams.cosines[to];
    incident += projected;
    fluxes.diffuse_reflected += projected * direct.reflected;
    fluxes.diffuse_transmitted += projected * direct.transmitted;
  }
  fluxes.diffuse_reflected /= incident;
  fluxes.diffuse_transmitted /= incident;
  return fluxes;
}

}  // namespace

std::vector<SlabFluxes> DoubleSlab(const SlabMedium& medium, double first_depth, int count,
                                   const std::vector<double>& sun_cosines) {
  const Streams streams = MakeStreams(sun_cosines);
  // Wiscombe 1977, Eqs. (8), (11) and (12): the peak f = g^2N of the phase function counts as light
  // that was not scattered.
  constexpr int kTerms = 2 * kDirections;
  const double peak = std::pow(medium.asymmetry, kTerms);
  const double albedo = medium.single_scattering_albedo;
  const double depth_scale = 1.0 - albedo * peak;
  const double scaled_albedo = albedo * (1.0 - peak) / depth_scale;
  std::vector<double> moments(kTerms);
  double power = 1.0;
  for (double& moment : moments) {
    moment = (power - peak) / (1.0 - peak);
    power *= medium.asymmetry;
  }
  const ScatteringShares shares = MakeShares(streams, moments);
  const double least = *std::min_element(streams.cosines.begin(), streams.cosines.end());
  double depth = first_depth * depth_scale;
  int halvings = 0;
  while (depth > kThinness * least) {
    depth *= 0.5;
    ++halvings;
  }
  Layer layer = ThinLayer(streams, shares, scaled_albedo, depth);
  for (int i = 0; i < halvings; ++i) layer = Doubled(layer);
  std::vector<SlabFluxes> slabs;
  slabs.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    if (k > 0) layer = Doubled(layer);
    slabs.push_back(FluxesOf(layer, streams));
  }
  return slabs;
}

}  // namespace pleinair::clouds
