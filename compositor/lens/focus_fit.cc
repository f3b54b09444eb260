#include "compositor/lens/focus_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "compositor/lens/blur_parabola.h"
#include "compositor/lens/focus_course.h"
#include "compositor/lens/weighed_readings.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kMinReadings = 16;
constexpr double kLeastRise_px = 0.15;                       // The blur at an end above σ₀.
constexpr double kLeastCurvature = 3.0, kLeastMotion = 3.0;  // Standard errors.
constexpr double kMaxFocusError = 0.1, kMaxFocusErrorShare = 0.1;
constexpr double kMinOwnBlur_px = 0.2;
constexpr int kRounds = 3;

/// Marks the sides that are blurred along one direction of the picture only.
void MarkMoved(const BlurParabola& fitted, WeighedReadings* weighed) {
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

/// Standard errors of curvature and focus by leaving out an eighth of the frames in turn; infinite
/// where a part does not determine the parabola.
std::pair<double, double> ErrorsByParts(const WeighedReadings& weighed,
                                        const ParabolaShape& shape) {
  const auto errors = JackknifeErrors<2>(
      weighed, [&](std::span<const double> weights) -> std::optional<std::array<double, 2>> {
        const auto fitted = FitParabola(weighed.readings, weights, shape);
        if (!fitted || !(fitted->parabola.c > 0.0)) return std::nullopt;
        return std::array{fitted->parabola.c, fitted->parabola.Focus()};
      });
  return {errors[0], errors[1]};
}

double OwnBlur(const BlurParabola& fitted) {
  return std::sqrt(std::max(fitted.Lowest(), kMinOwnBlur_px * kMinOwnBlur_px));
}

/// Where the focus changes: fits aperture and course by turns. From then on the readings are
/// relative to the focus of their time, which `shape` says. Otherwise returns nothing and leaves
/// all as it is. `from_focus` holds the relative readings.
std::vector<FocusAt> FollowFocus(double own_blur_px, std::vector<BlurReading>* from_focus,
                                 WeighedReadings* weighed, FittedParabola* fitted,
                                 ParabolaShape* shape) {
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
  WeighedReadings weighed(readings);
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
  fit.readings = weighed.CountUsed();
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
  const auto [curvature_spread, focus_spread] = ErrorsByParts(weighed, shape);
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
