#include "compositor/photometry/sun_sky_ratio.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "base/parallel_for.h"
#include "base/quantile.h"
#include "compositor/light/sampling.h"
#include "compositor/light/scaled_sky.h"
#include "compositor/photometry/sample_medians.h"
#include "compositor/photometry/shadow_side.h"

namespace pleinair::compositor {
namespace {

constexpr double kGrazing = 0.1;
constexpr int kMinSurfaceSamples = 5;  // Per side.
constexpr std::size_t kMaxEdges = 120;
constexpr std::uint32_t kPaths = 384;
// Uncertainty of one edge due to a material's own pattern, for any number of surface samples.
constexpr double kPatternNoise = 0.05;
// Uncertainty due to unmodelled geometry (leaves, small objects) and due to described colors.
constexpr double kModelNoise = 0.10;
// Minimum predicted step of edges that are used.
constexpr double kMinStep = 0.25;
// Minimum step: a quarter of the predicted one, and 2.5 standard deviations of the noise.
constexpr double kStepShare = 0.25, kStepSigmas = 2.5;
// Maximum weighted share of edges with a step for a hidden sun.
constexpr double kNoSunShare = 0.12;
constexpr int kMinEdgesForSun = 3;
constexpr double kAgreement = 0.35;
// Maximum logarithmic deviation of an edge's color step from that of the others.
constexpr double kMaxColorOffset = 0.12;
constexpr int kGroups = 8;

using Rgb = std::array<double, 3>;
Rgb ToArray(LinearRgb c) { return {c.r, c.g, c.b}; }

struct Candidate {
  std::vector<std::uint32_t> lit, shaded;
  std::size_t Size() const { return std::min(lit.size(), shaded.size()); }
};

std::vector<Candidate> Candidates(const PhantomRays& phantoms, const SurfaceSamples& samples,
                                  const TangentFrame& sun) {
  const auto& all = samples.samples();
  std::vector<ShadowSide> sides(all.size(), ShadowSide::kNeither);
  // Cells without a shadow boundary need no close test.
  std::vector<std::uint8_t> seen(samples.cells());
  std::vector<std::uint8_t> sun_visible(all.size());
  ParallelFor(all.size(), 0, [&](std::size_t i) {
    sun_visible[i] = phantoms.IsUnoccluded(all[i].point, sun.normal) ? 1 : 2;
  });
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].frames > 0) seen[all[i].cell] |= sun_visible[i];
  }
  ParallelFor(all.size(), 0, [&](std::size_t i) {
    if (seen[all[i].cell] == 3 && all[i].frames > 0 && Dot(all[i].normal, sun.normal) >= kGrazing) {
      sides[i] = ShadowSideOf(phantoms, all[i], sun);
    }
  });
  std::vector<Candidate> cells(samples.cells());
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (sides[i] == ShadowSide::kLit) cells[all[i].cell].lit.push_back(i);
    if (sides[i] == ShadowSide::kShaded) cells[all[i].cell].shaded.push_back(i);
  }
  std::erase_if(cells, [](const Candidate& cell) { return cell.Size() < kMinSurfaceSamples; });
  std::stable_sort(cells.begin(), cells.end(),
                   [](const Candidate& a, const Candidate& b) { return a.Size() > b.Size(); });
  if (cells.size() > kMaxEdges) cells.resize(kMaxEdges);
  return cells;
}

double Mean(LinearRgb c) { return (c.r + c.g + c.b) / 3; }

/// Deviation of an edge's colors from the model: red and blue relative to green.
std::array<double, 2> ColorOff(const ShadowEdge& edge) {
  const LinearRgb predicted = edge.Predicted({1, 1, 1});
  return {edge.contrast.r - edge.contrast.g - (predicted.r - predicted.g),
          edge.contrast.b - edge.contrast.g - (predicted.b - predicted.g)};
}

/// Selects edges with the same material on both sides. A mortar joint along an edge, for example,
/// changes the color differently from all other edges.
std::vector<std::uint8_t> OfOneMaterial(const std::vector<ShadowEdge>& edges,
                                        const std::vector<std::uint8_t>& telling) {
  std::array<std::vector<double>, 2> off;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (telling[i] == 0) continue;
    for (const int k : {0, 1}) off[k].push_back(ColorOff(edges[i])[k]);
  }
  std::vector<std::uint8_t> good = telling;
  if (off[0].empty()) return good;
  const std::array<double, 2> usual{Median(off[0]), Median(off[1])};
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (const int k : {0, 1}) {
      const double limit = kMaxColorOffset + edges[i].uncertainty;
      if (std::fabs(ColorOff(edges[i])[k] - usual[k]) > limit) good[i] = 0;
    }
  }
  return good;
}

/// Finds the logarithmic sky radiance scale of one channel that minimises the cost of measured
/// minus predicted contrast over the used edges. The fixed grid avoids local minima.
double FitScale(const std::vector<ShadowEdge>& edges, const std::vector<std::uint8_t>& used,
                int channel) {
  double best_log = 0.0, minimum = 1e300;
  const auto cost_at = [&](double log_scale) {
    const double scale = std::exp(log_scale);
    double cost = 0.0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (used[i] == 0) continue;
      const double difference = ToArray(edges[i].contrast)[channel] -
                                ToArray(edges[i].Predicted({scale, scale, scale}))[channel];
      // Huber cost: quadratic within the noise, linear beyond.
      const double sigma = std::hypot(edges[i].uncertainty, kModelNoise);
      const double t = std::fabs(difference) / sigma;
      cost += t < 1.0 ? 0.5 * t * t : t - 0.5;
    }
    return cost;
  };
  const auto search = [&](double from, double to, double step) {
    const int steps = static_cast<int>(std::lround((to - from) / step));
    for (int i = 0; i <= steps; ++i) {
      const double log_scale = from + i * step;
      const double cost = cost_at(log_scale);
      if (cost < minimum) {
        minimum = cost;
        best_log = log_scale;
      }
    }
  };
  search(-2.0, 3.5, 0.1);
  const double about = best_log;
  search(about - 0.1, about + 0.1, 0.005);
  return best_log;
}

}  // namespace

LinearRgb ShadowEdge::Predicted(LinearRgb sky_radiance_scale) const {
  const LinearRgb lit = sky_lit * sky_radiance_scale + reflected_lit + sun;
  const LinearRgb shaded = sky_shaded * sky_radiance_scale + reflected_shaded;
  return {std::log(lit.r / shaded.r), std::log(lit.g / shaded.g), std::log(lit.b / shaded.b)};
}

std::vector<ShadowEdge> FindShadowEdges(const PhantomRays& phantoms, const SurfaceSamples& samples,
                                        const sky::SkyModel& day, const Mat3& marker_from_world) {
  const Vec3 to_sun = marker_from_world * day.ToSun().xyz;
  if (day.ToSun().xyz.z <= 0.0) return {};
  const std::vector<Candidate> candidates =
      Candidates(phantoms, samples, TangentFrame(Normalized(to_sun)));
  std::vector<ShadowEdge> edges(candidates.size());
  // By plane, because ambient light is evaluated per plane.
  std::map<std::array<double, 3>, std::vector<std::size_t>> by_normal;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Vec3 n = samples.samples()[candidates[i].lit.front()].normal;
    by_normal[{n.x, n.y, n.z}].push_back(i);
    Rgb contrast{};
    for (int c = 0; c < 3; ++c) {
      contrast[c] = MedianBrightness(samples, candidates[i].lit, c).first -
                    MedianBrightness(samples, candidates[i].shaded, c).first;
    }
    edges[i].contrast = {contrast[0], contrast[1], contrast[2]};
    edges[i].uncertainty = std::sqrt(MedianBrightness(samples, candidates[i].lit, -1).second +
                                     MedianBrightness(samples, candidates[i].shaded, -1).second +
                                     kPatternNoise * kPatternNoise);
  }
  const ScaledSky sky_alone(day, {1, 1, 1}, {});
  const ScaledSky sun_alone(day, {}, {1, 1, 1});
  for (const auto& [n, members] : by_normal) {
    const Vec3 normal{n[0], n[1], n[2]};
    std::vector<Point<Marker>> points;
    for (const std::size_t i : members) {
      points.push_back(MiddleOf(samples, candidates[i].lit));
      points.push_back(MiddleOf(samples, candidates[i].shaded));
    }
    const auto sky = phantoms.Ambient(points, normal, sky_alone, marker_from_world, kPaths);
    const auto reflected = phantoms.Ambient(points, normal, sun_alone, marker_from_world, kPaths);
    for (std::size_t k = 0; k < members.size(); ++k) {
      ShadowEdge& edge = edges[members[k]];
      edge.sky_lit = sky[2 * k];
      edge.sky_shaded = sky[2 * k + 1];
      edge.reflected_lit = reflected[2 * k];
      edge.reflected_shaded = reflected[2 * k + 1];
      edge.sun = day.SunNormalIrradiance() * std::max(0.0, Dot(normal, to_sun));
    }
  }
  std::erase_if(edges, [](const ShadowEdge& edge) {
    const LinearRgb dark = edge.sky_shaded;
    return !(dark.r > 0.0 && dark.g > 0.0 && dark.b > 0.0);
  });
  return edges;
}

SunSkyRatio EstimateSunSkyRatio(const std::vector<ShadowEdge>& edges) {
  SunSkyRatio estimate;
  // A sky so strong that the sun is negligible: only the corners' ambient occlusion remains.
  constexpr LinearRgb kSkyAlone{1e6, 1e6, 1e6};
  std::vector<double> without_sun(edges.size()), predicted(edges.size());
  std::vector<std::uint8_t> steps(edges.size()), telling(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    without_sun[i] = Mean(edges[i].Predicted(kSkyAlone));
    predicted[i] = Mean(edges[i].Predicted({1, 1, 1})) - without_sun[i];
    telling[i] = predicted[i] >= kMinStep ? 1 : 0;
  }
  telling = OfOneMaterial(edges, telling);
  double all = 0.0, with = 0.0, against = 0.0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (telling[i] == 0) continue;
    const double sigma = std::hypot(edges[i].uncertainty, kModelNoise);
    const double weight = 1.0 / (sigma * sigma);
    const double step = Mean(edges[i].contrast) - without_sun[i];
    const double threshold =
        std::max(kStepShare * predicted[i], kStepSigmas * edges[i].uncertainty);
    steps[i] = step > threshold ? 1 : 0;
    ++estimate.edges;
    all += weight;
    with += step > threshold ? weight : 0.0;
    against += step < -threshold ? weight : 0.0;
  }
  if (estimate.edges == 0) return estimate;
  estimate.share_with_contrast = (with - against) / all;
  const auto stepping = std::count(steps.begin(), steps.end(), 1);
  if (estimate.share_with_contrast < kNoSunShare && estimate.edges >= kMinEdgesForNoSun) {
    estimate.sun = SunSkyRatio::Sun::kHidden;
    estimate.agreeing = estimate.edges - static_cast<int>(stepping);
    return estimate;
  }
  if (estimate.share_with_contrast < kSunShare || stepping < kMinEdgesForSun) return estimate;

  // Edges without a step lie in another object's shadow. The remaining edges count if they agree
  // with the scale that most of them share.
  const double log_about = FitScale(edges, steps, 1);
  const double about = std::exp(log_about);
  std::vector<std::uint8_t> used(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const double off = edges[i].contrast.g - edges[i].Predicted({about, about, about}).g;
    used[i] = steps[i] != 0 && std::fabs(off) < kAgreement + edges[i].uncertainty ? 1 : 0;
  }
  estimate.agreeing = static_cast<int>(std::count(used.begin(), used.end(), 1));
  if (estimate.agreeing < kMinEdgesForSun) return estimate;
  estimate.sun = SunSkyRatio::Sun::kShines;
  estimate.sky_radiance_scale = {std::exp(FitScale(edges, used, 0)),
                                 std::exp(FitScale(edges, used, 1)),
                                 std::exp(FitScale(edges, used, 2))};
  // Jackknife over an eighth of the edges each.
  std::array<double, kGroups> logs{};
  double sum = 0.0;
  for (int g = 0; g < kGroups; ++g) {
    std::vector<std::uint8_t> left = used;
    for (std::size_t i = g; i < left.size(); i += kGroups) left[i] = 0;
    const bool empty = std::find(left.begin(), left.end(), 1) == left.end();
    logs[g] = empty ? std::log(estimate.sky_radiance_scale.g) : FitScale(edges, left, 1);
    sum += logs[g];
  }
  double spread = 0.0;
  for (const double value : logs) spread += std::pow(value - sum / kGroups, 2);
  // Errors common to all edges do not show in their spread.
  constexpr double kCommonDoubt = 0.05;
  estimate.log_uncertainty =
      std::sqrt(spread * (kGroups - 1.0) / kGroups + kCommonDoubt * kCommonDoubt);
  return estimate;
}

}  // namespace pleinair::compositor
