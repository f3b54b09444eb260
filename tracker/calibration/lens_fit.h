#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/frames.h"
#include "base/vector.h"
#include "tracker/calibration/calibration_board.h"

namespace pleinair::tracker {

/// Lens models in ascending number of free distortion coefficients.
enum class LensKind {
  kPinhole,     ///< No distortion.
  kRadtan4,     ///< k1 k2 p1 p2.
  kRadtan5,     ///< k1 k2 p1 p2 k3.
  kRational,    ///< k1 k2 p1 p2 k3 k4 k5 k6.
  kEquidistant  ///< Fisheye: k1 k2 k3 k4, polynomial in the angle.
};
constexpr LensKind kLensKinds[] = {LensKind::kPinhole, LensKind::kRadtan4, LensKind::kRadtan5,
                                   LensKind::kRational, LensKind::kEquidistant};

/// "pinhole", "radtan4", "radtan5", "rational", "equidistant".
const char* NameOf(LensKind kind);
/// Number of free distortion coefficients: the first entries of CameraModel::distortion.
int CoefficientsOf(LensKind kind);

/// Positions of a board's points on the board and in one image.
struct PlaneView {
  std::string name;
  std::vector<Vec2> on_board_m;
  std::vector<Vec2> observed_px;
};

/// The view with the positions of its points on the board.
PlaneView OnPlane(const BoardView& view, const std::vector<Vec2>& board_points);

struct LensFit {
  LensKind kind = LensKind::kRadtan4;
  CameraModel camera;
  std::vector<Transform<Camera, Marker>> camera_from_board;  ///< One per view.
};

/// Residuals of a view, observed less predicted, px.
std::vector<Vec2> Residuals(const CameraModel& camera,
                            const Transform<Camera, Marker>& camera_from_board,
                            const PlaneView& view);
double Rms(const std::vector<Vec2>& residuals_px);

/// Fits lens and poses to all views by nonlinear least squares (Zhang 2000, "A flexible new
/// technique for camera calibration", §3.3, Eq. 10, with the distortion models of
/// base/camera_model.h). Uses Huber's loss with threshold `huber_px` if that is positive. Starts
/// from several focal lengths. Errors (input): no start converges.
Result<LensFit> FitLens(const std::vector<PlaneView>& views, int width, int height, LensKind kind,
                        double huber_px);

/// As FitLens(), starting from an existing fit of these views by any lens model.
Result<LensFit> FitLensFrom(const std::vector<PlaneView>& views, const LensFit& start,
                            LensKind kind, double huber_px);

/// Pose of one view for a known lens. Errors (input): no pose fits the view.
Result<Transform<Camera, Marker>> FitBoardPose(const PlaneView& view, const CameraModel& camera);

}  // namespace pleinair::tracker
