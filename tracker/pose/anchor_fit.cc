#include "tracker/pose/anchor_fit.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "tracker/pose/pose_numbers.h"

// Ceres includes glog, which has macros of the names in base/check.h. A file that removes one is
// compiled alone (cmake/unity_batches.awk), so that none of the two meets the other.
#undef CHECK_EQ

namespace pleinair::tracker {
namespace {

/// Clockwise from top-left, in edges from the centre.
constexpr std::array<Vec2, 4> kAnchorCorners{{{-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}}};

/// Huber's threshold on the distance of a corner in standard deviations: 96 % of correct corners
/// are nearer (chi-square distribution of two degrees of freedom).
constexpr double kHuberDeviations = 2.5;

/// Distance of a corner of a sighting from its projection, in standard deviations.
struct CornerCost {
  const CameraModel& camera;
  const AnchorSighting& sighting;
  double size_m;
  std::size_t corner;

  template <typename T>
  bool operator()(const T* camera_from_reference, const T* reference_from_marker,
                  T* residuals) const {
    const Vec2 at = kAnchorCorners[corner];
    const T on_marker[3] = {T(at.x * size_m), T(at.y * size_m), T(0)};
    T in_reference[3], in_camera[3];
    ceres::AngleAxisRotatePoint(reference_from_marker, on_marker, in_reference);
    for (int k = 0; k < 3; ++k) in_reference[k] += reference_from_marker[3 + k];
    ceres::AngleAxisRotatePoint(camera_from_reference, in_reference, in_camera);
    for (int k = 0; k < 3; ++k) in_camera[k] += camera_from_reference[3 + k];
    if (in_camera[2] < T(1e-6)) return false;
    T u, v;
    ProjectToPixel(camera, in_camera[0], in_camera[1], in_camera[2], &u, &v);
    residuals[0] = (u - sighting.corners_px[corner].x) / sighting.deviation_px;
    residuals[1] = (v - sighting.corners_px[corner].y) / sighting.deviation_px;
    return true;
  }
};

/// Adds the corners of a sighting to a problem, each with Huber's loss.
void AddCorners(const CameraModel& camera, const AnchorSighting& sighting, double size_m,
                double* pose, double* anchor, ceres::Problem* problem) {
  for (std::size_t corner = 0; corner < kAnchorCorners.size(); ++corner) {
    problem->AddResidualBlock(new ceres::AutoDiffCostFunction<CornerCost, 2, 6, 6>(
                                  new CornerCost{camera, sighting, size_m, corner}),
                              new ceres::HuberLoss(kHuberDeviations), pose, anchor);
  }
}

ceres::Solver::Options QuietOptions(ceres::LinearSolverType solver) {
  ceres::Solver::Options options;
  options.linear_solver_type = solver;
  options.max_num_iterations = 60;
  options.function_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  return options;
}

double PlacementDistance(const Transform<Marker, Marker>& a, const Transform<Marker, Marker>& b) {
  const Mat3 relative = a.rotation.Transposed() * b.rotation;
  const double cosine = 0.5 * (relative(0, 0) + relative(1, 1) + relative(2, 2) - 1.0);
  return Norm(a.translation_m - b.translation_m) + std::acos(std::clamp(cosine, -1.0, 1.0));
}

/// Estimates the pose of `marker` from single frames beside placed markers. It is the pose nearest
/// to all others, so that frames with the wrong one of two planar poses do not count.
std::optional<Transform<Marker, Marker>> RoughPlacement(const std::vector<AnchorFrame>& frames,
                                                        const std::vector<AnchorMarker>& markers,
                                                        std::size_t marker) {
  constexpr std::size_t kMaxCandidates = 100;
  std::vector<Transform<Marker, Marker>> candidates;
  for (const AnchorFrame& frame : frames) {
    const AnchorSighting* here = nullptr;
    const AnchorSighting* placed = nullptr;
    for (const AnchorSighting& sighting : frame) {
      if (sighting.marker == marker) here = &sighting;
      if (markers[sighting.marker].reference_from_marker) placed = &sighting;
    }
    if (here == nullptr || placed == nullptr) continue;
    candidates.push_back(*markers[placed->marker].reference_from_marker *
                         placed->camera_from_marker.Inverse() * here->camera_from_marker);
  }
  if (candidates.size() > kMaxCandidates) {
    std::vector<Transform<Marker, Marker>> some;
    for (std::size_t i = 0; i < kMaxCandidates; ++i) {
      some.push_back(candidates[i * candidates.size() / kMaxCandidates]);
    }
    candidates = std::move(some);
  }
  std::optional<Transform<Marker, Marker>> best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& one : candidates) {
    double sum = 0.0;
    for (const auto& other : candidates) sum += PlacementDistance(one, other);
    if (sum >= least) continue;
    least = sum;
    best = one;
  }
  return best;
}

/// Adjusts the markers that `free` names, and the frames' poses.
void Adjust(const CameraModel& camera, const std::vector<AnchorFrame>& frames,
            const std::vector<bool>& free, std::vector<AnchorMarker>* markers) {
  constexpr std::size_t kMaxFrames = 300;
  std::vector<const AnchorFrame*> shared;
  for (const AnchorFrame& frame : frames) {
    const auto placed = std::count_if(frame.begin(), frame.end(), [&](const auto& sighting) {
      return (*markers)[sighting.marker].reference_from_marker.has_value();
    });
    if (placed >= 2) shared.push_back(&frame);
  }
  const std::size_t stride = shared.size() / kMaxFrames + 1;
  std::vector<PoseNumbers> anchors(markers->size()), poses;
  poses.reserve(shared.size());
  for (std::size_t i = 0; i < markers->size(); ++i) {
    if (const auto& at = (*markers)[i].reference_from_marker) anchors[i] = NumbersOf(*at);
  }
  ceres::Problem problem;
  auto order = std::make_shared<ceres::ParameterBlockOrdering>();
  for (std::size_t i = 0; i < shared.size(); i += stride) {
    const auto start = FitAnchoredPose(camera, *markers, *shared[i]);
    if (!start) continue;
    poses.push_back(NumbersOf(start->camera_from_reference));
    order->AddElementToGroup(poses.back().data(), 0);
    for (const AnchorSighting& sighting : *shared[i]) {
      const AnchorMarker& marker = (*markers)[sighting.marker];
      if (!marker.reference_from_marker) continue;
      double* anchor = anchors[sighting.marker].data();
      AddCorners(camera, sighting, marker.size_m, poses.back().data(), anchor, &problem);
      if (!free[sighting.marker]) problem.SetParameterBlockConstant(anchor);
      order->AddElementToGroup(anchor, 1);
    }
  }
  if (problem.NumResidualBlocks() == 0) return;
  ceres::Solver::Options options = QuietOptions(ceres::DENSE_SCHUR);
  options.linear_solver_ordering = order;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return;
  for (std::size_t i = 0; i < markers->size(); ++i) {
    if (free[i] && (*markers)[i].reference_from_marker) {
      (*markers)[i].reference_from_marker = PoseOf<Marker>(anchors[i]);
    }
  }
}

}  // namespace

void PlaceAnchorMarkers(const CameraModel& camera, const std::vector<AnchorFrame>& frames,
                        std::vector<AnchorMarker>* markers) {
  std::vector<bool> free(markers->size(), false);
  for (bool any = true; any;) {
    any = false;
    for (std::size_t i = 0; i < markers->size(); ++i) {
      AnchorMarker& marker = (*markers)[i];
      if (marker.reference_from_marker) continue;
      marker.reference_from_marker = RoughPlacement(frames, *markers, i);
      if (!marker.reference_from_marker) continue;
      free[i] = any = true;
    }
  }
  if (std::count(free.begin(), free.end(), true) > 0) Adjust(camera, frames, free, markers);
}

std::optional<AnchoredPose> FitAnchoredPose(const CameraModel& camera,
                                            const std::vector<AnchorMarker>& markers,
                                            const AnchorFrame& frame) {
  std::optional<AnchoredPose> best;
  double least = std::numeric_limits<double>::infinity();
  // Each marker's own pose is a start: one of them may be the wrong one of two planar poses.
  for (const AnchorSighting& from : frame) {
    const auto& placed = markers[from.marker].reference_from_marker;
    if (!placed) continue;
    PoseNumbers pose = NumbersOf(from.camera_from_marker * placed->Inverse());
    std::vector<PoseNumbers> anchors;
    anchors.reserve(frame.size());
    ceres::Problem problem;
    for (const AnchorSighting& sighting : frame) {
      const AnchorMarker& marker = markers[sighting.marker];
      if (!marker.reference_from_marker) continue;
      anchors.push_back(NumbersOf(*marker.reference_from_marker));
      AddCorners(camera, sighting, marker.size_m, pose.data(), anchors.back().data(), &problem);
      problem.SetParameterBlockConstant(anchors.back().data());
    }
    ceres::Solver::Summary summary;
    // A single marker's own pose is the best: it knows the covariance of its corners.
    ceres::Solver::Options options = QuietOptions(ceres::DENSE_QR);
    if (anchors.size() == 1) options.max_num_iterations = 0;
    ceres::Solve(options, &problem, &summary);
    if (!summary.IsSolutionUsable() || !(summary.final_cost < least)) continue;
    least = summary.final_cost;
    // Distances of all corners, outliers included. Costs are half the squares.
    ceres::Problem::EvaluateOptions squares;
    squares.apply_loss_function = false;
    double cost = 0.0;
    problem.Evaluate(squares, &cost, nullptr, nullptr, nullptr);
    const double corners = 4.0 * static_cast<double>(anchors.size());
    best = AnchoredPose{PoseOf<Camera>(pose), from.deviation_px * std::sqrt(2.0 * cost / corners)};
  }
  return best;
}

}  // namespace pleinair::tracker
