#include "compositor/lens/focus_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "compositor/lens/blur_parabola.h"
#include "compositor/lens/focus_course.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kMinReadings = 16;
constexpr double kLeastRise_px = 0.15;                       // The blur at an end above σ₀.
constexpr double kLeastCurvature = 3.0, kLeastMotion = 3.0;  // Standard errors.
constexpr double kMaxFocusError = 0.1, kMaxFocusErrorShare = 0.1;
constexpr double kMinOwnBlur_px = 0.2;
// Student's t for eight groups over the normal distribution, at 95 %.
constexpr double kFewGroups = 2.365 / 1.96;
constexpr int kGroups = 8, kRounds = 3;

/// Variance of a reading that the next reading at the same distance shares: edges and pixel grid
/// are the same there.
double SharedVariance(double blur_px) {
  const double shared_px = 0.01 + 0.005 * blur_px;
  return shared_px * shared_px;
}

/// How many readings lie at about the distance of each.
std::vector<double> Neighbours(std::span<const BlurReading> readings) {
  constexpr double kBin = 0.03;  // A share of the distance.
  std::map<long, double> bins;
  const auto bin = [](const BlurReading& r) { return std::lround(std::log(r.dioptres) / kBin); };
  for (const BlurReading& reading : readings) bins[bin(reading)] += 1.0;
  std::vector<double> count(readings.size());
  std::transform(readings.begin(), readings.end(), count.begin(),
                 [&](const BlurReading& reading) { return bins[bin(reading)]; });
  return count;
}

/// Readings, and how much each counts.
struct Weighed {
  std::span<const BlurReading> readings;
  std::vector<double> neighbours;
  std::vector<double> weights;
  std::vector<bool> is_moved;

  double Variance(std::size_t i, double squared_blur) const {
    const double own = readings[i].error_px * readings[i].error_px;
    return 4.0 * squared_blur * (own + neighbours[i] * SharedVariance(std::sqrt(squared_blur)));
  }
  /// From the fitted blur: weights by a reading's own would favour those read too small.
  void WeighBy(const BlurParabola* fitted) {
    constexpr double kHuber = 1.345;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const double read = readings[i].blur_px * readings[i].blur_px;
      const double expected = fitted ? fitted->At(readings[i]) : read;
      const double variance = Variance(i, std::max(expected, 0.25 * read));
      const double off = fitted ? std::fabs(read - expected) / std::sqrt(variance) : 0.0;
      weights[i] = is_moved[i] ? 0.0 : std::min(1.0, kHuber / std::max(off, 1e-9)) / variance;
    }
  }
  /// Sum of squares over degrees of freedom, at least 1: formal errors are scaled by its root.
  double ReducedChiSquared(const BlurParabola& fitted, int unknowns) const {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      if (!(weights[i] > 0.0)) continue;
      const double off = readings[i].blur_px * readings[i].blur_px - fitted.At(readings[i]);
      sum += weights[i] * off * off;
      count += 1.0;
    }
    return std::max(1.0, sum / std::max(1.0, count - unknowns));
  }
};

/// Marks the sides that are blurred along one direction of the picture only.
void MarkMoved(const BlurParabola& fitted, Weighed* weighed) {
  constexpr double kMaxRatio = 1.15, kSignificant = 3.0;
  const std::span<const BlurReading> readings = weighed->readings;
  for (std::size_t begin = 0, end = 0; begin < readings.size(); begin = end) {
    std::array<double, 2> ratio{}, variance{};
    std::array<int, 2> count{};
    for (end = begin;
         end < readings.size() && readings[end].frame_index == readings[begin].frame_index; ++end) {
      const double expected = std::sqrt(std::max(fitted.At(readings[end]), 1e-4));
      const int direction = readings[end].side % 2;
      ratio[direction] += readings[end].blur_px / expected;
      variance[direction] += std::pow(readings[end].error_px / expected, 2);
      ++count[direction];
    }
    if (count[0] == 0 || count[1] == 0) continue;
    for (const int d : {0, 1}) {
      ratio[d] /= count[d];
      variance[d] /= count[d] * count[d];
    }
    const int blurred = ratio[1] > ratio[0] ? 1 : 0;
    const double excess = ratio[blurred] / std::max(ratio[1 - blurred], 1e-6);
    const double noise = std::sqrt(variance[0] + variance[1]) / std::max(ratio[1 - blurred], 1e-6);
    if (excess < kMaxRatio || excess - 1.0 < kSignificant * noise) continue;
    for (std::size_t i = begin; i < end; ++i) {
      if (readings[i].side % 2 == blurred) weighed->is_moved[i] = true;
    }
  }
}

/// Standard errors by leaving out an eighth of the frames in turn; infinite where a part does not
/// determine the parabola.
std::pair<double, double> JackknifeErrors(const Weighed& weighed, const ParabolaShape& shape) {
  const std::span<const BlurReading> readings = weighed.readings;
  std::vector<std::int64_t> frames;
  for (const BlurReading& reading : readings) {
    if (frames.empty() || frames.back() != reading.frame_index) {
      frames.push_back(reading.frame_index);
    }
  }
  std::array<double, kGroups> curvatures{}, focuses{};
  std::vector<double> weights(readings.size());
  for (int group = 0; group < kGroups; ++group) {
    const auto at = [&](int g) {
      const std::size_t i = frames.size() * static_cast<std::size_t>(g) / kGroups;
      return i < frames.size() ? frames[i] : std::numeric_limits<std::int64_t>::max();
    };
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const bool is_out =
          readings[i].frame_index >= at(group) && readings[i].frame_index < at(group + 1);
      weights[i] = is_out ? 0.0 : weighed.weights[i];
    }
    const auto fitted = FitParabola(readings, weights, shape);
    if (!fitted || !(fitted->parabola.c > 0.0)) {
      constexpr double kInfinite = std::numeric_limits<double>::infinity();
      return {kInfinite, kInfinite};
    }
    curvatures[group] = fitted->parabola.c;
    focuses[group] = fitted->parabola.Focus();
  }
  const auto error = [](const std::array<double, kGroups>& values) {
    double mean = 0.0, squares = 0.0;
    for (const double value : values) mean += value / kGroups;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return kFewGroups * std::sqrt(squares * (kGroups - 1) / kGroups);
  };
  return {error(curvatures), error(focuses)};
}

double OwnBlur(const BlurParabola& fitted) {
  return std::sqrt(std::max(fitted.Lowest(), kMinOwnBlur_px * kMinOwnBlur_px));
}

/// Where the focus changes: fits aperture and course by turns. From then on the readings are
/// relative to the focus of their time, which `shape` says. Otherwise returns nothing and leaves
/// all as it is. `from_focus` holds the relative readings.
std::vector<FocusAt> FollowFocus(double own_blur_px, std::vector<BlurReading>* from_focus,
                                 Weighed* weighed, FittedParabola* fitted, ParabolaShape* shape) {
  constexpr int kTurns = 8;
  const std::span<const BlurReading> readings = weighed->readings;
  FocusCourse course{fitted->parabola.c, fitted->parabola.e, own_blur_px, fitted->parabola.Focus()};
  std::vector<FocusAt> windows = course.Windows(readings, weighed->weights);
  if (!HasSteps(windows)) return {};
  shape->focus_dioptres = 0.0;
  for (int turn = 0; turn < kTurns; ++turn) {
    from_focus->assign(readings.begin(), readings.end());
    for (BlurReading& reading : *from_focus) {
      const double focus = FocusAtTime(windows, reading.timestamp_s);
      reading.dioptres_squared += focus * (focus - 2.0 * reading.dioptres);
      reading.dioptres -= focus;
    }
    weighed->readings = *from_focus;
    const auto again = FitParabola(weighed->readings, weighed->weights, *shape);
    if (!again || !(again->parabola.c > 0.0)) break;
    *fitted = *again;
    weighed->WeighBy(&fitted->parabola);
    course.curvature = fitted->parabola.c;
    course.own_blur_px = OwnBlur(fitted->parabola);
    windows = course.Windows(readings, weighed->weights);
  }
  SmoothFocus(&windows);
  return windows;
}

/// Distances of the print's centre, nearest and farthest, without the outermost twentieths.
std::pair<double, double> DistancesOfCentre(std::span<const BlurReading> readings) {
  std::map<std::int64_t, std::pair<double, int>> frames;
  for (const BlurReading& reading : readings) {
    auto& [sum, count] = frames[reading.frame_index];
    sum += reading.dioptres;
    ++count;
  }
  std::vector<double> distances;
  distances.reserve(frames.size());
  for (const auto& [index, frame] : frames) distances.push_back(frame.second / frame.first);
  std::sort(distances.begin(), distances.end());
  const std::size_t rare = distances.size() / 20;
  return {distances[rare], distances[distances.size() - 1 - rare]};
}

}  // namespace

FocusFit FitFocus(std::span<const BlurReading> readings, double fx, const KnownLens& known) {
  FocusFit fit;
  fit.readings = readings.size();
  if (readings.size() < kMinReadings) {
    fit.reason = "too few edges of the marker are large and free enough to read their blur";
    return fit;
  }
  std::tie(fit.nearest_m, fit.farthest_m) = DistancesOfCentre(readings);
  if (fit.farthest_m < kLeastDistanceChange * fit.nearest_m) {
    fit.reason = "the marker's distance hardly changes";
    return fit;
  }
  Weighed weighed{readings, Neighbours(readings), std::vector<double>(readings.size()),
                  std::vector<bool>(readings.size())};
  ParabolaShape shape;
  if (known.aperture_m) shape.curvature = std::pow(fx * *known.aperture_m / 4.0, 2);
  shape.focus_dioptres = known.focus_dioptres;
  if (known.exposure_s) {
    shape.motion = *known.exposure_s * *known.exposure_s / 12.0;
  } else if (std::ranges::any_of(readings, [](const auto& r) { return r.squared_speed > 0.0; })) {
    shape.motion.reset();
  }
  const auto undetermined = [&] {
    fit.reason = "the marker's blur and distance do not determine a lens";
    return fit;
  };
  weighed.WeighBy(nullptr);
  std::optional<FittedParabola> fitted;
  for (int round = 0; round <= kRounds; ++round) {
    fitted = FitParabola(readings, weighed.weights, shape);
    if (!fitted) return undetermined();
    if (!shape.motion && round > 0 &&
        !(fitted->parabola.e > kLeastMotion * fitted->motion_error *
                                   std::sqrt(weighed.ReducedChiSquared(fitted->parabola, 4)))) {
      shape.motion = 0.0;
      fitted = FitParabola(readings, weighed.weights, shape);
      if (!fitted) return undetermined();
    }
    if (round == 1) MarkMoved(fitted->parabola, &weighed);
    if (round < kRounds) weighed.WeighBy(&fitted->parabola);
  }
  fit.readings = static_cast<std::size_t>(
      std::ranges::count_if(weighed.weights, [](double weight) { return weight > 0.0; }));
  fit.exposure_s = std::sqrt(12.0 * std::max(0.0, fitted->parabola.e));
  if (fit.readings < kMinReadings || 2 * fit.readings < readings.size()) {
    fit.reason = "the camera's motion blurs the marker's edges";
    return fit;
  }
  if (!(fitted->parabola.c > 0.0)) {
    fit.reason = "the marker's blur does not grow away from a distance in focus";
    return fit;
  }
  fit.focus_dioptres = fitted->parabola.Focus();
  fit.in_focus_blur_px = OwnBlur(fitted->parabola);
  std::vector<BlurReading> from_focus;
  if (!shape.focus_dioptres) {
    fit.changes = FollowFocus(fit.in_focus_blur_px, &from_focus, &weighed, &*fitted, &shape);
  }
  const BlurParabola& parabola = fitted->parabola;
  const double scale = std::sqrt(weighed.ReducedChiSquared(parabola, 3));
  const auto [curvature_spread, focus_spread] = JackknifeErrors(weighed, shape);
  const double curvature_error =
      shape.curvature ? 0.0 : std::max(scale * fitted->curvature_error, curvature_spread);
  if (!fit.changes.empty()) {
    fit.focus_dioptres = fit.changes.back().focus_dioptres;
    for (const FocusAt& at : fit.changes) {
      fit.focus_dioptres_error = std::max(fit.focus_dioptres_error, at.error);
    }
  } else if (!shape.focus_dioptres) {
    fit.focus_dioptres_error = std::max(scale * fitted->focus_error, focus_spread);
  }
  fit.aperture_m = 4.0 * std::sqrt(parabola.c) / fx;
  fit.aperture_relative_error = curvature_error / (2.0 * parabola.c);
  fit.in_focus_blur_px = OwnBlur(parabola);
  if (!(parabola.c > kLeastCurvature * curvature_error)) {
    fit.reason = "the marker's blur hardly depends on its distance";
    return fit;
  }
  const auto rise_at = [&](double distance_m) {
    const double off = 1.0 / distance_m - fit.focus_dioptres;
    return std::hypot(fit.in_focus_blur_px, std::sqrt(parabola.c) * off) - fit.in_focus_blur_px;
  };
  if (std::max(rise_at(fit.nearest_m), rise_at(fit.farthest_m)) < kLeastRise_px) {
    fit.reason = "the marker's blur hardly depends on its distance";
    return fit;
  }
  if (!(fit.focus_dioptres_error <
        kMaxFocusError + kMaxFocusErrorShare * std::fabs(fit.focus_dioptres))) {
    fit.reason = "the marker was not seen both nearer and farther than the focus";
    return fit;
  }
  if (fit.focus_dioptres < 0.0) {
    // A lens cannot focus beyond infinity.
    if (fit.focus_dioptres < -3.0 * fit.focus_dioptres_error) {
      fit.reason = "the marker's blur falls with its distance faster than any lens's";
      return fit;
    }
    fit.focus_dioptres = 0.0;
  }
  return fit;
}

}  // namespace pleinair::compositor
