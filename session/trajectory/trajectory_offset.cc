#include "session/trajectory/trajectory_offset.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "session/corner_deviation.h"
#include "session/light_frames.h"

namespace pleinair::session {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;
constexpr double kNoFit = std::numeric_limits<double>::infinity();

/// Fit of a trajectory at one offset.
struct OffsetFit {
  double cost = kNoFit;  ///< Mean of log(1 + d²) over the views, d in standard deviations.
  double chi2 = kNoFit;  ///< Sum of the squared distances of all coordinates.
  double chi2_per_dof = 1.0;
};

/// Tries offsets on a part of the marker's frames.
class OffsetSearch {
 public:
  OffsetSearch(const CameraModel& camera, double marker_size_m, const GivenTrajectory& trajectory,
               const std::vector<Observation>& track)
      : camera_(camera), marker_size_m_(marker_size_m), trajectory_(trajectory) {
    constexpr std::size_t kMaxViews = 24;
    for (const std::size_t i : EvenlySpread(track.size(), kMaxViews)) track_.push_back(track[i]);
  }

  OffsetFit At(double offset_ns) const {
    constexpr double kMinCovered = 0.8;
    const std::vector<TrajectoryView> views =
        TrajectoryViews(trajectory_, track_, std::llround(offset_ns));
    OffsetFit fit;
    if (static_cast<double>(views.size()) < kMinCovered * static_cast<double>(track_.size())) {
      return fit;
    }
    const auto alignment =
        AlignByMarker(camera_, marker_size_m_, views, trajectory_.is_metric, trajectory_.file);
    if (!alignment) return fit;
    fit.cost = fit.chi2 = 0.0;
    for (const TrajectoryView& view : views) {
      const double px =
          CornerDistance_px(camera_, marker_size_m_, alignment->marker_from_trajectory, view);
      const double square = px * px / (2.0 * view.deviation_px * view.deviation_px);
      fit.cost += std::log1p(square) / static_cast<double>(views.size());
      fit.chi2 += 8.0 * square;
    }
    const double freedom = 8.0 * static_cast<double>(views.size()) - 7.0;
    fit.chi2_per_dof = std::max(1.0, fit.chi2 / std::max(1.0, freedom));
    return fit;
  }

 private:
  const CameraModel& camera_;
  const double marker_size_m_;
  const GivenTrajectory& trajectory_;
  std::vector<Observation> track_;
};

/// The least cost between two offsets, by golden sections (Kiefer 1953).
double LeastBetween(const OffsetSearch& search, double low_ns, double high_ns) {
  constexpr double kGolden = 0.6180339887498949, kFine_ns = 2e4;
  double left = high_ns - kGolden * (high_ns - low_ns),
         right = low_ns + kGolden * (high_ns - low_ns);
  double left_cost = search.At(left).cost, right_cost = search.At(right).cost;
  while (high_ns - low_ns > kFine_ns) {
    if (left_cost <= right_cost) {
      high_ns = right;
      right = left;
      right_cost = left_cost;
      left = high_ns - kGolden * (high_ns - low_ns);
      left_cost = search.At(left).cost;
    } else {
      low_ns = left;
      left = right;
      left_cost = right_cost;
      right = low_ns + kGolden * (high_ns - low_ns);
      right_cost = search.At(right).cost;
    }
  }
  return 0.5 * (low_ns + high_ns);
}

}  // namespace

std::vector<TrajectoryView> TrajectoryViews(const GivenTrajectory& trajectory,
                                            const std::vector<Observation>& track,
                                            std::int64_t offset_ns) {
  std::vector<TrajectoryView> views;
  for (const Observation& seen : track) {
    const auto pose = PoseIn(trajectory, seen.frame_index, seen.timestamp_ns, offset_ns);
    if (!pose) continue;
    views.push_back({*pose, seen.camera_from_marker, seen.corners_px,
                     CornerDeviation_px(seen.visible_fraction)});
  }
  return views;
}

std::int64_t AssumedOffset(const GivenTrajectory& trajectory, const std::vector<FrameTime>& frames,
                           std::optional<std::int64_t> clock_start_ns) {
  const auto covers = [&](std::int64_t offset_ns) {
    return std::any_of(frames.begin(), frames.end(), [&](const FrameTime& frame) {
      return PoseIn(trajectory, frame.frame_index, frame.timestamp_ns, offset_ns).has_value();
    });
  };
  if (covers(0) || trajectory.poses.empty()) return 0;
  // The negative of the least 64-bit number is none.
  if (clock_start_ns && *clock_start_ns > 0 && covers(-*clock_start_ns)) return -*clock_start_ns;
  return -trajectory.poses.front().timestamp_ns;
}

TrajectoryOffset EstimateOffset(const CameraModel& camera, double marker_size_m,
                                const GivenTrajectory& trajectory,
                                const std::vector<Observation>& track, std::int64_t assumed_ns) {
  constexpr std::size_t kMinViews = 8;
  constexpr double kMinSpan_s = 0.5, kRange_s = 2.0, kStep_s = 1.0 / 30.0, kMaxDeviation_s = 0.02;
  const TrajectoryOffset assumed{assumed_ns, std::nullopt};
  if (track.size() < kMinViews ||
      static_cast<double>(track.back().timestamp_ns - track.front().timestamp_ns) <
          kMinSpan_s * kNanosecondsPerSecond) {
    return assumed;
  }
  const OffsetSearch search(camera, marker_size_m, trajectory, track);
  const auto start_ns = static_cast<double>(assumed.offset_ns);
  constexpr double kStep_ns = kStep_s * kNanosecondsPerSecond;
  constexpr int kSteps = static_cast<int>(kRange_s / kStep_s);
  int best = 0;
  double least = kNoFit;
  for (int i = -kSteps; i <= kSteps; ++i) {
    const double cost = search.At(start_ns + i * kStep_ns).cost;
    if (cost >= least) continue;
    least = cost;
    best = i;
  }
  if (least == kNoFit || std::abs(best) == kSteps) return assumed;
  const double found_ns =
      LeastBetween(search, start_ns + (best - 1) * kStep_ns, start_ns + (best + 1) * kStep_ns);
  // Chi-square rises by half its curvature times the square of the distance.
  constexpr double kSide_s = 0.01;
  constexpr double kSide_ns = kSide_s * kNanosecondsPerSecond;
  const OffsetFit before = search.At(found_ns - kSide_ns), at = search.At(found_ns),
                  after = search.At(found_ns + kSide_ns);
  const double curvature = (before.chi2 - 2.0 * at.chi2 + after.chi2) / (kSide_s * kSide_s);
  if (!(std::isfinite(curvature) && curvature > 0.0)) return assumed;
  const double deviation_s = std::sqrt(2.0 * at.chi2_per_dof / curvature);
  if (deviation_s > kMaxDeviation_s) return assumed;
  return {std::llround(found_ns), deviation_s};
}

}  // namespace pleinair::session
