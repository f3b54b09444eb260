#include "tests/tracker/alignment/alignment_scene.h"

#include <algorithm>
#include <cmath>

#include "tracker/pose/homography.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::tracker {

CameraModel SceneCamera(bool bent) {
  CameraModel camera;
  camera.width = 320;
  camera.height = 240;
  camera.fx = camera.fy = 400.0;
  camera.cx = 160.3;
  camera.cy = 119.8;
  if (bent) camera.distortion[0] = -0.2;
  return camera;
}

Mat3 ModulesFromCorners(const MarkerPattern& marker_pattern, const std::array<Vec2, 4>& corners) {
  const double half = 0.5 * marker_pattern.edge_modules, middle = 0.5 * marker_pattern.modules;
  return Mat3{{half, 0, middle, 0, -half, middle, 0, 0, 1}} * Adjugate(HomographyToQuad(corners));
}

std::array<Vec2, 4> CornersOf(const MarkerPattern& marker_pattern,
                              const Mat3& modules_from_undistorted) {
  const double half = 0.5 * marker_pattern.edge_modules, middle = 0.5 * marker_pattern.modules;
  std::array<Vec2, 4> corners;
  for (int i = 0; i < 4; ++i) {
    corners[i] = Apply(Adjugate(modules_from_undistorted),
                       {middle + half * kSquareCorners[i].x, middle - half * kSquareCorners[i].y});
  }
  return corners;
}

BlockFitState AlignmentScene::Guess(double off_px) const {
  std::array<Vec2, 4> corners;
  for (int i = 0; i < 4; ++i) {
    const double angle = 1.0 + 2.3 * i;
    corners[i] = lens->Undistort(truth[i].x + off_px * std::cos(angle),
                                 truth[i].y + off_px * std::sin(angle));
  }
  return {ModulesFromCorners(marker_pattern(), corners), 0.7};
}

std::array<Vec2, 4> AlignmentScene::Corners(const BlockFitState& state) const {
  std::array<Vec2, 4> corners = CornersOf(marker_pattern(), state.modules_from_undistorted);
  for (Vec2& corner : corners) corner = lens->PixelOfUndistorted(corner);
  return corners;
}

AlignmentScene MakeScene(const AlignmentView& view, const RenderingOptions& options) {
  AlignmentScene scene;
  scene.camera = SceneCamera(view.bent);
  scene.lens = std::make_unique<LensGrid>(scene.camera);
  scene.marker.pattern = std::make_shared<MarkerPattern>(SgMarkerPattern(7));
  scene.marker.camera_from_marker =
      PoseAtPixel(scene.camera, view.centre_px, view.side_px, scene.marker.size, view.tilt,
                  view.tilt_axis, view.roll);
  scene.image = RenderMarkers(scene.camera, {scene.marker}, options);
  scene.truth = TrueCorners(scene.camera, scene.marker);
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const Vec2& corner : scene.truth) {
    left = std::min(left, corner.x);
    right = std::max(right, corner.x);
    top = std::min(top, corner.y);
    bottom = std::max(bottom, corner.y);
  }
  // The quiet zone is a tenth of the edge wide.
  const double around = 0.15 * view.side_px + 1.0;
  const int x0 = std::max(0, static_cast<int>(left - around));
  const int y0 = std::max(0, static_cast<int>(top - around));
  scene.window = {0, x0, y0,
                  std::min(scene.camera.width, static_cast<int>(right + around) + 1) - x0,
                  std::min(scene.camera.height, static_cast<int>(bottom + around) + 1) - y0};
  return scene;
}

bool FitWhole(const AlignmentScene& scene, ObservedPatch* observed, BlockFit* fit,
              BlockFitState* state, bool fit_light) {
  TakeLinearWindow(*scene.lens, scene.image.view(), scene.window, observed);
  BlockFitOptions options;
  options.steps = 6;
  options.fit_blur = true;
  options.fit_light = fit_light;
  double side = 0.0;
  for (int i = 0; i < 4; ++i) {
    side = std::max(side, Norm(scene.truth[i] - scene.truth[(i + 1) % 4]));
  }
  return fit->Run(scene.marker_pattern(), MarkerPart::kWhole, *observed,
                  BlockFit::BlocksAlong(1.2 * side, 14.0), options, state);
}

}  // namespace pleinair::tracker
