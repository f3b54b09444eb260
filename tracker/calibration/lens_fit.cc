#include "tracker/calibration/lens_fit.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <optional>

#include "tracker/calibration/lens_residual.h"

namespace pleinair::tracker {
namespace {

/// Reprojection error of a point.
class PointResidual final : public ceres::SizedCostFunction<2, kLensNumbers, kPoseNumbers> {
 public:
  PointResidual(const CameraModel& camera, Vec2 on_board_m, Vec2 observed_px)
      : camera_(camera), on_board_m_(on_board_m), seen_px_(observed_px) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    CameraModel camera = camera_;
    SetLensNumbers(parameters[0], &camera);
    PixelDerivatives derivatives;
    const Vec2 pixel = ProjectBoardPoint(camera, parameters[1], on_board_m_,
                                         jacobians != nullptr ? &derivatives : nullptr);
    residuals[0] = seen_px_.x - pixel.x;
    residuals[1] = seen_px_.y - pixel.y;
    if (jacobians == nullptr) return true;
    const auto negate = [](const auto& from, double* to) {
      if (to != nullptr) std::transform(from.begin(), from.end(), to, std::negate<>());
    };
    negate(derivatives.by_lens, jacobians[0]);
    negate(derivatives.by_pose, jacobians[1]);
    return true;
  }

 private:
  const CameraModel camera_;  ///< For its model and size.
  const Vec2 on_board_m_, seen_px_;
};

struct Solution {
  LensFit fit;
  double cost = std::numeric_limits<double>::infinity();
};

Solution Solve(const std::vector<PlaneView>& views, LensFit start, double huber_px, int steps,
               bool only_poses) {
  LensNumbers lens = NumbersOf(start.camera);
  std::vector<PoseNumbers> poses;
  for (const auto& pose : start.camera_from_board) poses.push_back(NumbersOf(pose));
  ceres::Problem problem;
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (std::size_t point = 0; point < views[i].observed_px.size(); ++point) {
      problem.AddResidualBlock(
          new PointResidual(start.camera, views[i].on_board_m[point], views[i].observed_px[point]),
          huber_px > 0.0 ? new ceres::HuberLoss(huber_px) : nullptr, lens.data(), poses[i].data());
    }
  }
  if (only_poses) {
    problem.SetParameterBlockConstant(lens.data());
  } else {
    std::vector<int> fixed;
    for (int i = 4 + CoefficientsOf(start.kind); i < kLensNumbers; ++i) fixed.push_back(i);
    if (!fixed.empty()) {
      problem.SetManifold(lens.data(), new ceres::SubsetManifold(kLensNumbers, fixed));
    }
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = steps;
  options.function_tolerance = 1e-10;
  options.parameter_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  auto order = std::make_shared<ceres::ParameterBlockOrdering>();
  for (PoseNumbers& pose : poses) order->AddElementToGroup(pose.data(), 0);
  order->AddElementToGroup(lens.data(), 1);
  options.linear_solver_ordering = order;
  // Failing starts are expected, so Ceres' log on standard error is silenced.
  FLAGS_minloglevel = google::GLOG_FATAL;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  Solution solution{std::move(start)};
  if (!summary.IsSolutionUsable() || !std::isfinite(summary.final_cost)) return solution;
  SetLensNumbers(lens.data(), &solution.fit.camera);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    solution.fit.camera_from_board[i] = PoseOf<Camera>(poses[i]);
  }
  // A negative focal length corresponds to a board behind a mirrored camera.
  if (lens[0] > 0.0 && lens[1] > 0.0) solution.cost = summary.final_cost;
  return solution;
}

/// Pose from undistorted rays, by IPPE (Collins & Bartoli 2014), the better of its two.
std::optional<Transform<Camera, Marker>> StartPose(const PlaneView& view,
                                                   const CameraModel& camera) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> rays;
  for (std::size_t i = 0; i < view.observed_px.size(); ++i) {
    const Vec2 ray = UndistortPixel(camera, view.observed_px[i]);
    if (!std::isfinite(ray.x) || !std::isfinite(ray.y) || Norm(ray) > 10.0) continue;
    points.emplace_back(view.on_board_m[i].x, view.on_board_m[i].y, 0.0);
    rays.emplace_back(ray.x, ray.y);
  }
  if (points.size() < 4) return std::nullopt;
  try {
    cv::Mat rotation_vector, translation, rotation;
    if (!cv::solvePnP(points, rays, cv::Matx33d::eye(), cv::noArray(), rotation_vector, translation,
                      false, cv::SOLVEPNP_IPPE)) {
      return std::nullopt;
    }
    cv::Rodrigues(rotation_vector, rotation);
    Transform<Camera, Marker> pose;
    for (int i = 0; i < 9; ++i) {
      pose.rotation.m[static_cast<std::size_t>(i)] = rotation.at<double>(i / 3, i % 3);
    }
    pose.translation_m = {translation.at<double>(0), translation.at<double>(1),
                          translation.at<double>(2)};
    if (!std::isfinite(Norm(pose.translation_m)) || pose.translation_m.z <= 0.0)
      return std::nullopt;
    return pose;
  } catch (const cv::Exception&) {  // Collinear points.
    return std::nullopt;
  }
}

std::optional<std::vector<Transform<Camera, Marker>>> StartPoses(
    const std::vector<PlaneView>& views, const CameraModel& camera) {
  std::vector<Transform<Camera, Marker>> poses;
  for (const PlaneView& view : views) {
    const auto pose = StartPose(view, camera);
    if (!pose) return std::nullopt;
    poses.push_back(*pose);
  }
  return poses;
}

void SetModel(LensKind kind, CameraModel* camera) {
  const bool was_equidistant = camera->distortion_model == DistortionModel::kEquidistant;
  const bool is_equidistant = kind == LensKind::kEquidistant;
  camera->distortion_model =
      is_equidistant ? DistortionModel::kEquidistant : DistortionModel::kBrownConrady;
  // Coefficients of one model have no meaning in the other.
  if (was_equidistant != is_equidistant) camera->distortion.fill(0.0);
  for (std::size_t i = static_cast<std::size_t>(CoefficientsOf(kind)); i < 8; ++i) {
    camera->distortion[i] = 0.0;
  }
}

constexpr int kSteps = 100;

}  // namespace

const char* NameOf(LensKind kind) {
  switch (kind) {
    case LensKind::kPinhole:
      return "pinhole";
    case LensKind::kRadtan4:
      return "radtan4";
    case LensKind::kRadtan5:
      return "radtan5";
    case LensKind::kRational:
      return "rational";
    case LensKind::kEquidistant:
      return "equidistant";
  }
  return "";
}

int CoefficientsOf(LensKind kind) {
  switch (kind) {
    case LensKind::kPinhole:
      return 0;
    case LensKind::kRadtan4:
    case LensKind::kEquidistant:
      return 4;
    case LensKind::kRadtan5:
      return 5;
    case LensKind::kRational:
      return 8;
  }
  return 0;
}

PlaneView OnPlane(const BoardView& view, const std::vector<Vec2>& board_points) {
  PlaneView plane{view.name, {}, view.observed_px};
  for (const int point : view.points) {
    plane.on_board_m.push_back(board_points[static_cast<std::size_t>(point)]);
  }
  return plane;
}

std::vector<Vec2> Residuals(const CameraModel& camera,
                            const Transform<Camera, Marker>& camera_from_board,
                            const PlaneView& view) {
  std::vector<Vec2> residuals;
  for (std::size_t i = 0; i < view.observed_px.size(); ++i) {
    const Vec2 on_board = view.on_board_m[i];
    residuals.push_back(
        view.observed_px[i] -
        ProjectToPixel(camera, camera_from_board * Point<Marker>{{on_board.x, on_board.y, 0.0}}));
  }
  return residuals;
}

double Rms(const std::vector<Vec2>& residuals_px) {
  double sum = 0.0;
  for (const Vec2 each : residuals_px) sum += each.x * each.x + each.y * each.y;
  return residuals_px.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(residuals_px.size()));
}

Result<LensFit> FitLens(const std::vector<PlaneView>& views, int width, int height, LensKind kind,
                        double huber_px) {
  // A few views suffice to find the right start; wide lenses need another start than long ones.
  constexpr std::size_t kScouts = 10;
  std::vector<PlaneView> scouts;
  const std::size_t stride = std::max<std::size_t>(1, views.size() / kScouts);
  for (std::size_t i = 0; i < views.size() && scouts.size() < kScouts; i += stride) {
    scouts.push_back(views[i]);
  }
  Solution best;
  for (const LensKind model : {LensKind::kRadtan4, LensKind::kEquidistant}) {
    const bool wide = model == LensKind::kEquidistant;
    if (kind != LensKind::kEquidistant && wide) continue;
    for (const double focal : {0.35, 0.6, 0.9, 1.4, 2.5, 5.0}) {
      LensFit start;
      start.kind = model;
      SetModel(model, &start.camera);
      start.camera.width = width;
      start.camera.height = height;
      start.camera.fx = start.camera.fy = focal * std::max(width, height);
      start.camera.cx = 0.5 * (width - 1);
      start.camera.cy = 0.5 * (height - 1);
      auto poses = StartPoses(scouts, start.camera);
      if (!poses) continue;
      start.camera_from_board = *std::move(poses);
      Solution solution = Solve(scouts, std::move(start), std::max(huber_px, 1.0), 40, false);
      if (solution.cost < best.cost) best = std::move(solution);
    }
  }
  if (!std::isfinite(best.cost)) {
    return InputError("", "no lens explains these views",
                      "check that the board is described correctly and lies flat");
  }
  LensFit start = best.fit;
  start.camera_from_board.clear();
  for (const PlaneView& view : views) {
    const auto pose = StartPose(view, start.camera);
    if (!pose) {
      return InputError(view.name, "no pose of the board explains what is seen",
                        "leave this image out");
    }
    start.camera_from_board.push_back(*pose);
  }
  return FitLensFrom(views, start, kind, huber_px);
}

Result<LensFit> FitLensFrom(const std::vector<PlaneView>& views, const LensFit& start,
                            LensKind kind, double huber_px) {
  LensFit from = start;
  const bool other_model =
      (start.kind == LensKind::kEquidistant) != (kind == LensKind::kEquidistant);
  from.kind = kind;
  SetModel(kind, &from.camera);
  if (other_model) {
    // The poses change with the model, so they are fitted first.
    from = Solve(views, std::move(from), std::max(huber_px, 1.0), 30, true).fit;
  }
  Solution solution = Solve(views, std::move(from), huber_px, kSteps, false);
  if (!std::isfinite(solution.cost)) {
    return InputError("",
                      std::string("no lens of the kind ") + NameOf(kind) + " explains these views",
                      "choose another one with --model");
  }
  return std::move(solution.fit);
}

Result<Transform<Camera, Marker>> FitBoardPose(const PlaneView& view, const CameraModel& camera) {
  const auto start = StartPose(view, camera);
  LensFit fit;
  fit.camera = camera;
  if (start) {
    fit.camera_from_board = {*start};
    const Solution solution = Solve({view}, std::move(fit), 0.0, kSteps, true);
    if (std::isfinite(solution.cost)) return solution.fit.camera_from_board[0];
  }
  return InputError(view.name, "no pose of the board explains what is seen",
                    "leave this image out");
}

}  // namespace pleinair::tracker
