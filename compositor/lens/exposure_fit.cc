#include "compositor/lens/exposure_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "compositor/lens/blur_parabola.h"
#include "compositor/lens/weighed_readings.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kMinReadings = 16;
constexpr int kRounds = 3;
constexpr double kLeastSignificance = 3.0;  // Standard errors.
constexpr double kLeastStreak_px = 1.0;     // In a whole interval between frames.
constexpr double kLeastRise_px = 0.1;       // In the blur of the fastest edges.
constexpr double kLongestExposure = 1.1;    // Intervals: cameras' clocks are not exact.
constexpr double kBox = 12.0;               // Squared length of a box over its second moment.

/// The motion's term e and its standard error.
struct MotionTerm {
  double value = 0.0, error = 0.0;
  bool IsSignificant() const { return value > kLeastSignificance * error; }
};

/// Squared speed that a twentieth of the readings exceed, (px/s)².
double FastSquaredSpeed(std::span<const BlurReading> readings) {
  std::vector<double> speeds(readings.size());
  std::transform(readings.begin(), readings.end(), speeds.begin(),
                 [](const BlurReading& reading) { return reading.squared_speed; });
  const auto rare = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() * 19 / 20);
  std::nth_element(speeds.begin(), rare, speeds.end());
  return *rare;
}

/// Terms of the parabola that these distances determine.
ParabolaShape ShapeFor(std::span<const BlurReading> readings) {
  const auto [farthest, nearest] = std::ranges::minmax(
      readings, {}, [](const BlurReading& reading) { return reading.dioptres; });
  ParabolaShape shape;
  shape.motion.reset();
  if (nearest.dioptres < kLeastDistanceChange * farthest.dioptres) {
    shape.curvature = 0.0;
    shape.focus_dioptres = 0.0;
  }
  return shape;
}

/// The motion's term by the differences between the sides of one frame. What blurs all of a frame
/// does not count. Weights depend on the frame alone: those of a fit favour what agrees with it.
std::optional<MotionTerm> WithinFrames(const WeighedReadings& weighed) {
  const std::span<const BlurReading> readings = weighed.readings;
  double right = 0.0, left = 0.0;
  std::vector<std::array<double, 3>> centred;  // Speed, blur, weight.
  centred.reserve(readings.size());
  for (std::size_t begin = 0, end = 0; begin < readings.size(); begin = end) {
    double speed = 0.0, blur = 0.0;
    for (end = begin;
         end < readings.size() && readings[end].frame_index == readings[begin].frame_index; ++end) {
      speed += readings[end].squared_speed;
      blur += readings[end].blur_px * readings[end].blur_px;
    }
    const auto sides = static_cast<double>(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      const double weight = 1.0 / weighed.Variance(begin, blur / sides);
      const double u = readings[i].squared_speed - speed / sides;
      const double s = readings[i].blur_px * readings[i].blur_px - blur / sides;
      right += weight * u * s;
      left += weight * u * u;
      centred.push_back({u, s, weight});
    }
  }
  if (!(left > 0.0)) return std::nullopt;
  MotionTerm term{right / left, 0.0};
  double squares = 0.0;
  for (const auto& [u, s, weight] : centred) {
    const double off = weight * u * (s - term.value * u);
    squares += off * off;
  }
  term.error = std::sqrt(squares) / left;  // For unequal variances (H. White 1980).
  return term;
}

}  // namespace

ExposureFit FitExposure(std::span<const BlurReading> readings, double frame_interval_s) {
  ExposureFit fit;
  fit.readings = readings.size();
  const auto refused = [&](const char* reason) {
    fit.reason = reason;
    return fit;
  };
  if (readings.size() < kMinReadings) {
    return refused("too few edges of the marker are large and free enough to read their blur");
  }
  const double fast = FastSquaredSpeed(readings);
  if (std::sqrt(fast) * frame_interval_s < kLeastStreak_px) {
    return refused("the marker moves too slowly in the frames to be blurred by it");
  }
  const ParabolaShape shape = ShapeFor(readings);
  WeighedReadings weighed(readings);
  weighed.WeighBy(nullptr);
  std::optional<FittedParabola> fitted;
  for (int round = 0; round <= kRounds; ++round) {
    fitted = FitParabola(readings, weighed.weights, shape);
    if (!fitted) return refused("the marker's blur and speed do not determine an exposure");
    if (round < kRounds) weighed.WeighBy(&fitted->parabola);
  }
  fit.readings = weighed.CountUsed();
  const BlurParabola& parabola = fitted->parabola;
  const double scale = std::sqrt(weighed.ReducedChiSquared(parabola, 4));
  const double spread = JackknifeErrors<1>(
      weighed, [&](std::span<const double> weights) -> std::optional<std::array<double, 1>> {
        const auto part = FitParabola(readings, weights, shape);
        if (!part) return std::nullopt;
        return std::array{part->parabola.e};
      })[0];
  const MotionTerm motion{parabola.e, std::max(scale * fitted->motion_error, spread)};
  fit.longest_streak_px = std::sqrt(kBox * std::max(0.0, motion.value) * fast);
  // The fastest edges without their motion, as the others are.
  double still = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    still +=
        weighed.weights[i] * (parabola.At(readings[i]) - parabola.e * readings[i].squared_speed);
    weight += weighed.weights[i];
  }
  still = std::max(0.0, still / weight);
  fit.still_blur_px = std::sqrt(still);
  const double rise_px = std::sqrt(still + std::max(0.0, motion.value) * fast) - std::sqrt(still);
  if (!motion.IsSignificant() || rise_px < kLeastRise_px) {
    const double bound = std::max(0.0, motion.value) + kLeastSignificance * motion.error;
    fit.shorter_than_s = std::sqrt(kBox * bound);
    if (fit.shorter_than_s > frame_interval_s) fit.shorter_than_s = 0.0;
    return refused("the marker's edges blur no more where they move");
  }
  const std::optional<MotionTerm> within = WithinFrames(weighed);
  if (!within || !within->IsSignificant()) {
    return refused("the blur grows with the speed, but not across the motion alone");
  }
  fit.exposure_s = std::sqrt(kBox * motion.value);
  fit.error_s = 0.5 * kBox * motion.error / fit.exposure_s;
  if (fit.exposure_s > kLongestExposure * frame_interval_s) {
    return refused("the blur by motion is longer than the time between two frames");
  }
  return fit;
}

}  // namespace pleinair::compositor
