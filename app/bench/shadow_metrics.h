#pragma once

#include <vector>

#include "shadows/bench/bench_renderer.h"
#include "shadows/bench/bench_scene.h"

namespace pleinair::app {

/// Errors of a visibility image against the ground truth, over the pixels where both show the same
/// surface.
struct ShadowErrors {
  double rmse = 0.0;            ///< All pixels with a surface.
  double penumbra_rmse = 0.0;   ///< Where 0.01 < truth < 0.99.
  double bias = 0.0;            ///< Mean of result − truth.
  double leak_mean = 0.0;       ///< Mean result where truth < 0.001.
  double leak_p99 = 0.0;        ///< 99th percentile of the result there.
  double over_darkening = 0.0;  ///< Mean 1 − result where truth > 0.999.
  int pixels = 0, penumbra_pixels = 0, dark_pixels = 0;
};
/// True if both show the same surface in a pixel (depth 0: none).
bool IsCompared(double result_depth_m, double truth_depth_m);
/// `left_out`, if not null: pixels with values other than 0 are ignored.
ShadowErrors CompareVisibility(const shadows::VisibilityPicture& result,
                               const shadows::VisibilityPicture& truth,
                               const Image<float>* left_out = nullptr);

/// Visible share of the sun's disc at a ground point, for a straight edge along x at `edge`:
/// V(u) = ½ + (u√(1−u²) + asin u)/π with u = Δy s_z² / (h √(s_y²+s_z²) tan 0.2665°).
/// Δy is the distance from the shadow's geometric edge towards its lit side.
double StraightEdgeTruth(const shadows::StraightEdge& edge, const glm::dvec3& to_sun, double y);
/// Position of that shadow's geometric edge on the ground, and half the width of its penumbra
/// there.
double EdgeShadowY(const shadows::StraightEdge& edge, const glm::dvec3& to_sun);
double EdgeHalfWidth(const shadows::StraightEdge& edge, const glm::dvec3& to_sun);

/// Mean profile across the shadow of a straight edge.
struct EdgeProfile {
  double height_m = 0.0;
  double width_ratio = 0.0;  ///< Distance from V = 0.1 to 0.9, relative to the closed form's.
  double offset_m = 0.0;     ///< Position of V = ½, towards the lit side of the ground truth.
  double rmse = 0.0;         ///< Against the closed form over twice the penumbra.
  double worst = 0.0;
  /// Standard deviation of the position of V = ½ along the edge (aliasing).
  double jaggedness_m = 0.0;
};

/// Measurements where closed forms exist, from the maps as last drawn.
struct ClosedFormErrors {
  std::vector<EdgeProfile> edges;
  /// Slope of log(width) over log(height of the occluder): 1 is correct, 0 means a constant width.
  double width_slope = 0.0;
  double contact_gap_m = 0.0;  ///< Lit strip between a wall's base and its shadow.
};
Result<ClosedFormErrors> MeasureClosedForms(const shadows::BenchScene& scene,
                                            shadows::BenchRenderer& renderer);

}  // namespace pleinair::app
