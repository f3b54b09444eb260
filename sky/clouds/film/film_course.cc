#include "sky/clouds/film/film_course.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "base/quantile.h"

namespace pleinair::clouds {
namespace {

// Light that never changes is that of a clear sky if its ratio is at least half. Under a slab of an
// optical depth of 0.5 it is less.
constexpr double kClearSteadyRatio = 0.5;
// Beside the sun, the light of clouds may raise the sky to the fivefold.
constexpr double kClearTopRatio = 0.15;
constexpr double kSteadyChange = 0.1;
constexpr double kSteadyExposure = 2.0;

/// The largest median of five neighbours: no single frame decides.
double LargestOfMedians(const std::vector<double>& values) {
  double largest = 0.0;
  for (std::size_t i = 0; i + 5 <= values.size(); ++i) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(i);
    largest = std::max(largest, Median(std::vector<double>(at, at + 5)));
  }
  return largest;
}

/// Standard deviation from frame to frame, by second differences: a trend does not count.
double NoiseOf(const std::vector<double>& values) {
  std::vector<double> changes;
  changes.reserve(values.size());
  for (std::size_t i = 1; i + 1 < values.size(); ++i) {
    changes.push_back(std::fabs(values[i - 1] - 2.0 * values[i] + values[i + 1]));
  }
  // In a normal distribution the median of the magnitude is 0.6745 deviations.
  return changes.empty() ? 0.0 : Median(changes) / (0.6745 * std::sqrt(6.0));
}

}  // namespace

bool FilmCourse::SeesClearSun() const {
  return top_ratio >= (IsSteady() ? kClearSteadyRatio : kClearTopRatio);
}

bool FilmCourse::IsSteady() const {
  return Quantile(sun, 0.98) - Quantile(sun, 0.02) < kSteadyChange * Quantile(sun, 0.98) ||
         Quantile(sun, 0.98) < 0.01;
}

double ValueAt(const std::vector<double>& times, const std::vector<double>& values, double time) {
  const auto next = std::lower_bound(times.begin(), times.end(), time);
  if (next == times.begin()) return values.front();
  if (next == times.end()) return values.back();
  const auto i = static_cast<std::size_t>(next - times.begin());
  const double part = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return values[i - 1] + part * (values[i] - values[i - 1]);
}

Result<FilmCourse> MakeFilmCourse(const std::vector<FilmLight>& frames, double clear_sun_over_sky) {
  if (frames.size() < kMinFilmFrames ||
      frames.back().seconds - frames.front().seconds < kMinFilm_s) {
    return InputError({},
                      "holds the light of " + std::to_string(frames.size()) +
                          " frames, too few or too short a time",
                      "film for 10 s or longer");
  }
  FilmCourse course;
  std::vector<double> suns, skies, ratios;
  for (std::vector<double>* list : {&suns, &skies, &ratios, &course.seconds}) {
    list->reserve(frames.size());
  }
  for (const FilmLight& frame : frames) {
    if (!(frame.sky > 0.0)) {
      return InputError({}, "holds a frame without skylight", "film by day, with the lens free");
    }
    suns.push_back(frame.sun);
    skies.push_back(frame.sky);
    ratios.push_back(frame.sun / frame.sky / clear_sun_over_sky);
    course.seconds.push_back(frame.seconds);
  }
  const bool steady_exposure =
      Quantile(skies, 0.98) < kSteadyExposure * std::max(1e-12, Quantile(skies, 0.02));
  const std::vector<double>& course_of = steady_exposure ? suns : ratios;
  const double largest = LargestOfMedians(course_of);
  double top = 0.0, top_ratio = 0.0, count = 0.0;
  for (std::size_t i = 0; i < course_of.size(); ++i) {
    if (course_of[i] < 0.85 * largest) continue;
    top += course_of[i];
    top_ratio += ratios[i];
    count += 1.0;
  }
  top /= count;
  course.top_ratio = top_ratio / count;
  course.sun.reserve(frames.size());
  for (const double value : course_of) {
    course.sun.push_back(top > 0.0 ? std::clamp(value / top, 0.0, 1.0) : 0.0);
  }
  const double top_sun = course.SeesClearSun() ? 1.0 : course.top_ratio;
  for (double& sun : course.sun) sun *= top_sun;
  course.noise = std::max(0.005, NoiseOf(course.sun));
  if (steady_exposure && top > 0.0 && top_sun > 0.0) {
    course.sky.reserve(frames.size());
    for (const double sky : skies) {
      course.sky.push_back(sky * top_sun * clear_sun_over_sky / top);
    }
  }
  return course;
}

}  // namespace pleinair::clouds
