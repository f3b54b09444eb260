#include "tracker/calibration/cross_validation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/check.h"

namespace pleinair::tracker {

bool PredictsBetter(const CrossValidation& model, const CrossValidation& other) {
  CHECK_EQ(model.squares_px2.size(), other.squares_px2.size());
  constexpr double kStandardErrors = 2.0;
  const auto views = static_cast<double>(model.squares_px2.size());
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < model.squares_px2.size(); ++i) {
    const double better = std::log(other.squares_px2[i] / model.squares_px2[i]);
    sum += better;
    squares += better * better;
  }
  const double variance = squares - sum * sum / views;  // Sum over all differences.
  return sum > kStandardErrors * std::sqrt(std::max(0.0, variance * views / (views - 1.0)));
}

Result<CrossValidation> CrossValidate(const std::vector<PlaneView>& views, const LensFit& fit,
                                      int folds) {
  CrossValidation validation;
  validation.folds = std::min(folds, static_cast<int>(views.size()));
  validation.squares_px2.resize(views.size());
  double squares = 0.0;
  std::size_t points = 0;
  for (int fold = 0; fold < validation.folds; ++fold) {
    std::vector<PlaneView> kept, left_out;
    std::vector<std::size_t> left_out_views;
    LensFit start = fit;
    start.camera_from_board.clear();
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (static_cast<int>(i) % validation.folds == fold) {
        left_out.push_back(views[i]);
        left_out_views.push_back(i);
      } else {
        kept.push_back(views[i]);
        start.camera_from_board.push_back(fit.camera_from_board[i]);
      }
    }
    PLEINAIR_ASSIGN_OR_RETURN(const LensFit without, FitLensFrom(kept, start, fit.kind, 0.0));
    validation.focal_px.push_back(0.5 * (without.camera.fx + without.camera.fy));
    for (std::size_t i = 0; i < left_out.size(); ++i) {
      const PlaneView& view = left_out[i];
      PLEINAIR_ASSIGN_OR_RETURN(const auto pose, FitBoardPose(view, without.camera));
      const std::vector<Vec2> residuals = Residuals(without.camera, pose, view);
      const double rms = Rms(residuals);
      const double of_view = rms * rms * static_cast<double>(residuals.size());
      validation.squares_px2[left_out_views[i]] = of_view;
      squares += of_view;
      points += residuals.size();
    }
  }
  validation.rms_px = points == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(points));
  return validation;
}

}  // namespace pleinair::tracker
