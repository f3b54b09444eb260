#pragma once

#include <array>
#include <memory>

#include "tests/tracker/marker_rendering.h"
#include "tracker/alignment/block_fit.h"

namespace pleinair::tracker {

/// A camera of 320×240 pixels, with or without lens distortion.
CameraModel SceneCamera(bool bent);

/// Homography to the marker's modules from the corners of its square.
Mat3 ModulesFromCorners(const MarkerPattern& marker_pattern, const std::array<Vec2, 4>& corners);
/// The corners from that homography.
std::array<Vec2, 4> CornersOf(const MarkerPattern& marker_pattern,
                              const Mat3& modules_from_undistorted);

/// A marker near the centre of a rendered image, and the window around it.
struct AlignmentScene {
  CameraModel camera;
  std::unique_ptr<LensGrid> lens;
  RenderedMarker marker;
  GreyImage image;
  std::array<Vec2, 4> truth;  ///< True corners in pixels.
  PixelWindow window;

  const MarkerPattern& marker_pattern() const { return *marker.pattern; }
  /// A guess with every corner displaced by `off_px`, each in another direction.
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
