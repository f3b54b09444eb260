#include "app/bench/shadow_metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleinair::app {
namespace {

double Segment(double u) {
  const double x = std::clamp(u, -1.0, 1.0);
  return 0.5 + (x * std::sqrt(1.0 - x * x) + std::asin(x)) / std::numbers::pi;
}

// Inverse of Segment(), by bisection.
double SegmentInverse(double share) {
  double low = -1.0, high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (Segment(middle) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// First position where a rising profile reaches a value, in steps of the profile.
double Crossing(const std::vector<double>& profile, double value) {
  for (std::size_t i = 1; i < profile.size(); ++i) {
    if (profile[i] < value) continue;
    const double rise = profile[i] - profile[i - 1];
    return static_cast<double>(i) - (rise > 0.0 ? (profile[i] - value) / rise : 0.0);
  }
  return static_cast<double>(profile.size());
}

}  // namespace

bool IsCompared(double result_depth_m, double truth_depth_m) {
  return truth_depth_m > 0.0 && std::abs(result_depth_m - truth_depth_m) <= 0.01 * truth_depth_m;
}

ShadowErrors CompareVisibility(const shadows::VisibilityPicture& result,
                               const shadows::VisibilityPicture& truth,
                               const Image<float>* left_out) {
  ShadowErrors errors;
  std::vector<float> leaks;
  int lit = 0;
  for (std::size_t i = 0; i < truth.visibility.size(); ++i) {
    const double depth = truth.depth_m.data()[i];
    if (!IsCompared(result.depth_m.data()[i], depth)) continue;
    if (left_out != nullptr && left_out->data()[i] != 0.0F) continue;
    const double t = truth.visibility.data()[i], v = result.visibility.data()[i];
    const double difference = v - t;
    errors.rmse += difference * difference;
    errors.bias += difference;
    ++errors.pixels;
    if (t < 0.001) {
      errors.leak_mean += v;
      leaks.push_back(static_cast<float>(v));
    } else if (t > 0.999) {
      errors.over_darkening += 1.0 - v;
      ++lit;
    }
    if (t > 0.01 && t < 0.99) {
      errors.penumbra_rmse += difference * difference;
      ++errors.penumbra_pixels;
    }
  }
  const auto mean = [](double sum, int count) { return count > 0 ? sum / count : 0.0; };
  errors.rmse = std::sqrt(mean(errors.rmse, errors.pixels));
  errors.bias = mean(errors.bias, errors.pixels);
  errors.penumbra_rmse = std::sqrt(mean(errors.penumbra_rmse, errors.penumbra_pixels));
  errors.dark_pixels = static_cast<int>(leaks.size());
  errors.leak_mean = mean(errors.leak_mean, errors.dark_pixels);
  errors.over_darkening = mean(errors.over_darkening, lit);
  if (!leaks.empty()) {
    const auto p99 = leaks.begin() + static_cast<std::ptrdiff_t>(0.99 * (leaks.size() - 1));
    std::nth_element(leaks.begin(), p99, leaks.end());
    errors.leak_p99 = *p99;
  }
  return errors;
}

double EdgeShadowY(const shadows::StraightEdge& edge, const glm::dvec3& to_sun) {
  return edge.middle.y - edge.middle.z * to_sun.y / to_sun.z;
}

double EdgeHalfWidth(const shadows::StraightEdge& edge, const glm::dvec3& to_sun) {
  return edge.middle.z * std::hypot(to_sun.y, to_sun.z) / (to_sun.z * to_sun.z) *
         std::tan(shadows::kSunAngularRadius.value());
}

double StraightEdgeTruth(const shadows::StraightEdge& edge, const glm::dvec3& to_sun, double y) {
  return Segment(edge.lit_side_y * (y - EdgeShadowY(edge, to_sun)) / EdgeHalfWidth(edge, to_sun));
}

Result<ClosedFormErrors> MeasureClosedForms(const shadows::BenchScene& scene,
                                            shadows::BenchRenderer& renderer) {
  constexpr int kSteps = 800, kRows = 24;
  ClosedFormErrors errors;
  double sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0;
  for (const shadows::StraightEdge& edge : scene.edges) {
    const double half = EdgeHalfWidth(edge, scene.to_sun);
    const double middle_y = EdgeShadowY(edge, scene.to_sun);
    const double middle_x = edge.middle.x - edge.middle.z * scene.to_sun.x / scene.to_sun.z;
    // Includes the penumbra of the coarsest maps.
    const double reach = std::max(4.0 * half, 0.15);
    const double step = 2.0 * reach / kSteps;
    const shadows::ProbeGrid grid{
        {middle_x - 0.5 * edge.length, middle_y - edge.lit_side_y * reach, 0.0},
        {edge.length / kRows, 0.0, 0.0},
        {0.0, edge.lit_side_y * step, 0.0},
        {0.0, 0.0, 1.0},
        kRows,
        kSteps};
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<float> values, renderer.Probe(grid));
    EdgeProfile result;
    result.height_m = edge.middle.z;
    int near = 0;
    std::vector<double> lows, highs, middles;
    for (int column = 0; column < kRows; ++column) {
      std::vector<double> profile(kSteps);
      for (int i = 0; i < kSteps; ++i) {
        profile[i] = values[static_cast<std::size_t>(i) * kRows + column];
        const double y = grid.At(column, i).y;
        if (std::abs(y - middle_y) > 2.0 * half) continue;
        const double error = profile[i] - StraightEdgeTruth(edge, scene.to_sun, y);
        result.rmse += error * error;
        result.worst = std::max(result.worst, std::abs(error));
        ++near;
      }
      lows.push_back(Crossing(profile, 0.1));
      middles.push_back(Crossing(profile, 0.5));
      highs.push_back(Crossing(profile, 0.9));
    }
    const auto mean = [](const std::vector<double>& v) {
      double sum = 0.0;
      for (const double x : v) sum += x;
      return sum / static_cast<double>(v.size());
    };
    result.rmse = std::sqrt(result.rmse / std::max(near, 1));
    const double width = (mean(highs) - mean(lows)) * step;
    result.width_ratio = width / (2.0 * SegmentInverse(0.9) * half);
    const double middle_row = mean(middles);
    result.offset_m = (middle_row + 0.5) * step - reach;
    double squares = 0.0;
    for (const double middle : middles) squares += (middle - middle_row) * (middle - middle_row);
    result.jaggedness_m = std::sqrt(squares / kRows) * step;
    errors.edges.push_back(result);
    const double x = std::log(edge.middle.z), y = std::log(std::max(width, 1e-6));
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  const auto count = static_cast<double>(scene.edges.size());
  if (count > 1.0) {
    errors.width_slope = (count * sum_xy - sum_x * sum_y) / (count * sum_xx - sum_x * sum_x);
  }
  for (const shadows::ContactEdge& contact : scene.contacts) {
    // Steps of half a millimetre from the base outwards; the first dark point ends the gap.
    constexpr double kStepM = 0.0005;
    const shadows::ProbeGrid grid{contact.middle - glm::dvec3(0.5 * contact.length, 0.0, 0.0),
                                  {contact.length / kRows, 0.0, 0.0},
                                  {0.0, contact.away_y * kStepM, 0.0},
                                  {0.0, 0.0, 1.0},
                                  kRows,
                                  400};
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<float> values, renderer.Probe(grid));
    double sum = 0.0;
    for (int column = 0; column < kRows; ++column) {
      int i = 0;
      while (i < grid.height && values[static_cast<std::size_t>(i) * kRows + column] > 0.5F) ++i;
      sum += i * kStepM / kRows;
    }
    errors.contact_gap_m = std::max(errors.contact_gap_m, sum);
  }
  return errors;
}

}  // namespace pleinair::app
