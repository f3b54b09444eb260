#pragma once

#include <memory>
#include <vector>

#include "tools/marker_search/marker_views.h"
#include "tracker/surf/descriptor_matcher.h"
#include "tracker/surf/surf.h"

namespace pleinair::marker_search {

/// How well a border is found, and why. Means over views; a keypoint's descriptor distances are of
/// unit descriptors.
struct LayoutScore {
  static constexpr int kSizes = 3, kTilts = 3;

  /// What the search maximises: mean over views of the mean of an average half and the worst half
  /// of the border, each as the chance (0…1) that its keypoints are enough.
  double total = 0.0;
  double average_half = 0.0, worst_half = 0.0;
  std::array<double, kSizes> by_size{};  ///< `total` of views below 60, 60…100, above 100 px.
  std::array<double, kTilts> by_tilt{};  ///< `total` of views below 40°, 40…60°, above 60°.
  double keypoints = 0.0;                ///< On the border in a view as it is sought.
  double repeatability = 0.0;            ///< Share of those that its template has, too.
  double response = 0.0;                 ///< Median Hessian response of those.
  double own_distance = 0.0;             ///< Median, to the nearest template of the right place.
  double other_distance = 0.0;           ///< Median, … of another place on the border.
  double texture_distance = 0.0;         ///< Median, to the nearest descriptor of textures.
  double worst_quadrant = 0.0;           ///< Repeated keypoints in the quadrant with fewest.
};

/// Scores borders on rendered views. All borders are seen in the same views, contents,
/// surroundings and noise, so that their scores differ by themselves only.
class LayoutScorer {
 public:
  /// `textures` outlive the scorer.
  LayoutScorer(const std::vector<GreyImage>& textures, int views, std::uint64_t seed,
               float descriptor_window_scales);

  /// On the first `views` of the views; sizes, tilts and directions are spread evenly over any
  /// number of them.
  LayoutScore Score(const tracker::sg::Border& border, int views);
  int views() const { return static_cast<int>(pairs_.size()); }

 private:
  /// The border as a template has it, and as it is then seen.
  struct Pair {
    MarkerView known, sought;
  };
  /// A keypoint on the border, in modules as far as can be.
  struct BorderPoint {
    Vec2 modules;
    double scale_modules = 0.0, angle_rad = 0.0, response = 0.0;
    int pair = 0;
    /// Filled in of those sought:
    bool repeated = false;
    double own = 0.0, other = 0.0, texture = 0.0;
  };
  struct Points {
    std::vector<BorderPoint> points;
    std::vector<tracker::QuantisedDescriptor> descriptors;
  };
  void See(const MarkerView& view, const tracker::sg::Border& border, int pair, Points* points);
  void Compare();
  double Worth(const BorderPoint& point) const;

  std::vector<Pair> pairs_;
  ViewRenderer renderer_;
  tracker::Surf surf_;
  tracker::DescriptorMatcher of_textures_, of_border_;
  GreyImage picture_;
  std::vector<tracker::SurfKeypoint> keypoints_;
  std::vector<tracker::SurfDescriptor> descriptors_;
  Points known_, sought_;
  std::vector<tracker::DescriptorMatch> nearest_, back_;
};

}  // namespace pleinair::marker_search
