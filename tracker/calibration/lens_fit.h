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

/// How a lens may bend, from the stiffest on; which of a CameraModel's numbers are free.
enum class LensKind {
  kPinhole,     ///< Not at all.
  kRadtan4,     ///< k1 k2 p1 p2.
  kRadtan5,     ///< k1 k2 p1 p2 k3.
  kRational,    ///< k1 k2 p1 p2 k3 k4 k5 k6.
  kEquidistant  ///< Fisheye: k1 k2 k3 k4 in the angle.
};
constexpr LensKind kLensKinds[] = {LensKind::kPinhole, LensKind::kRadtan4, LensKind::kRadtan5,
                                   LensKind::kRational, LensKind::kEquidistant};

/// "pinhole", "radtan4", "radtan5", "rational", "equidistant".
const char* NameOf(LensKind kind);
/// Number of free coefficients of distortion, the first ones of CameraModel::distortion.
int CoefficientsOf(LensKind kind);

/// A board's points and where one image shows them.
struct PlaneView {
  std::string name;
  std::vector<Vec2> on_board_m;
  std::vector<Vec2> observed_px;
};

/// The view with its points' places looked up.
PlaneView OnPlane(const BoardView& view, const std::vector<Vec2>& board_points);

struct LensFit {
  LensKind kind = LensKind::kRadtan4;
  CameraModel camera;
  std::vector<Transform<Camera, Marker>> camera_from_board;  ///< One a view.
};

/// Residuals of a view, observed less predicted, px.
std::vector<Vec2> Residuals(const CameraModel& camera,
                            const Transform<Camera, Marker>& camera_from_board,
                            const PlaneView& view);
double Rms(const std::vector<Vec2>& residuals_px);

/// Lens and poses that fit all views best: nonlinear least squares over everything at once (Zhang
/// 2000, "A flexible new technique for camera calibration", §3.3, Eq. 10, with the distortion
/// models of base/camera_model.h), with Huber's loss at `huber_px` where that is positive. Starts
/// from several focal lengths. Errors (input): no start leads anywhere.
Result<LensFit> FitLens(const std::vector<PlaneView>& views, int width, int height, LensKind kind,
                        double huber_px);

/// The same from a fit of these views that is there already, of any kind.
Result<LensFit> FitLensFrom(const std::vector<PlaneView>& views, const LensFit& start,
                            LensKind kind, double huber_px);

/// Pose of one view under a known lens; nothing where no pose explains it.
Result<Transform<Camera, Marker>> FitBoardPose(const PlaneView& view, const CameraModel& camera);

}  // namespace pleinair::tracker
