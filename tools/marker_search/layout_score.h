#pragma once

#include <memory>
#include <vector>

#include "tools/marker_search/marker_views.h"
#include "tracker/surf/descriptor_matcher.h"
#include "tracker/surf/surf.h"

namespace pleinair::marker_search {

/// How well a border is found, and why. Values are means over views. Descriptor distances are those
/// of unit descriptors.
struct LayoutScore {
  static constexpr int kSizes = 3, kTilts = 3;

  /// Objective of the search: mean over views of (average half + worst half) / 2. Each half counts
  /// with the probability (0…1) that its keypoints suffice.
  double total = 0.0;
  double average_half = 0.0, worst_half = 0.0;
  std::array<double, kSizes> by_size{};  ///< `total` of views below 60, 60…100, above 100 px.
  std::array<double, kTilts> by_tilt{};  ///< `total` of views below 40°, 40…60°, above 60°.
  double keypoints = 0.0;                ///< Per query view, on the border.
  double repeatability = 0.0;            ///< Share of those that also occur in the template.
  double response = 0.0;                 ///< Median Hessian response of the repeated ones.
  double own_distance = 0.0;             ///< Median, to the nearest template at the same place.
  double other_distance = 0.0;  ///< Median, to the nearest template at another place on the border.
  double texture_distance = 0.0;  ///< Median, to the nearest texture descriptor.
  double worst_quadrant = 0.0;    ///< Repeated keypoints in the quadrant with the fewest.
};

/// Scores borders on rendered views. All borders share the same views, contents, surroundings and
/// noise, so that scores differ only by the border.
class LayoutScorer {
 public:
  /// `textures` must outlive the scorer.
  LayoutScorer(const std::vector<GreyImage>& textures, int views, std::uint64_t seed,
               float descriptor_window_scales);

  /// Scores a border on the first `views` views. Sizes, tilts and directions are evenly spread over
  /// any number of views.
  LayoutScore Score(const tracker::sg::Border& border, int views);
  int views() const { return static_cast<int>(pairs_.size()); }

 private:
  /// The view for the template, and the query view.
  struct Pair {
    MarkerView known, sought;
  };
  /// A keypoint on the border; lengths in modules where possible.
  struct BorderPoint {
    Vec2 modules;
    double scale_modules = 0.0, angle_rad = 0.0, response = 0.0;
    int pair = 0;
    /// Set for keypoints of query views only.
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
