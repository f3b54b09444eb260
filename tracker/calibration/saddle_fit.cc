#include "tracker/calibration/saddle_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace pleinair::tracker {
namespace {

constexpr int kUnknowns = 7;  // x, y, both directions, blur, level, contrast.
using Vector = Eigen::Matrix<double, kUnknowns, 1>;
using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

struct Sample {
  double x, y, light;
};

/// Predicted minus observed light of a pixel, and its derivatives.
double Differ(const Vector& at, const Sample& sample, Vector* by) {
  const double dx = sample.x - at(0), dy = sample.y - at(1);
  const double blur = at(4);
  double edge[2], slope[2], along[2], away[2];
  for (int i = 0; i < 2; ++i) {
    const double c = std::cos(at(2 + i)), s = std::sin(at(2 + i));
    away[i] = c * dy - s * dx;
    along[i] = c * dx + s * dy;
    edge[i] = std::erf(away[i] / (std::numbers::sqrt2 * blur));
    slope[i] = std::sqrt(2.0 / std::numbers::pi) / blur *
               std::exp(-0.5 * away[i] * away[i] / (blur * blur));
  }
  const double contrast = at(6);
  const double by_first = contrast * slope[0] * edge[1], by_second = contrast * edge[0] * slope[1];
  *by << by_first * std::sin(at(2)) + by_second * std::sin(at(3)),
      -by_first * std::cos(at(2)) - by_second * std::cos(at(3)), -by_first * along[0],
      -by_second * along[1], -(by_first * away[0] + by_second * away[1]) / blur, 1.0,
      edge[0] * edge[1];
  return at(5) + contrast * edge[0] * edge[1] - sample.light;
}

/// Normal equations; returns the sum of squares.
double Equations(const Vector& at, const std::vector<Sample>& samples, Matrix* matrix,
                 Vector* gradient) {
  matrix->setZero();
  gradient->setZero();
  double sum = 0.0;
  Vector by;
  for (const Sample& sample : samples) {
    const double difference = Differ(at, sample, &by);
    sum += difference * difference;
    *matrix += by * by.transpose();
    *gradient += by * difference;
  }
  return sum;
}

/// On a circle the sign of sin(φ − a) sin(φ − b) = ½ (cos(a − b) − cos(2φ − a − b)) changes four
/// times, so the phase of the second harmonic is a + b. The initial angle between the edges is a
/// right angle.
Vector Start(const std::vector<Sample>& samples, cv::Point2d start) {
  double mean = 0.0, cosine = 0.0, sine = 0.0;
  for (const Sample& sample : samples) mean += sample.light / static_cast<double>(samples.size());
  for (const Sample& sample : samples) {
    const double twice = 2.0 * std::atan2(sample.y - start.y, sample.x - start.x);
    cosine += (sample.light - mean) * std::cos(twice);
    sine += (sample.light - mean) * std::sin(twice);
  }
  const double sum = std::atan2(-sine, -cosine);
  double deviation = 0.0;
  for (const Sample& sample : samples) {
    deviation += (sample.light - mean) * (sample.light - mean);
  }
  Vector at;
  at << start.x, start.y, 0.5 * (sum - std::numbers::pi / 2.0),
      0.5 * (sum + std::numbers::pi / 2.0), 0.8, mean,
      -std::sqrt(deviation / static_cast<double>(samples.size()));
  // With this order of the directions the product is negative where the harmonic is positive.
  at(6) = -at(6);
  return at;
}

}  // namespace

std::optional<cv::Point2d> FitSaddle(const cv::Mat& linear, cv::Point2d start, int half) {
  const int middle_x = static_cast<int>(std::lround(start.x));
  const int middle_y = static_cast<int>(std::lround(start.y));
  std::vector<Sample> samples;
  double mean = 0.0, variance = 0.0;
  for (int y = std::max(0, middle_y - half); y <= std::min(linear.rows - 1, middle_y + half); ++y) {
    for (int x = std::max(0, middle_x - half); x <= std::min(linear.cols - 1, middle_x + half);
         ++x) {
      samples.push_back({1.0 * x, 1.0 * y, linear.at<float>(y, x)});
      mean += samples.back().light;
    }
  }
  if (samples.size() < 16) return std::nullopt;
  mean /= static_cast<double>(samples.size());
  for (const Sample& sample : samples) variance += (sample.light - mean) * (sample.light - mean);
  Vector at = Start(samples, start);
  Matrix matrix;
  Vector gradient;
  double sum = Equations(at, samples, &matrix, &gradient), damping = 1e-3;
  constexpr int kSteps = 20;
  constexpr double kDone_px = 1e-4;
  for (int step = 0; step < kSteps; ++step) {
    Matrix damped = matrix;
    damped.diagonal() *= 1.0 + damping;
    Vector next = at - damped.ldlt().solve(gradient);
    next(4) = std::clamp(next(4), 0.3, 0.7 * half + 0.3);
    if (!next.allFinite()) return std::nullopt;
    Matrix next_matrix;
    Vector next_gradient;
    const double next_sum = Equations(next, samples, &next_matrix, &next_gradient);
    if (next_sum > sum) {
      damping *= 10.0;
      if (damping > 1e6) break;
      continue;
    }
    const double moved = (next - at).head<2>().norm();
    at = next;
    matrix = next_matrix;
    gradient = next_gradient;
    sum = next_sum;
    damping *= 0.1;
    if (moved < kDone_px) break;
  }
  constexpr double kUnexplained = 0.1;
  if (std::hypot(at(0) - start.x, at(1) - start.y) > std::max(1.0, 0.35 * half))
    return std::nullopt;
  if (sum > kUnexplained * variance) return std::nullopt;
  return cv::Point2d(at(0), at(1));
}

}  // namespace pleinair::tracker
