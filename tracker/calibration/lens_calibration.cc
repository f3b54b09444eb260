#include "tracker/calibration/lens_calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pleinair::tracker {
namespace {

/// Threshold of Huber's loss in the first fits, relative to the image's longer side.
constexpr double kHuberShare = 0.0015;
/// Corners in photographs are never more accurate than this, so no lower uncertainty is reported.
constexpr double kMinNoise_px = 0.03;
/// A model with fewer parameters is kept unless the cross-validation error of another is lower by
/// this factor, and lower beyond chance.
constexpr double kWorthwhile = 1.01;
constexpr const char* kRemedy =
    "take 10 to 20 images of the whole board: near and far, tilted in several directions, in every "
    "corner of the image, with focus and zoom held";

std::vector<LensKind> KindsToTry(const LensCalibrationOptions& options) {
  if (options.kind) return {*options.kind};
  // In ascending number of parameters.
  return {LensKind::kRadtan4, LensKind::kRadtan5, LensKind::kEquidistant, LensKind::kRational};
}

/// Standard deviation of a coordinate from the lengths of two-dimensional residuals, half of which
/// are below 1.1774 standard deviations for normal residuals (Rayleigh distribution).
double RobustNoise(const LensFit& fit, const std::vector<PlaneView>& views) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (const Vec2 each : Residuals(fit.camera, fit.camera_from_board[i], views[i])) {
      lengths.push_back(std::isfinite(Norm(each)) ? Norm(each)
                                                  : std::numeric_limits<double>::infinity());
    }
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle / 1.1774;
}

/// Removes outliers from the views and from the fit.
void LeaveOut(LensFit* fit, LensCalibration* calibration) {
  const double most = std::max(5.0 * RobustNoise(*fit, calibration->views), 0.25);
  std::vector<PlaneView> kept;
  LensFit kept_fit = *fit;
  kept_fit.camera_from_board.clear();
  for (std::size_t i = 0; i < calibration->views.size(); ++i) {
    const PlaneView& view = calibration->views[i];
    const auto residuals = Residuals(fit->camera, fit->camera_from_board[i], view);
    PlaneView whole{view.name, {}, {}};
    for (std::size_t point = 0; point < residuals.size(); ++point) {
      if (!(Norm(residuals[point]) <= most)) continue;
      whole.on_board_m.push_back(view.on_board_m[point]);
      whole.observed_px.push_back(view.observed_px[point]);
    }
    const std::size_t left_out = view.observed_px.size() - whole.observed_px.size();
    if (whole.observed_px.size() < 6 || 2 * whole.observed_px.size() < view.observed_px.size()) {
      calibration->dropped.push_back(
          {view.name,
           "its corners contradict the other views (blurred, or another lens setting?)"});
      continue;
    }
    calibration->points_left_out += static_cast<int>(left_out);
    kept_fit.camera_from_board.push_back(fit->camera_from_board[i]);
    kept.push_back(std::move(whole));
  }
  calibration->views = std::move(kept);
  *fit = std::move(kept_fit);
}

tl::unexpected<Error> TooFew(std::size_t views, std::size_t of) {
  return InputError("",
                    "only " + std::to_string(views) + " of " + std::to_string(of) +
                        " views can be used, and fewer than " + std::to_string(kMinViews) +
                        " do not determine a lens",
                    kRemedy);
}

std::string Joined(const std::vector<std::string>& reasons) {
  std::string all;
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    all += (i == 0 ? "" : "; ") +
           (reasons.size() > 1 ? "(" + std::to_string(i + 1) + ") " : std::string()) + reasons[i];
  }
  return all;
}

class Calibrator {
 public:
  Calibrator(int width, int height, const LensCalibrationOptions& options)
      : width_(width), height_(height), options_(options), kinds_(KindsToTry(options)) {}

  Result<LensCalibration> Run(const std::vector<PlaneView>& views) {
    if (views.size() < kMinViews) return TooFew(views.size(), views.size());
    calibration_.views = views;
    PLEINAIR_ASSIGN_OR_RETURN(LensFit clean, FitRobustly());
    LeaveOut(&clean, &calibration_);
    if (calibration_.views.size() < kMinViews)
      return TooFew(calibration_.views.size(), views.size());
    PLEINAIR_RETURN_IF_ERROR(Choose(clean));
    Describe();
    if (calibration_.judgement.reasons.empty()) return std::move(calibration_);
    return InputError(
        "", "these views do not determine the lens: " + Joined(calibration_.judgement.reasons),
        kRemedy);
  }

 private:
  Result<void> Step() {
    ++step_;
    const double steps = 2.0 * static_cast<double>(kinds_.size()) + 1.0;
    if (!options_.progress || options_.progress(step_ / steps)) return {};
    return SystemError("", "interrupted", "");
  }

  /// The lens model with the smallest residuals for most points.
  Result<LensFit> FitRobustly() {
    const double huber_px = kHuberShare * std::max(width_, height_);
    Result<LensFit> best = InputError("", "no lens explains these views", kRemedy);
    double least = std::numeric_limits<double>::infinity();
    for (const LensKind kind : kinds_) {
      PLEINAIR_RETURN_IF_ERROR(Step());
      // Related models start from each other's result.
      const bool related =
          best && (best->kind == LensKind::kEquidistant) == (kind == LensKind::kEquidistant);
      auto fit = related ? FitLensFrom(calibration_.views, *best, kind, huber_px)
                         : FitLens(calibration_.views, width_, height_, kind, huber_px);
      if (!fit) {
        if (!best) best = std::move(fit);
        continue;
      }
      const double noise = RobustNoise(*fit, calibration_.views);
      if (noise >= least) continue;
      least = noise;
      best = std::move(fit);
    }
    return best;
  }

  Result<void> Choose(const LensFit& clean) {
    std::vector<LensFit> fits;
    std::vector<CrossValidation> validations;
    Error last{};
    for (const LensKind kind : kinds_) {
      PLEINAIR_RETURN_IF_ERROR(Step());
      auto fit = FitLensFrom(calibration_.views, clean, kind, 0.0);
      auto validation = fit ? CrossValidate(calibration_.views, *fit, options_.folds)
                            : tl::make_unexpected(fit.error());
      if (!validation) {
        last = validation.error();
        continue;
      }
      calibration_.tried.push_back({kind, RmsOf(*fit), validation->rms_px});
      fits.push_back(*std::move(fit));
      validations.push_back(*std::move(validation));
    }
    if (fits.empty()) return tl::make_unexpected(std::move(last));
    const auto least = std::ranges::min_element(validations, {}, &CrossValidation::rms_px);
    for (std::size_t i = 0; i < fits.size(); ++i) {
      if (validations[i].rms_px > kWorthwhile * least->rms_px &&
          PredictsBetter(*least, validations[i])) {
        continue;
      }
      calibration_.fit = std::move(fits[i]);
      calibration_.validation = std::move(validations[i]);
      return {};
    }
    return InputError("", "no lens explains these views", kRemedy);
  }

  double RmsOf(const LensFit& fit) const {
    std::vector<Vec2> all;
    for (std::size_t i = 0; i < calibration_.views.size(); ++i) {
      const auto residuals = Residuals(fit.camera, fit.camera_from_board[i], calibration_.views[i]);
      all.insert(all.end(), residuals.begin(), residuals.end());
    }
    return Rms(all);
  }

  void Describe() {
    LensCalibration& all = calibration_;
    for (std::size_t i = 0; i < all.views.size(); ++i) {
      all.residuals_px.push_back(
          Residuals(all.fit.camera, all.fit.camera_from_board[i], all.views[i]));
    }
    all.rms_px = RmsOf(all.fit);
    all.uncertainty = Uncertainty(all.fit, all.views, kMinNoise_px);
    all.coverage = CoverageOf(all.views, width_, height_);
    all.judgement = JudgeViews(all.fit, all.views, all.coverage, all.uncertainty);
  }

  const int width_, height_;
  const LensCalibrationOptions& options_;
  const std::vector<LensKind> kinds_;
  int step_ = 0;
  LensCalibration calibration_;
};

}  // namespace

Result<LensCalibration> CalibrateLens(const std::vector<PlaneView>& views, int width, int height,
                                      const LensCalibrationOptions& options) {
  return Calibrator(width, height, options).Run(views);
}

}  // namespace pleinair::tracker
