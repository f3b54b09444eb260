#include "tracker/calibration/cross_validation.h"

#include <algorithm>
#include <cmath>

namespace pleinair::tracker {

Result<CrossValidation> CrossValidate(const std::vector<PlaneView>& views, const LensFit& fit,
                                      int folds) {
  CrossValidation validation;
  validation.folds = std::min(folds, static_cast<int>(views.size()));
  double squares = 0.0;
  std::size_t points = 0;
  for (int fold = 0; fold < validation.folds; ++fold) {
    std::vector<PlaneView> kept, left_out;
    LensFit start = fit;
    start.camera_from_board.clear();
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (static_cast<int>(i) % validation.folds == fold) {
        left_out.push_back(views[i]);
      } else {
        kept.push_back(views[i]);
        start.camera_from_board.push_back(fit.camera_from_board[i]);
      }
    }
    PLEINAIR_ASSIGN_OR_RETURN(const LensFit without, FitLensFrom(kept, start, fit.kind, 0.0));
    validation.focal_px.push_back(0.5 * (without.camera.fx + without.camera.fy));
    for (const PlaneView& view : left_out) {
      PLEINAIR_ASSIGN_OR_RETURN(const auto pose, FitBoardPose(view, without.camera));
      const std::vector<Vec2> residuals = Residuals(without.camera, pose, view);
      const double rms = Rms(residuals);
      squares += rms * rms * static_cast<double>(residuals.size());
      points += residuals.size();
    }
  }
  validation.rms_px = points == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(points));
  return validation;
}

}  // namespace pleinair::tracker
