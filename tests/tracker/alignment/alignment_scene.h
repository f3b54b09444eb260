#pragma once

#include <array>
#include <memory>

#include "tests/tracker/marker_rendering.h"
#include "tracker/alignment/block_fit.h"

namespace pleinair::tracker {

/// A camera of 320×240 pixels, its lens bent or not.
CameraModel SceneCamera(bool bent);

/// Homography to modules of a print from where the corners of its square are.
Mat3 ModulesFromCorners(const MarkerPattern& marker_pattern, const std::array<Vec2, 4>& corners);
/// … and where they are.
std::array<Vec2, 4> CornersOf(const MarkerPattern& marker_pattern,
                              const Mat3& modules_from_undistorted);

/// A print near the middle of a rendered image, and the window that holds it.
struct AlignmentScene {
  CameraModel camera;
  std::unique_ptr<LensGrid> lens;
  RenderedMarker marker;
  GreyImage image;
  std::array<Vec2, 4> truth;  ///< Corners, in pixels.
  PixelWindow window;

  const MarkerPattern& marker_pattern() const { return *marker.pattern; }
  /// A guess with the corners off by `off_px` each along directions of their own.
  BlockFitState Guess(double off_px) const;
  std::array<Vec2, 4> Corners(const BlockFitState& state) const;
};

struct AlignmentView {
  double side_px = 120.0;
  bool bent = true;
  Radians tilt{0.5}, tilt_axis{0.4}, roll{0.3};
  Vec2 centre_px{158.0, 121.0};
};

AlignmentScene MakeScene(const AlignmentView& view, const RenderingOptions& options);

/// Fits the whole print, its blur and, if asked for, light's slope, from `state` on. `seen` and
/// `fit` are left for looking at. False where the fit fails.
bool FitWhole(const AlignmentScene& scene, ObservedPatch* observed, BlockFit* fit,
              BlockFitState* state, bool fit_light = false);

}  // namespace pleinair::tracker
