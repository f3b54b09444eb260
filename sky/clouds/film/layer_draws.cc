#include "sky/clouds/film/layer_draws.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include "base/parallel_for.h"
#include "base/units.h"
#include "sky/clouds/cloud_shadow.h"

namespace pleinair::clouds {
namespace {

constexpr int kFields = 32, kCoursesOfField = 480;
constexpr std::size_t kNearest = 160;

/// Random numbers that are the same with every standard library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double Between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double LogBetween(double low, double high) {
    return std::exp(Between(std::log(low), std::log(high)));
  }
  /// Mean 0, standard deviation 1; nearly normal (sum of twelve).
  double Normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += Between(0.0, 1.0);
    return sum;
  }

 private:
  std::mt19937_64 engine_;
};

/// Value at a share of the whole weight. `values`: of the draws.
double WeightedQuantile(const std::vector<LayerDraw>& draws, double LayerDraw::*value,
                        double share) {
  std::vector<std::pair<double, double>> sorted;
  sorted.reserve(draws.size());
  double whole = 0.0;
  for (const LayerDraw& draw : draws) {
    sorted.emplace_back(draw.*value, draw.weight);
    whole += draw.weight;
  }
  std::sort(sorted.begin(), sorted.end());
  double sum = 0.0;
  for (const auto& [number, weight] : sorted) {
    sum += weight;
    if (sum >= share * whole) return number;
  }
  return sorted.back().first;
}

FittedNumber Range(const std::vector<LayerDraw>& draws, double LayerDraw::*value) {
  return {WeightedQuantile(draws, value, 0.5), WeightedQuantile(draws, value, 0.16),
          WeightedQuantile(draws, value, 0.84)};
}

}  // namespace

CourseNumbers NumbersOf(const std::vector<double>& sun) {
  double sum = 0.0, shaded = 0.0, half = 0.0, in_shade = 0.0, crossings = 0.0, steps = 0.0;
  const auto count = static_cast<double>(sun.size());
  for (std::size_t i = 0; i < sun.size(); ++i) {
    sum += sun[i];
    if (sun[i] < 0.5) {
      shaded += 1.0;
      in_shade += sun[i];
    }
    if (sun[i] > 0.1 && sun[i] < 0.9) half += 1.0;
    if (i == 0) continue;
    if ((sun[i] < 0.5) != (sun[i - 1] < 0.5)) crossings += 1.0;
    steps += (sun[i] - sun[i - 1]) * (sun[i] - sun[i - 1]);
  }
  return {sum / count,
          shaded / count,
          half / count,
          std::log1p(crossings),
          shaded > 0.0 ? in_shade / shaded : 0.5,
          std::sqrt(steps / count)};
}

LayerDraws::LayerDraws(CloudKind kind, Direction<World> to_sun, std::optional<double> wind_from_deg,
                       double noise) {
  CloudLayerFacts facts;
  facts.kind = kind;
  const CloudLayer usual = MakeCloudLayer(facts).value();
  draws_.resize(static_cast<std::size_t>(kFields) * kCoursesOfField);
  // Fields use all processors while they are made, courses after that.
  for (int f = 0; f < kFields; ++f) {
    Dice dice(static_cast<std::uint64_t>(f) * 977 + 13);
    CloudLayer layer = usual;
    // Evenly over the unit square: a Kronecker sequence (Roberts 2018, "R2").
    const auto evenly = [f](double step) { return std::fmod(0.5 + (f + 1) * step, 1.0); };
    layer.cover = 0.02 + 0.96 * evenly(0.7548776662466927);
    layer.optical_depth =
        std::min(200.0, usual.optical_depth * std::exp2(4.0 * evenly(0.5698402909980532) - 2.0));
    layer.seed = 1000 + f;
    // Streaks lie along the wind.
    layer.wind_from_deg = wind_from_deg.value_or(dice.Between(0.0, 360.0));
    const CloudField field(layer);
    ParallelFor(kCoursesOfField, 0, [&](std::size_t c) {
      Dice own(static_cast<std::uint64_t>(f) * kCoursesOfField + c + 1'000'003);
      Draw& draw = draws_[static_cast<std::size_t>(f) * kCoursesOfField + c];
      draw.layer = {layer.cover, layer.optical_depth, own.LogBetween(0.1, 30.0), 0.0};
      const double from = kind == CloudKind::kCirrus || wind_from_deg ? layer.wind_from_deg
                                                                      : own.Between(0.0, 360.0);
      const double azimuth = from * kRadiansPerDegree;
      const Vec3 upwind{std::sin(azimuth), std::cos(azimuth), 0.0};
      const Vec3 start{own.Between(0.0, kCoverSquare_m), own.Between(0.0, kCoverSquare_m), 0.0};
      const double length = draw.layer.cells * layer.cell_m;
      std::vector<double> sun;
      sun.reserve(kCourseSamples);
      for (int i = 0; i < kCourseSamples; ++i) {
        const Vec3 at = start + upwind * (length * i / (kCourseSamples - 1));
        const double clear = std::exp(-field.DepthAlong(at, to_sun.xyz, 0.0));
        sun.push_back(std::clamp(clear + noise * own.Normal(), 0.0, 1.0));
      }
      draw.numbers = NumbersOf(sun);
    });
  }
  for (std::size_t n = 0; n < kCourseNumbers; ++n) {
    double sum = 0.0, squares = 0.0;
    for (const Draw& draw : draws_) {
      sum += draw.numbers[n];
      squares += draw.numbers[n] * draw.numbers[n];
    }
    const auto count = static_cast<double>(draws_.size());
    scales_[n] = std::sqrt(std::max(1e-12, squares / count - sum * sum / (count * count)));
  }
}

LayerPosterior LayerDraws::Posterior(const CourseNumbers& observed) const {
  std::vector<std::pair<double, std::size_t>> distances;
  distances.reserve(draws_.size());
  for (std::size_t i = 0; i < draws_.size(); ++i) {
    double sum = 0.0;
    for (std::size_t n = 0; n < kCourseNumbers; ++n) {
      const double off = (draws_[i].numbers[n] - observed[n]) / scales_[n];
      sum += off * off;
    }
    distances.emplace_back(sum, i);
  }
  std::nth_element(distances.begin(), distances.begin() + kNearest, distances.end());
  const double farthest = std::max(1e-12, distances[kNearest].first);
  distances.resize(kNearest);
  std::sort(distances.begin(), distances.end());
  LayerPosterior posterior;
  posterior.draws.reserve(kNearest);
  for (const auto& [square, i] : distances) {
    posterior.draws.push_back(draws_[i].layer);
    posterior.draws.back().weight = std::max(1e-6, 1.0 - square / farthest);
  }
  posterior.cover = Range(posterior.draws, &LayerDraw::cover);
  posterior.optical_depth = Range(posterior.draws, &LayerDraw::optical_depth);
  posterior.cells = Range(posterior.draws, &LayerDraw::cells);
  return posterior;
}

}  // namespace pleinair::clouds
