#include "compositor/photometry/response/response_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "base/quantile.h"
#include "base/srgb.h"
#include "compositor/photometry/student_distribution.h"

namespace pleinair::compositor {
namespace {

using Surface = ResponseChart::Surface;

// Prior of δ: knots, standard deviation (logarithm of light), correlation length (pixel value over
// 255).
constexpr int kKnots = 9;
constexpr double kCurveSpread = 0.35, kCurveLength = 0.35;
// Sky's strength beside the model's: common standard deviation, and a channel's.
constexpr double kSkySpread = 0.5, kSkyColorSpread = 0.25;
// Scale of the errors of described albedos (Student's distribution), of their channels, and of the
// marker's black, whose print and glare vary.
constexpr double kAlbedoSpread = 0.1, kAlbedoFreedom = 4.0, kAlbedoColorSpread = 0.05;
constexpr double kBlackSpread = 0.15;
// Error of the modelled light on surfaces that lie otherwise than the marker: in the sun, in shade,
// and a channel's part of it.
constexpr double kSunlitSpread = 0.1, kShadedSpread = 0.25, kColorPart = 0.5;
// Glare of the lens and raised blacks, linear: median, and standard deviation of the logarithm.
constexpr double kGlare = 0.002, kGlareSpread = 1.0;
// Degrees of freedom of the residuals' distribution.
constexpr double kFreedom = 4.0;
constexpr int kRounds = 25;
constexpr double kLargestStep = 0.5;
// Precision of what is fixed, and of what is free.
constexpr double kFixed = 1e8, kFree = 1e-6;
// Bayes factor from which on the evidence is strong: 10 (Kass & Raftery 1995).
const double kStrong = std::log(10.0);
constexpr std::size_t kMinFields = 3;
constexpr int kSamples = 65;

/// The two knots about a pixel value (0…1), and the weight of the second.
struct Between {
  int knot;
  double weight;
};

Between KnotsAbout(double code) {
  const double at = std::clamp(code, 0.0, 1.0) * (kKnots - 1);
  const int knot = std::min(static_cast<int>(at), kKnots - 2);
  return {knot, at - knot};
}

Eigen::MatrixXd CurveCovariance() {
  Eigen::MatrixXd covariance(kKnots, kKnots);
  for (int i = 0; i < kKnots; ++i) {
    for (int j = 0; j < kKnots; ++j) {
      const double apart = (i - j) / (kKnots - 1.0) / kCurveLength;
      covariance(i, j) = kCurveSpread * kCurveSpread * std::exp(-0.5 * apart * apart);
    }
    covariance(i, i) += 1e-4;
  }
  return covariance;
}

/// Precision of three channels with a common and an own standard deviation.
Eigen::Matrix3d ChannelPrecision(double common, double own) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Constant(common * common);
  covariance.diagonal().array() += own * own;
  return covariance.inverse();
}

/// Inverse variance of a value in iteratively reweighted least squares.
double StudentPrecision(double value, double scale, double freedom) {
  return StudentWeight(value, scale, freedom) / (scale * scale);
}

/// One hypothesis: with a free curve or sRGB, with a sun or without.
class ChartFit {
 public:
  ChartFit(const ResponseChart& chart, bool free_curve, bool sun)
      : chart_(chart), free_curve_(free_curve), sun_(sun) {
    exposure_ = kKnots;
    sky_ = exposure_ + 3 * static_cast<int>(chart.frames);
    albedo_ = sky_ + 3;
    albedo_color_ = albedo_ + static_cast<int>(chart.surfaces.size());
    group_ = albedo_color_ + 3 * static_cast<int>(chart.surfaces.size());
    glare_ = group_ + 3 * static_cast<int>(chart.level.size());
    x_ = Eigen::VectorXd::Zero(glare_ + 1);
    curve_precision_ = CurveCovariance().inverse();
    StartExposures();
    for (int i = 0; i < kRounds; ++i) Round();
  }

  /// Negative logarithm of the evidence, up to a constant that all hypotheses share.
  double Cost() const {
    double cost = 0.0;
    for (const ChartField& field : chart_.fields) {
      for (int c = 0; c < 3; ++c)
        cost += Share() * StudentCost(RowOf(field, c).residual, field.error, kFreedom);
    }
    for (std::size_t s = 0; s < chart_.surfaces.size(); ++s) {
      if (chart_.surfaces[s] == Surface::kPhantom) {
        cost += StudentCost(x_[albedo_ + static_cast<int>(s)], kAlbedoSpread, kAlbedoFreedom);
      }
    }
    Eigen::MatrixXd prior = Prior();
    for (std::size_t s = 0; s < chart_.surfaces.size(); ++s) {
      const int i = albedo_ + static_cast<int>(s);
      if (chart_.surfaces[s] == Surface::kPhantom) prior(i, i) = 0.0;
    }
    cost += 0.5 * x_.dot(prior * x_);
    if (!free_curve_) return cost;
    // What the curve's freedom costs: the prior's volume over the posterior's.
    return cost + 0.5 * (std::log(CurveCovariance().determinant()) -
                         std::log(CurveOf(covariance_).determinant()));
  }

  /// Light that the scene sends to a pixel of this value (0…1), without glare.
  double Light(double code) const {
    const auto [knot, weight] = KnotsAbout(code);
    const double curve = (1.0 - weight) * x_[knot] + weight * x_[knot + 1];
    return LinearFromSrgb(code) * std::exp(curve) - Glare();
  }

  /// Standard deviation of δ beside that at the brightest white, mean over the fields.
  double Error() const {
    double white = 0.0;
    for (const ChartField& field : chart_.fields) {
      if (chart_.surfaces[field.surface] != Surface::kWhite) continue;
      white = std::max(white, SrgbFromLinear(std::exp(field.log_linear[1])));
    }
    double sum = 0.0;
    for (const ChartField& field : chart_.fields) {
      Eigen::VectorXd beside = Eigen::VectorXd::Zero(x_.size());
      const auto add = [&](double code, double sign) {
        const auto [knot, weight] = KnotsAbout(code);
        beside[knot] += sign * (1.0 - weight);
        beside[knot + 1] += sign * weight;
        beside[glare_] -= sign * Glare() / std::max(Light(code), Glare());
      };
      add(SrgbFromLinear(std::exp(field.log_linear[1])), 1.0);
      add(white, -1.0);
      sum += std::sqrt(std::max(0.0, beside.dot(covariance_ * beside)));
    }
    // The channels err alike: three tell as much of the light as one.
    return std::numbers::sqrt3 * sum / static_cast<double>(chart_.fields.size());
  }

 private:
  /// A residual and its derivatives.
  struct Row {
    double residual = 0.0;
    std::array<int, 8> index{};
    std::array<double, 8> slope{};
  };

  static Eigen::MatrixXd CurveOf(const Eigen::MatrixXd& covariance) {
    return covariance.topLeftCorner(kKnots, kKnots);
  }

  /// Frames show the same surfaces and patterns: together they tell as much as one.
  double Share() const { return 1.0 / static_cast<double>(chart_.frames); }
  double Glare() const { return kGlare * std::exp(x_[glare_]); }

  Row RowOf(const ChartField& field, int c) const {
    const std::array of_sun{field.of_sun.r, field.of_sun.g, field.of_sun.b};
    const std::array of_sky{field.of_sky.r, field.of_sky.g, field.of_sky.b};
    const std::array albedo{field.albedo.r, field.albedo.g, field.albedo.b};
    const double sun = sun_ ? of_sun[c] : 0.0, sky = of_sky[c] * std::exp(x_[sky_ + c]);
    const auto [knot, weight] = KnotsAbout(SrgbFromLinear(std::exp(field.log_linear[c])));
    const int s = static_cast<int>(field.surface);
    Row row;
    row.index = {knot,
                 knot + 1,
                 exposure_ + 3 * static_cast<int>(field.frame) + c,
                 sky_ + c,
                 albedo_ + s,
                 albedo_color_ + 3 * s + c,
                 group_ + 3 * static_cast<int>(field.group) + c,
                 glare_};
    double log_light = std::log(albedo[c] * (sun + sky));
    for (const int k : {2, 4, 5, 6}) log_light += x_[row.index[k]];
    const double light = std::exp(log_light), share = light / (light + Glare());
    row.slope = {1.0 - weight, weight, -share, -share * sky / (sun + sky),
                 -share,       -share, -share, share - 1.0};
    const double curve = (1.0 - weight) * x_[knot] + weight * x_[knot + 1];
    row.residual = field.log_linear[c] + curve - std::log(light + Glare());
    return row;
  }

  /// The exposures that make the marker's white right, by its part in the sun if some of it is;
  /// those that make most fields right in frames that show no white.
  void StartExposures() {
    const auto count = static_cast<std::size_t>(sky_ - exposure_);
    std::vector<std::vector<double>> all(count), white(count), sunlit_white(count);
    for (const ChartField& field : chart_.fields) {
      const bool is_white = chart_.surfaces[field.surface] == Surface::kWhite;
      for (int c = 0; c < 3; ++c) {
        const Row row = RowOf(field, c);
        const auto i = static_cast<std::size_t>(row.index[2] - exposure_);
        const double wanted = row.residual + x_[row.index[2]];
        all[i].push_back(wanted);
        if (is_white) white[i].push_back(wanted);
        if (is_white && field.sunlit) sunlit_white[i].push_back(wanted);
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto& best = !sunlit_white[i].empty() ? sunlit_white[i]
                         : !white[i].empty()      ? white[i]
                                                  : all[i];
      if (!best.empty()) x_[exposure_ + static_cast<int>(i)] = Median(best);
    }
  }

  Eigen::MatrixXd Prior() const {
    Eigen::MatrixXd prior = Eigen::MatrixXd::Zero(x_.size(), x_.size());
    if (free_curve_) {
      prior.topLeftCorner(kKnots, kKnots) = curve_precision_;
    } else {
      prior.topLeftCorner(kKnots, kKnots).diagonal().setConstant(kFixed);
    }
    for (int i = exposure_; i < sky_; ++i) prior(i, i) = kFree;
    prior(glare_, glare_) = 1.0 / (kGlareSpread * kGlareSpread);
    prior.block<3, 3>(sky_, sky_) = ChannelPrecision(kSkySpread, kSkyColorSpread);
    for (std::size_t s = 0; s < chart_.surfaces.size(); ++s) {
      const int i = albedo_ + static_cast<int>(s), color = albedo_color_ + 3 * static_cast<int>(s);
      double precision = 1.0 / (kBlackSpread * kBlackSpread);
      if (chart_.surfaces[s] == Surface::kWhite) precision = kFixed;
      if (chart_.surfaces[s] == Surface::kPhantom) {
        precision = StudentPrecision(x_[i], kAlbedoSpread, kAlbedoFreedom);
      }
      prior(i, i) = precision;
      for (int c = 0; c < 3; ++c) {
        prior(color + c, color + c) = chart_.surfaces[s] == Surface::kWhite
                                          ? kFixed
                                          : 1.0 / (kAlbedoColorSpread * kAlbedoColorSpread);
      }
    }
    std::vector<bool> sunlit(chart_.level.size());
    for (const ChartField& field : chart_.fields) sunlit[field.group] = field.sunlit;
    for (std::size_t g = 0; g < chart_.level.size(); ++g) {
      const int i = group_ + 3 * static_cast<int>(g);
      const double spread = sunlit[g] ? kSunlitSpread : kShadedSpread;
      prior.block<3, 3>(i, i) = chart_.level[g]
                                    ? Eigen::Matrix3d(Eigen::Matrix3d::Identity() * kFixed)
                                    : ChannelPrecision(spread, kColorPart * spread);
    }
    return prior;
  }

  /// One Gauss-Newton step with reweighted residuals.
  void Round() {
    const Eigen::MatrixXd prior = Prior();
    Eigen::MatrixXd matrix = prior;
    Eigen::VectorXd right = -(prior * x_);
    for (const ChartField& field : chart_.fields) {
      for (int c = 0; c < 3; ++c) {
        const Row row = RowOf(field, c);
        const double weight = Share() * StudentPrecision(row.residual, field.error, kFreedom);
        for (std::size_t i = 0; i < row.index.size(); ++i) {
          right[row.index[i]] -= weight * row.slope[i] * row.residual;
          for (std::size_t j = 0; j < row.index.size(); ++j) {
            matrix(row.index[i], row.index[j]) += weight * row.slope[i] * row.slope[j];
          }
        }
      }
    }
    const Eigen::LDLT<Eigen::MatrixXd> factors(matrix);
    const Eigen::VectorXd step = factors.solve(right);
    const double largest = step.lpNorm<Eigen::Infinity>();
    x_ += step * std::min(1.0, kLargestStep / std::max(largest, kFree));
    covariance_ = factors.solve(Eigen::MatrixXd::Identity(x_.size(), x_.size()));
  }

  const ResponseChart& chart_;
  bool free_curve_, sun_;
  // First unknown of each kind.
  int exposure_ = 0, sky_ = 0, albedo_ = 0, albedo_color_ = 0, group_ = 0, glare_ = 0;
  Eigen::VectorXd x_;
  Eigen::MatrixXd curve_precision_, covariance_;
};

/// The likelier of a place with a sun and one without.
ChartFit BestFit(const ResponseChart& chart, bool free_curve) {
  ChartFit sunlit(chart, free_curve, true), overcast(chart, free_curve, false);
  return sunlit.Cost() <= overcast.Cost() ? sunlit : overcast;
}

std::optional<CameraResponse> ResponseOf(const ChartFit& fit) {
  std::vector<double> encoded, light;
  for (int i = 0; i < kSamples; ++i) {
    const double code = i / (kSamples - 1.0);
    encoded.push_back(code);
    // A curve that falls would give one pixel value two lights.
    light.push_back(i > 0 ? std::max(fit.Light(code), light[i - 1] + 1e-5) : 0.0);
  }
  const double most = light.back();
  for (double& value : light) value /= most;
  light.back() = 1.0;
  return CameraResponse::FromSamples(encoded, {light, light, light});
}

}  // namespace

ResponseEstimate FitResponse(const ResponseChart& chart) {
  ResponseEstimate estimate;
  const bool white = std::any_of(chart.fields.begin(), chart.fields.end(), [&](const auto& field) {
    return chart.surfaces[field.surface] == Surface::kWhite;
  });
  estimate.usable =
      white && chart.fields.size() >= kMinFields * chart.frames && !chart.unmodelled_shadows;
  if (!estimate.usable) return estimate;
  const ChartFit srgb = BestFit(chart, false), other = BestFit(chart, true);
  estimate.log_evidence = srgb.Cost() - other.Cost();
  estimate.log_error = other.Error();
  const std::optional<CameraResponse> response = ResponseOf(other);
  estimate.conclusive = response && estimate.log_evidence > kStrong;
  if (estimate.conclusive) estimate.response = *response;
  return estimate;
}

}  // namespace pleinair::compositor
