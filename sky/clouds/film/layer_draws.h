#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/frames.h"
#include "sky/clouds/cloud_layer.h"

namespace pleinair::clouds {

/// What a course of sunlight at a place shows of a layer, whatever its phase.
inline constexpr std::size_t kCourseNumbers = 6;
using CourseNumbers = std::array<double, kCourseNumbers>;

/// Samples of a course, evenly spaced in time.
inline constexpr int kCourseSamples = 64;

/// Mean, share below 0.5, share between 0.1 and 0.9, logarithm of the crossings of 0.5, mean of
/// what lies below 0.5, and the root mean square of the steps. `sun`: kCourseSamples values.
CourseNumbers NumbersOf(const std::vector<double>& sun);

/// A layer that might have made a course.
struct LayerDraw {
  double cover = 0.5, optical_depth = 20.0;
  double cells = 1.0;  ///< Cells of the layer that pass in the course.
  double weight = 0.0;
};

/// A number with the range that holds 68 % of what might be.
struct FittedNumber {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// The layers that explain a course.
struct LayerPosterior {
  std::vector<LayerDraw> draws;  ///< The likeliest first.
  FittedNumber cover, optical_depth, cells;
};

/// Courses of sunlight below random layers of a kind: cover 0.02…0.98, optical depth from a quarter
/// to four times that of the kind, 0.1 to 30 cells in the course (both even in the logarithm). The
/// wind blows from a given azimuth, or from anywhere.
///
/// Posterior() is approximate Bayesian computation (Beaumont, Zhang & Balding 2002): the draws
/// whose NumbersOf() are nearest to the observed ones, weighted by Epanechnikov's kernel. Their
/// spread is the uncertainty, that of the short course included.
class LayerDraws {
 public:
  /// Takes some 5 s. `noise`: standard deviation of the observed course. The result depends on the
  /// arguments alone.
  LayerDraws(CloudKind kind, Direction<World> to_sun, std::optional<double> wind_from_deg,
             double noise);

  LayerPosterior Posterior(const CourseNumbers& observed) const;

 private:
  struct Draw {
    LayerDraw layer;
    CourseNumbers numbers;
  };
  std::vector<Draw> draws_;
  CourseNumbers scales_{};  ///< Standard deviation of each number over all draws.
};

}  // namespace pleinair::clouds
