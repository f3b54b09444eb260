#include "compositor/lens/focus_course.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pleinair::compositor {
namespace {

/// Focus of one window by Gauss–Newton; error 0 where its readings do not determine it.
FocusAt FocusOfWindow(const FocusCourse& course, std::span<const BlurReading> readings,
                      std::span<const double> weights) {
  constexpr int kIterations = 8;
  FocusAt found{0.0, course.start_dioptres, 0.0};
  const double lowest = course.own_blur_px * course.own_blur_px;
  double time_s = 0.0, count = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!(weights[i] > 0.0)) continue;
    time_s += readings[i].timestamp_s;
    count += 1.0;
  }
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    double right = 0.0, left = 0.0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const BlurReading& r = readings[i];
      const double f = found.focus_dioptres;
      const double at = lowest + course.motion * r.squared_speed +
                        course.curvature * (r.dioptres_squared - 2.0 * f * r.dioptres + f * f);
      const double by_focus = 2.0 * course.curvature * (f - r.dioptres);
      right += weights[i] * by_focus * (r.blur_px * r.blur_px - at);
      left += weights[i] * by_focus * by_focus;
    }
    if (!(left > 0.0)) return {};
    found.focus_dioptres = std::max(0.0, found.focus_dioptres + right / left);
    found.error = 1.0 / std::sqrt(left);
  }
  found.timestamp_s = time_s / count;
  return found;
}

}  // namespace

std::vector<FocusAt> FocusCourse::Windows(std::span<const BlurReading> readings,
                                          std::span<const double> weights) const {
  constexpr double kWindow_s = 2.0;
  std::vector<FocusAt> windows;
  for (std::size_t begin = 0, end = 0; begin < readings.size(); begin = end) {
    const double start_s = readings[begin].timestamp_s;
    while (end < readings.size() && readings[end].timestamp_s < start_s + kWindow_s) ++end;
    const FocusAt found = FocusOfWindow(*this, readings.subspan(begin, end - begin),
                                        weights.subspan(begin, end - begin));
    if (found.error > 0.0) windows.push_back(found);
  }
  return windows;
}

bool HasSteps(const std::vector<FocusAt>& windows) {
  constexpr double kStep = 4.0;
  for (std::size_t i = 1; i < windows.size(); ++i) {
    const double step = windows[i].focus_dioptres - windows[i - 1].focus_dioptres;
    if (std::fabs(step) > kStep * std::hypot(windows[i].error, windows[i - 1].error)) return true;
  }
  return false;
}

void SmoothFocus(std::vector<FocusAt>* windows) {
  std::vector<FocusAt>& at = *windows;
  if (at.size() < 2) return;
  double variance_per_s = 0.0;
  for (std::size_t i = 1; i < at.size(); ++i) {
    const double step = at[i].focus_dioptres - at[i - 1].focus_dioptres;
    variance_per_s += step * step / (at[i].timestamp_s - at[i - 1].timestamp_s);
  }
  variance_per_s /= static_cast<double>(at.size() - 1);
  std::vector<double> predicted(at.size());
  for (std::size_t i = 1; i < at.size(); ++i) {
    const double walked = variance_per_s * (at[i].timestamp_s - at[i - 1].timestamp_s);
    predicted[i] = at[i - 1].error * at[i - 1].error + walked;
    const double own = at[i].error * at[i].error, gain = predicted[i] / (predicted[i] + own);
    at[i].focus_dioptres =
        at[i - 1].focus_dioptres + gain * (at[i].focus_dioptres - at[i - 1].focus_dioptres);
    at[i].error = std::sqrt(gain * own);
  }
  for (std::size_t i = at.size() - 1; i-- > 0;) {
    const double own = at[i].error * at[i].error, gain = own / predicted[i + 1];
    at[i].focus_dioptres += gain * (at[i + 1].focus_dioptres - at[i].focus_dioptres);
    const double later = at[i + 1].error * at[i + 1].error;
    at[i].error = std::sqrt(std::max(0.0, own + gain * gain * (later - predicted[i + 1])));
  }
}

double FocusAtTime(const std::vector<FocusAt>& windows, double time_s) {
  const auto after = std::find_if(windows.begin(), windows.end(),
                                  [&](const FocusAt& at) { return at.timestamp_s > time_s; });
  if (after == windows.begin()) return windows.front().focus_dioptres;
  const FocusAt& before = *(after - 1);
  if (after == windows.end()) return before.focus_dioptres;
  const double share = (time_s - before.timestamp_s) / (after->timestamp_s - before.timestamp_s);
  return before.focus_dioptres + share * (after->focus_dioptres - before.focus_dioptres);
}

}  // namespace pleinair::compositor
