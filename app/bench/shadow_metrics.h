#pragma once

#include <vector>

#include "shadows/bench/bench_renderer.h"
#include "shadows/bench/bench_scene.h"

namespace pleinair::app {

/// Errors of a picture of visibilities against the truth, over the pixels where both see the same
/// surface.
struct ShadowErrors {
  double rmse = 0.0;            ///< All pixels with a surface.
  double penumbra_rmse = 0.0;   ///< Where 0.01 < truth < 0.99.
  double bias = 0.0;            ///< Mean of result − truth.
  double leak_mean = 0.0;       ///< Mean result where truth < 0.001.
  double leak_p99 = 0.0;        ///< Its 99th percentile there.
  double over_darkening = 0.0;  ///< Mean 1 − result where truth > 0.999.
  int pixels = 0, penumbra_pixels = 0, dark_pixels = 0;
};
/// Whether both see the same surface in a pixel (depth 0: none).
bool IsCompared(double result_depth_m, double truth_depth_m);
/// `left_out`, where given: pixels in which it is not 0 do not count.
ShadowErrors CompareVisibility(const shadows::VisibilityPicture& result,
                               const shadows::VisibilityPicture& truth,
                               const Image<float>* left_out = nullptr);

/// Share of the sun's disc that a straight edge along x at `edge` leaves a point of the ground:
/// V(u) = ½ + (u√(1−u²) + asin u)/π with u = Δy s_z² / (h √(s_y²+s_z²) tan 0.2665°), Δy counted
/// from the shadow's geometric edge towards its lit side.
double StraightEdgeTruth(const shadows::StraightEdge& edge, const glm::dvec3& to_sun, double y);
/// Where that shadow's geometric edge lies on the ground, and half its penumbra's width there.
double EdgeShadowY(const shadows::StraightEdge& edge, const glm::dvec3& to_sun);
double EdgeHalfWidth(const shadows::StraightEdge& edge, const glm::dvec3& to_sun);

/// One profile across a straight edge's shadow.
struct EdgeProfile {
  double height_m = 0.0;
  double width_ratio = 0.0;  ///< Distance from V = 0.1 to 0.9 over the closed form's.
  double offset_m = 0.0;     ///< Where V = ½ lies, towards the lit side of the truth.
  double rmse = 0.0;         ///< Against the closed form over twice the penumbra.
  double worst = 0.0;
  /// Standard deviation of where V = ½ lies along the edge: its stairs.
  double jaggedness_m = 0.0;
};

/// What can be measured where closed forms exist; from the maps as last drawn.
struct ClosedFormErrors {
  std::vector<EdgeProfile> edges;
  /// Of log(width) over log(height of the blocker); 1 is right, 0 a width that never changes.
  double width_slope = 0.0;
  double contact_gap_m = 0.0;  ///< Lit strip between a wall's foot and its shadow.
};
Result<ClosedFormErrors> MeasureClosedForms(const shadows::BenchScene& scene,
                                            shadows::BenchRenderer& renderer);

}  // namespace pleinair::app
