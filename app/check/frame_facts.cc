#include "app/check/frame_facts.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/project/film_look.h"
#include "compositor/picture/blur_estimate.h"
#include "compositor/picture/marker_in_image.h"

namespace pleinair::app {
namespace {

double MiddleOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Light of the white around the black square, and how much of it is clipped.
void MeasureWhite(const compositor::MarkerInImage& marker, FrameFacts* facts) {
  constexpr int kPerSide = 16;
  const double half_m = 0.5 * (marker.marker().size_m + marker.white_m());
  std::vector<double> light;
  int clipped = 0;
  for (int i = 0; i < kPerSide; ++i) {
    const double along_m = half_m * (2.0 * (i + 0.5) / kPerSide - 1.0);
    for (const Vec2 place : {Vec2{along_m, half_m}, Vec2{along_m, -half_m}, Vec2{half_m, along_m},
                             Vec2{-half_m, along_m}}) {
      const auto pixel = marker.PixelOf(place);
      if (!pixel) continue;
      const auto x = static_cast<int>(std::lround(pixel->x));
      const auto y = static_cast<int>(std::lround(pixel->y));
      if (!marker.IsInside(x, y)) continue;
      light.push_back(marker.Grey(x, y));
      clipped += marker.IsClipped(x, y, 3) ? 1 : 0;
    }
  }
  if (light.empty()) return;
  facts->clipped_share = static_cast<double>(clipped) / static_cast<double>(light.size());
  facts->white = MiddleOf(std::move(light));
}

}  // namespace

FrameFacts MeasureFrame(const devices::Frame& frame, const tracker::MarkerObservation& seen,
                        const CameraModel& camera, const scene::MarkerReflectance& marker,
                        const CameraResponse& response) {
  FrameFacts facts;
  facts.index = frame.index;
  facts.edge_px = EdgeOf(seen.detection);
  facts.visible_fraction = seen.detection.visible_fraction;
  facts.ambiguity_ratio = seen.pose.ambiguity_ratio;
  facts.focal = FocalRatioFromSquare(camera, seen.detection.corners_px);
  if (marker.size_m <= 0.0) return facts;
  const compositor::MarkerInImage in_image(frame.rgb.view(), camera,
                                           seen.pose.best.camera_from_marker, marker, response);
  std::vector<double> blur_px = compositor::EstimateEdgeBlur(in_image);
  if (!blur_px.empty()) facts.blur_px = MiddleOf(std::move(blur_px));
  MeasureWhite(in_image, &facts);
  return facts;
}

}  // namespace pleinair::app
