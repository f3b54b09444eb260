#include "compositor/photometry/heading_from_shadows.h"

#include <algorithm>
#include <cmath>

#include "compositor/photometry/shadow_regression.h"

namespace pleinair::compositor {
namespace {

constexpr double kCoarseStep_deg = 0.75, kFineStep_deg = 0.125, kFineReach_deg = 1.5;
constexpr double kMaxUncertainty_deg = 1.0;
// Error of the marker's attitude beside the phantoms, which all edges share: 0.9 mrad, about that
// of a pose in a small image. Below a high sun it turns shadows far.
constexpr double kTilt_deg = 0.05;
constexpr int kMinCells = 4;

std::vector<Vec3> SunsAt(Vec3 to_sun, Vec3 up, const std::vector<double>& headings_deg) {
  std::vector<Vec3> suns;
  suns.reserve(headings_deg.size());
  for (const double heading : headings_deg) {
    suns.push_back(Turned(to_sun, up, FromDegrees(heading)));
  }
  return suns;
}

}  // namespace

Vec3 Turned(Vec3 direction, Vec3 unit_axis, Radians angle) {
  // Rodrigues' formula.
  const double c = std::cos(angle.value()), s = std::sin(angle.value());
  return direction * c + Cross(unit_axis, direction) * s +
         unit_axis * (Dot(unit_axis, direction) * (1 - c));
}

std::optional<HeadingEstimate> EstimateHeading(const PhantomRays& phantoms,
                                               const SurfaceSamples& samples, Vec3 up,
                                               Vec3 to_sun) {
  if (Dot(up, to_sun) <= 0.0) return std::nullopt;
  const ShadowRegression regression(phantoms, samples);
  const std::vector<double> coarse =
      EvenSteps(-kMaxHeadingError_deg - kFineReach_deg, kMaxHeadingError_deg + kFineReach_deg,
                kCoarseStep_deg);
  const std::vector<Vec3> coarse_suns = SunsAt(to_sun, up, coarse);
  const std::vector<BrightnessCell> cells =
      regression.Crossed(BrightnessCellsOf(samples, to_sun), coarse_suns);
  if (static_cast<int>(cells.size()) < kMinCells) return std::nullopt;
  const double about =
      BestOf(regression.FitAll(cells, coarse_suns), coarse, GroupedShadowFit::kAll).value;
  const std::vector<double> fine =
      EvenSteps(about - kFineReach_deg, about + kFineReach_deg, kFineStep_deg);
  const auto best = SignificantOf(regression.FitAll(cells, SunsAt(to_sun, up, fine)), fine);
  if (!best || best->error > kMaxUncertainty_deg || std::fabs(best->value) > kMaxHeadingError_deg) {
    return std::nullopt;
  }
  double variance = 0.0;
  for (const BrightnessCell& cell : cells) variance += VarianceOf(cell);
  const double sine = std::min(1.0, Dot(Normalized(up), Normalized(to_sun)));
  const double tilt_deg = kTilt_deg * sine / std::sqrt(std::max(1e-6, 1.0 - sine * sine));
  return HeadingEstimate{
      .offset = FromDegrees(best->value),
      .uncertainty = FromDegrees(std::hypot(best->error, tilt_deg)),
      .contrast = best->fit.Contrast(),
      .cells = best->fit.cells,
      .explained_share = variance > 0.0 ? best->fit.Explained() / variance : 0.0};
}

}  // namespace pleinair::compositor
