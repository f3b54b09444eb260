#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {

/// Surface samples of one cell, as indices into the samples, with the logarithm of their brightness
/// relative to the cell's median. A cell is small and of one material.
struct BrightnessCell {
  std::vector<std::uint32_t> surface_samples;
  std::vector<double> brightness;
};

/// Cells with enough samples of surfaces that face the sun. A value far from the median is clamped:
/// it has another cause than sun and shade.
std::vector<BrightnessCell> BrightnessCellsOf(const SurfaceSamples& samples, Vec3 to_sun);

/// Sum of squared deviations from the cell's mean.
double VarianceOf(const BrightnessCell& cell);

/// Regression of brightness on sun visibility: sums of covariance and variance over cells.
struct ShadowFit {
  double covariance = 0.0, variance = 0.0;
  int cells = 0;  ///< With at least two samples on either side of a shadow boundary.

  void Add(const ShadowFit& other);
  ShadowFit Without(const ShadowFit& other) const;
  /// Mean step of the logarithm of light across the shadow boundaries.
  double Contrast() const { return variance > 0.0 ? covariance / variance : 0.0; }
  /// Part of the brightness' sum of squares that the step explains.
  double Explained() const { return covariance > 0.0 ? covariance * Contrast() : 0.0; }
};

/// The fit under one sun, in groups of cells for a jackknife (Efron 1982).
struct GroupedShadowFit {
  static constexpr int kGroups = 8;

  std::array<ShadowFit, kGroups> groups;

  ShadowFit Total() const;
  /// Without one group; kAll: of all.
  ShadowFit Without(int group) const;

  static constexpr int kAll = -1;
};

/// Spread of a result: `without` holds its values without each group.
double JackknifeError(const std::array<double, GroupedShadowFit::kGroups>& without);

/// Explains brightness by the shadows that phantoms cast under suns of several directions.
class ShadowRegression {
 public:
  /// Both must outlive this.
  ShadowRegression(const PhantomRays& phantoms, const SurfaceSamples& samples)
      : phantoms_(phantoms), samples_(samples) {}

  /// One fit for each direction to a sun, in the marker's frame.
  std::vector<GroupedShadowFit> FitAll(const std::vector<BrightnessCell>& cells,
                                       std::span<const Vec3> suns) const;

  /// Cells that contain a shadow boundary under some of the suns.
  std::vector<BrightnessCell> Crossed(std::vector<BrightnessCell> cells,
                                      std::span<const Vec3> suns) const;

 private:
  ShadowFit FitCell(const BrightnessCell& cell, Vec3 sun) const;

  const PhantomRays& phantoms_;
  const SurfaceSamples& samples_;
};

/// Value between steps that explains the brightness best, by a parabola through the best step and
/// its neighbours.
struct BestStep {
  std::size_t index = 0;  ///< The best step.
  double value = 0.0;
};

/// The best of evenly spaced steps, at least two. `left_out`: a group, or GroupedShadowFit::kAll.
BestStep BestOf(const std::vector<GroupedShadowFit>& fits, const std::vector<double>& steps,
                int left_out);

/// A step that explains brightness significantly.
struct SignificantStep {
  double value = 0.0, error = 0.0;  ///< One standard deviation, by the jackknife.
  ShadowFit fit;
};

/// The best of the steps. Nothing where its contrast is within four standard errors of none or
/// below 0.08, or too few cells have a boundary.
std::optional<SignificantStep> SignificantOf(const std::vector<GroupedShadowFit>& fits,
                                             const std::vector<double>& steps);

/// From, from + step, … to.
std::vector<double> EvenSteps(double from, double to, double step);

}  // namespace pleinair::compositor
