#include "tracker/calibration/marker_lens.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <utility>

#include "base/units.h"
#include "tracker/calibration/lens_residual.h"
#include "tracker/pose/homography.h"

// Ceres includes glog, which has macros of the names in base/check.h. A file that removes one is
// compiled alone (cmake/unity_batches.awk), so that none of the two meets the other.
#undef CHECK_EQ

namespace pleinair::tracker {
namespace {

/// Free parameters: f, cx, cy, k1, k2.
constexpr int kFree = 5;
constexpr int kCoordinates = 8;
/// Redundant coordinates of a view: those of four corners less a pose.
constexpr double kSpare = kCoordinates - kPoseNumbers;

constexpr double kMinCorner_px = 0.03;
constexpr double kCentrePrior = 0.015;  // Relative to the image's longer side.
constexpr double kDistortionPrior = 0.3;
/// As for calibration boards (view_judgement.cc).
constexpr double kMaxMarkerFocalDeviation = 0.01;
/// Poses whose alternative is more likely than this are not used: a wrong one distorts the lens.
constexpr double kMaxAmbiguity = 1e-2;
/// Views beyond this χ², in units of the typical one, contradict the others. The 99.99 % quantile
/// of two degrees of freedom is 18.4.
constexpr double kMaxViewChi2 = 18.4;
/// Median of χ² with two degrees of freedom.
constexpr double kMedianChi2 = 1.386;
constexpr double kLittleMarkerTilt_deg = 15.0;

constexpr const char* kMarkerRemedy =
    "film the marker flat and near, from several sides and obliquely (30 to 60 degrees), moving "
    "slowly; or use a board (pleinair board)";

using Free = std::array<double, kFree>;
using Whitening = Eigen::Matrix<double, kCoordinates, kCoordinates>;
using ByFree = Eigen::Matrix<double, kCoordinates, kFree, Eigen::RowMajor>;
using ByPose = Eigen::Matrix<double, kCoordinates, kPoseNumbers, Eigen::RowMajor>;
using Coordinates = Eigen::Matrix<double, kCoordinates, 1>;

CameraModel CameraFrom(const double* free, int width, int height) {
  CameraModel camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = free[0];
  camera.cx = free[1];
  camera.cy = free[2];
  camera.distortion[0] = free[3];
  camera.distortion[1] = free[4];
  return camera;
}

/// The expected parameters and their standard deviations, but for the focal length.
struct LensPrior {
  LensPrior(int width, int height) {
    mean = {0.0, 0.5 * (width - 1), 0.5 * (height - 1), 0.0, 0.0};
    const double centre = kCentrePrior * std::max(width, height);
    deviation = {std::numeric_limits<double>::infinity(), centre, centre, kDistortionPrior,
                 kDistortionPrior};
  }
  Free mean, deviation;
};

struct WeighedView {
  std::array<Vec2, 4> corners_px;
  CornerCovariance covariance_px2;  ///< With kMinCorner_px.
  Whitening whitening;              ///< Makes residuals independent with unit variance.
};

WeighedView Weigh(const MarkerView& view) {
  using Square = Eigen::Matrix<double, kCoordinates, kCoordinates, Eigen::RowMajor>;
  WeighedView weighed{view.corners_px, view.covariance_px2, {}};
  Eigen::Map<Square> covariance(weighed.covariance_px2.data());
  covariance.diagonal().array() += kMinCorner_px * kMinCorner_px;
  const Eigen::LLT<Whitening> factor{Whitening(covariance)};
  weighed.whitening = factor.matrixL().solve(Whitening::Identity());
  return weighed;
}

/// Whitened residuals of a view, and their derivatives if requested.
Coordinates ResidualsOf(const CameraModel& camera, const WeighedView& view, const double* pose,
                        ByFree* by_free, ByPose* by_pose) {
  Coordinates residuals;
  PixelDerivatives by;
  for (int i = 0; i < 4; ++i) {
    const auto corner = static_cast<std::size_t>(i);
    const Vec2 pixel = ProjectBoardPoint(camera, pose, kSquareCorners[corner] * 0.5,
                                         by_free != nullptr ? &by : nullptr);
    residuals[2 * i] = view.corners_px[corner].x - pixel.x;
    residuals[2 * i + 1] = view.corners_px[corner].y - pixel.y;
    if (by_free == nullptr) continue;
    for (int axis = 0; axis < 2; ++axis) {
      const double* lens = by.by_lens.data() + axis * kLensNumbers;
      by_free->row(2 * i + axis) << -(lens[0] + lens[1]), -lens[2], -lens[3], -lens[4], -lens[5];
      const double* by_numbers = by.by_pose.data() + axis * kPoseNumbers;
      for (int k = 0; k < kPoseNumbers; ++k) (*by_pose)(2 * i + axis, k) = -by_numbers[k];
    }
  }
  if (by_free != nullptr) {
    *by_free = view.whitening * *by_free;
    *by_pose = view.whitening * *by_pose;
  }
  return view.whitening * residuals;
}

class ViewCost final : public ceres::SizedCostFunction<kCoordinates, kFree, kPoseNumbers> {
 public:
  ViewCost(int width, int height, const WeighedView& view)
      : width_(width), height_(height), view_(view) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    ByFree by_free;
    ByPose by_pose;
    Eigen::Map<Coordinates> out(residuals);
    out = ResidualsOf(CameraFrom(parameters[0], width_, height_), view_, parameters[1],
                      jacobians != nullptr ? &by_free : nullptr, &by_pose);
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) Eigen::Map<ByFree>{jacobians[0]} = by_free;
    if (jacobians[1] != nullptr) Eigen::Map<ByPose>{jacobians[1]} = by_pose;
    return true;
  }

 private:
  const int width_, height_;
  const WeighedView& view_;
};

class PriorCost final : public ceres::SizedCostFunction<kFree - 1, kFree> {
 public:
  explicit PriorCost(const LensPrior& prior) : prior_(prior) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      std::fill_n(jacobians[0], (kFree - 1) * kFree, 0.0);
    }
    for (int i = 1; i < kFree; ++i) {
      const auto which = static_cast<std::size_t>(i);
      residuals[i - 1] = (parameters[0][i] - prior_.mean[which]) / prior_.deviation[which];
      if (jacobians != nullptr && jacobians[0] != nullptr) {
        jacobians[0][(i - 1) * kFree + i] = 1.0 / prior_.deviation[which];
      }
    }
    return true;
  }

 private:
  const LensPrior prior_;
};

/// A lens and the poses of some views.
struct Bundle {
  Free free{};
  std::vector<std::size_t> views;
  std::vector<PoseNumbers> poses;  ///< One per view; markers of unit edge.
  double cost = std::numeric_limits<double>::infinity();
};

class MarkerLensEstimator {
 public:
  MarkerLensEstimator(const std::vector<MarkerView>& views, int width, int height)
      : width_(width), height_(height), prior_(width, height) {
    for (const MarkerView& view : views) views_.push_back(Weigh(view));
  }

  Result<MarkerLens> Run(std::optional<double> start_focal_px) const {
    if (views_.size() < kMinMarkerViews) return TooFew(views_.size());
    Bundle bundle = Scout(start_focal_px);
    if (!std::isfinite(bundle.cost)) {
      return InputError("", "no lens explains the views of the marker",
                        "calibrate the camera with a board (pleinair board)");
    }
    // The poses, and which of them are certain, depend on the lens.
    for (int round = 0; round < 3; ++round) {
      bundle = Posed(bundle.free, AllViews(), kMaxAmbiguity);
      if (bundle.views.size() < kMinMarkerViews) return TooFew(bundle.views.size());
      bundle = Solve(std::move(bundle), true);
      if (!std::isfinite(bundle.cost)) return TooFew(0);
    }
    DropContradictions(&bundle);
    if (bundle.views.size() < kMinMarkerViews) return TooFew(bundle.views.size());
    bundle = Solve(std::move(bundle), false);
    if (!std::isfinite(bundle.cost)) return TooFew(0);
    return Described(bundle);
  }

 private:
  static tl::unexpected<Error> TooFew(std::size_t usable) {
    return InputError("",
                      "only " + std::to_string(usable) +
                          " different views of the marker can be used, and fewer than " +
                          std::to_string(kMinMarkerViews) + " do not determine a lens",
                      kMarkerRemedy);
  }

  std::vector<std::size_t> AllViews() const {
    std::vector<std::size_t> all(views_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return all;
  }

  /// The views that have a pose through this lens.
  Bundle Posed(const Free& free, const std::vector<std::size_t>& views,
               double max_ambiguity) const {
    Bundle bundle;
    bundle.free = free;
    const CameraModel camera = CameraFrom(free.data(), width_, height_);
    for (const std::size_t i : views) {
      const auto pose =
          EstimatePlanarPose(camera, views_[i].corners_px, views_[i].covariance_px2, Metres(1.0));
      if (!pose || pose->ambiguity_ratio > max_ambiguity) continue;
      bundle.views.push_back(i);
      bundle.poses.push_back(NumbersOf(pose->best.camera_from_marker));
    }
    return bundle;
  }

  /// The best of several starts, with a few views. Wide lenses need another start than long ones.
  Bundle Scout(std::optional<double> start_focal_px) const {
    constexpr std::size_t kScouts = 16;
    std::vector<std::size_t> scouts;
    const std::size_t stride = std::max<std::size_t>(1, views_.size() / kScouts);
    for (std::size_t i = 0; i < views_.size(); i += stride) scouts.push_back(i);
    std::vector<double> focals;
    if (start_focal_px) focals.push_back(*start_focal_px);
    for (const double each : {0.5, 0.75, 1.1, 1.6, 2.5}) {
      focals.push_back(each * std::max(width_, height_));
    }
    Bundle best;
    for (const double focal : focals) {
      Free free = prior_.mean;
      free[0] = focal;
      Bundle start = Posed(free, scouts, 1.0);
      // Costs are comparable only over the same views.
      if (start.views.size() != scouts.size()) continue;
      Bundle bundle = Solve(std::move(start), true);
      if (bundle.cost < best.cost) best = std::move(bundle);
    }
    return best;
  }

  Bundle Solve(Bundle bundle, bool robust) const {
    constexpr double kHuber = 4.0;  // Threshold on the norm of a view's whitened residual.
    ceres::Problem problem;
    auto order = std::make_shared<ceres::ParameterBlockOrdering>();
    for (std::size_t i = 0; i < bundle.views.size(); ++i) {
      problem.AddResidualBlock(new ViewCost(width_, height_, views_[bundle.views[i]]),
                               robust ? new ceres::HuberLoss(kHuber) : nullptr, bundle.free.data(),
                               bundle.poses[i].data());
      order->AddElementToGroup(bundle.poses[i].data(), 0);
    }
    problem.AddResidualBlock(new PriorCost(prior_), nullptr, bundle.free.data());
    order->AddElementToGroup(bundle.free.data(), 1);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.linear_solver_ordering = order;
    options.max_num_iterations = 60;
    options.function_tolerance = 1e-9;
    options.parameter_tolerance = 1e-10;
    options.logging_type = ceres::SILENT;
    // Failing starts are expected, so Ceres' log on standard error is silenced.
    FLAGS_minloglevel = google::GLOG_FATAL;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    const bool good =
        summary.IsSolutionUsable() && std::isfinite(summary.final_cost) && bundle.free[0] > 0.0;
    bundle.cost = good ? summary.final_cost : std::numeric_limits<double>::infinity();
    return bundle;
  }

  double ViewChi2(const Bundle& bundle, std::size_t i) const {
    const CameraModel camera = CameraFrom(bundle.free.data(), width_, height_);
    return ResidualsOf(camera, views_[bundle.views[i]], bundle.poses[i].data(), nullptr, nullptr)
        .squaredNorm();
  }

  void DropContradictions(Bundle* bundle) const {
    std::vector<double> all;
    for (std::size_t i = 0; i < bundle->views.size(); ++i) all.push_back(ViewChi2(*bundle, i));
    std::vector<double> sorted = all;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double most = kMaxViewChi2 * std::max(1.0, *middle / kMedianChi2);
    Bundle kept;
    kept.free = bundle->free;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!(all[i] <= most)) continue;
      kept.views.push_back(bundle->views[i]);
      kept.poses.push_back(bundle->poses[i]);
    }
    *bundle = std::move(kept);
  }

  MarkerLens Described(const Bundle& bundle) const {
    MarkerLens lens;
    lens.camera = CameraFrom(bundle.free.data(), width_, height_);
    lens.used = bundle.views;
    using Information = Eigen::Matrix<double, kFree, kFree>;
    Information information = Information::Zero();
    for (int i = 1; i < kFree; ++i) {
      const double deviation = prior_.deviation[static_cast<std::size_t>(i)];
      information(i, i) = 1.0 / (deviation * deviation);
    }
    double chi2 = 0.0, nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
    for (std::size_t i = 0; i < bundle.views.size(); ++i) {
      ByFree by_free;
      ByPose by_pose;
      const PoseNumbers& pose = bundle.poses[i];
      chi2 += ResidualsOf(lens.camera, views_[bundle.views[i]], pose.data(), &by_free, &by_pose)
                  .squaredNorm();
      const Eigen::Matrix<double, kFree, kPoseNumbers> cross = by_free.transpose() * by_pose;
      const Eigen::Matrix<double, kPoseNumbers, kPoseNumbers> block = by_pose.transpose() * by_pose;
      information += by_free.transpose() * by_free;
      information -= cross * block.ldlt().solve(cross.transpose());
      const Transform<Camera, Marker> camera_from_marker = PoseOf<Camera>(pose);
      const double cosine = std::clamp(std::fabs(camera_from_marker.rotation(2, 2)), 0.0, 1.0);
      lens.max_tilt_deg = std::max(lens.max_tilt_deg, std::acos(cosine) / kRadiansPerDegree);
      nearest = std::min(nearest, Norm(camera_from_marker.translation_m));
      farthest = std::max(farthest, Norm(camera_from_marker.translation_m));
    }
    lens.distance_ratio = farthest / nearest;
    const double freedom = std::max(
        1.0, kSpare * static_cast<double>(bundle.views.size()) - static_cast<double>(kFree));
    lens.chi2 = chi2 / freedom;
    const double scale = std::sqrt(std::max(1.0, lens.chi2));
    // Scaled to a unit diagonal: the parameters differ by powers of ten.
    const Eigen::Matrix<double, kFree, 1> size = information.diagonal().cwiseSqrt();
    const Information scaled =
        size.cwiseInverse().asDiagonal() * information * size.cwiseInverse().asDiagonal();
    const Information covariance = scaled.inverse();
    const auto deviation = [&](int i) {
      return scale * std::sqrt(std::max(covariance(i, i), 0.0)) / size[i];
    };
    lens.deviations = {deviation(0), deviation(1), deviation(2), deviation(3), deviation(4)};
    return lens;
  }

  const int width_, height_;
  const LensPrior prior_;
  std::vector<WeighedView> views_;
};

}  // namespace

Result<MarkerLens> EstimateMarkerLens(const std::vector<MarkerView>& views, int width, int height,
                                      std::optional<double> start_focal_px) {
  return MarkerLensEstimator(views, width, height).Run(start_focal_px);
}

Result<void> CheckDetermined(const MarkerLens& lens) {
  const double relative = lens.deviations.focal_px / lens.camera.fx;
  if (relative <= kMaxMarkerFocalDeviation) return {};
  const auto number = [](const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return std::string(text);
  };
  std::string what = "the film does not determine the lens: its focal length is ";
  what += relative < 1.0 ? "known to " + number("%.2g", 100.0 * relative) + " % only"
                         : std::string("undetermined");
  if (lens.max_tilt_deg < kLittleMarkerTilt_deg) {
    what += ", since the camera looks straight at the marker in every view (tilted by at most " +
            number("%.0f", lens.max_tilt_deg) + " degrees)";
  } else {
    what += " by " + std::to_string(lens.used.size()) +
            " different views: the camera moves too little, or the marker is too small";
  }
  return InputError("", what, kMarkerRemedy);
}

}  // namespace pleinair::tracker
