#include "sky/clouds/film/field_in_step.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#include "base/parallel_for.h"
#include "sky/clouds/cloud_shadow.h"

namespace pleinair::clouds {
namespace {

constexpr double kColumn_m = kCoverSquare_m / 1024.0;  ///< For cells up to 8 km.
constexpr int kSearchSamples = 48;
constexpr double kSearchStep_m = 200.0;

/// The place that the sun's ray crosses in the lower part of the layer, where most of it is.
Vec2 UnderSun(const CloudLayer& layer, Direction<World> to_sun) {
  const double height = layer.base_m + 0.35 * layer.thickness_m;
  const double reach = height / std::max(0.02, to_sun.xyz.z);
  return {to_sun.xyz.x * reach, to_sun.xyz.y * reach};
}

std::vector<double> SunAlong(const CloudField& field, const std::vector<double>& seconds,
                             const SunAt& sun_at) {
  // The field outlives the pointer.
  const CloudFields fields{std::shared_ptr<const CloudField>(std::shared_ptr<void>(), &field)};
  std::vector<double> sun(seconds.size());
  ParallelForBlocks(seconds.size(), 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      sun[i] = SunTransmittance(fields, {}, sun_at(seconds[i]), seconds[i]);
    }
  });
  return sun;
}

double RmsOf(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// Times of the shifts: a column apart, and 400 at most.
std::vector<double> TimesOfShifts(const CloudLayer& layer, const FilmCourse& course) {
  constexpr int kMost = 400;
  const double step = std::max(course.Span() / kMost, kColumn_m / layer.wind_m_s);
  const int count = std::max(2, static_cast<int>(std::ceil(course.Span() / step)) + 1);
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    times.push_back(course.seconds.front() + course.Span() * i / (count - 1));
  }
  return times;
}

/// One shift on its way.
struct Shift {
  double step = 0.6, last = 0.0;
  void Move(double off, double* value) {
    if (off == 0.0) return;
    const double sign = off > 0.0 ? 1.0 : -1.0;
    if (last != 0.0) step *= sign == last ? 1.2 : 0.5;
    step = std::clamp(step, 1e-3, 1.0);
    last = sign;
    *value = std::clamp(*value + sign * step, -0.5 * kMaxPassingShift, 0.5 * kMaxPassingShift);
  }
};

/// How much darker the place has to become: 0 where the difference does not matter.
double TooBright(double sun, double wanted, double noise) {
  constexpr double kShade = 0.03, kOpen = 0.97;
  const double close = std::max(0.01, 0.5 * noise);
  if (wanted <= kShade && sun <= kShade) return 0.0;
  if (wanted >= kOpen && sun >= kOpen) return 0.0;
  return std::fabs(sun - wanted) > close ? sun - wanted : 0.0;
}

/// The displacement with which the field resembles the course most.
Vec2 BestDisplacement(const CloudField& field, const FilmCourse& course, const SunAt& sun_at) {
  std::vector<double> seconds, wanted;
  seconds.reserve(kSearchSamples);
  wanted.reserve(kSearchSamples);
  for (int i = 0; i < kSearchSamples; ++i) {
    seconds.push_back(course.seconds.front() + course.Span() * (i + 0.5) / kSearchSamples);
    wanted.push_back(ValueAt(course.seconds, course.sun, seconds.back()));
  }
  std::vector<Direction<World>> suns;
  suns.reserve(kSearchSamples);
  for (const double time : seconds) suns.push_back(sun_at(time));
  constexpr auto kSteps = static_cast<std::size_t>(kCoverSquare_m / kSearchStep_m);
  struct Best {
    double square = std::numeric_limits<double>::infinity(), east_m = 0.0, north_m = 0.0;
  };
  std::vector<Best> rows(kSteps);
  ParallelFor(kSteps, 0, [&](std::size_t row) {
    for (std::size_t column = 0; column < kSteps; ++column) {
      const double east_m = kSearchStep_m * static_cast<double>(column);
      const double north_m = kSearchStep_m * static_cast<double>(row);
      double square = 0.0;
      for (std::size_t i = 0; i < seconds.size() && square < rows[row].square; ++i) {
        const double off =
            std::exp(-field.DepthAlong({-east_m, -north_m, 0.0}, suns[i].xyz, seconds[i])) -
            wanted[i];
        square += off * off;
      }
      if (square < rows[row].square) rows[row] = {square, east_m, north_m};
    }
  });
  const Best best = *std::min_element(
      rows.begin(), rows.end(), [](const Best& a, const Best& b) { return a.square < b.square; });
  return {best.east_m, best.north_m};
}

}  // namespace

FieldInStep InStep(const CloudLayer& layer, const FilmCourse& course, const SunAt& sun_at) {
  constexpr int kRounds = 40;
  const CloudField bare(layer);
  const Vec2 displacement_m = BestDisplacement(bare, course, sun_at);
  const Direction<World> middle_sun = sun_at(course.seconds.front() + 0.5 * course.Span());
  CloudPassing passing;
  const Vec2 place = UnderSun(layer, middle_sun);
  passing.east_m = std::round(place.x);
  passing.north_m = std::round(place.y);
  // Half of what the ray crosses, and as much as a cell has.
  const double crossed = 0.5 * layer.thickness_m * std::hypot(middle_sun.xyz.x, middle_sun.xyz.y) /
                         std::max(0.02, middle_sun.xyz.z);
  passing.width_m = std::clamp(std::round(std::max(layer.cell_m, 2.0 * crossed)), 100.0, 5'000.0);
  passing.seconds = TimesOfShifts(layer, course);
  const std::size_t count = passing.seconds.size();
  passing.shifts.assign(count, 0.0);
  std::vector<double> wanted;
  wanted.reserve(count);
  for (const double time : passing.seconds) {
    wanted.push_back(ValueAt(course.seconds, course.sun, time));
  }
  std::vector<Shift> shifts(count);
  CloudPassing best;
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const CloudField field(bare, displacement_m, passing);
    const std::vector<double> sun = SunAlong(field, passing.seconds, sun_at);
    const double rms = RmsOf(sun, wanted);
    if (rms < least) {
      least = rms;
      best = passing;
    }
    bool moved = false;
    for (std::size_t i = 0; i < count; ++i) {
      const double off = TooBright(sun[i], wanted[i], course.noise);
      moved = moved || off != 0.0;
      shifts[i].Move(off, &passing.shifts[i]);
    }
    if (!moved) break;
  }
  for (double& shift : best.shifts) shift = std::round(1e3 * shift) * 1e-3;
  for (double& time : best.seconds) time = std::round(1e3 * time) * 1e-3;
  FieldInStep found;
  found.field = std::make_shared<const CloudField>(bare, displacement_m, best);
  found.sun = SunAlong(*found.field, course.seconds, sun_at);
  found.sun_rms = RmsOf(found.sun, course.sun);
  return found;
}

double LeastWind(const FilmCourse& course) {
  // The shortest time between two changes of the sun by a half.
  double since = course.seconds.front(), shortest = course.Span();
  bool shaded = course.sun.front() < 0.5, seen_one = false;
  for (std::size_t i = 1; i < course.sun.size(); ++i) {
    // Not by noise.
    const double margin = std::min(0.4, 2.0 * course.noise);
    if (shaded ? course.sun[i] < 0.5 + margin : course.sun[i] > 0.5 - margin) continue;
    shaded = !shaded;
    if (seen_one) shortest = std::min(shortest, course.seconds[i] - since);
    since = course.seconds[i];
    seen_one = true;
  }
  return 3.0 * kColumn_m / std::max(0.1, shortest);
}

}  // namespace pleinair::clouds
