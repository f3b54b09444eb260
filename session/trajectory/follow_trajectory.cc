#include "session/trajectory/follow_trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>

#include "base/quantile.h"
#include "session/path_gaps.h"
#include "session/trajectory/point_alignment.h"

namespace pleinair::session {
namespace {

/// Mean edge of the marker in an image, pixels.
double MeanEdge_px(const std::array<Vec2, 4>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) sum += Norm(corners[(i + 1) % 4] - corners[i]);
  return 0.25 * sum;
}

/// Errors: the median view shows the marker farther than half its edge from its place.
Result<void> CheckAgreement(const CameraModel& camera, double marker_size_m,
                            const TrajectoryAlignment& alignment,
                            const std::vector<TrajectoryView>& views, const std::string& file) {
  constexpr double kMaxEdges = 0.5;
  std::vector<double> edges;
  edges.reserve(views.size());
  for (const TrajectoryView& view : views) {
    edges.push_back(
        CornerDistance_px(camera, marker_size_m, alignment.marker_from_trajectory, view) /
        MeanEdge_px(view.corners_px));
  }
  if (edges.empty() || Median(edges) <= kMaxEdges) return {};
  return InputError(
      file, "contradicts the marker: it puts it more than half its edge from where frames show it",
      "check its format, --trajectory-offset-s, --trajectory-turn-deg and --trajectory-scale");
}

std::optional<Radians> TiltOf(const GivenTrajectory& trajectory,
                              const TrajectorySimilarity& similarity,
                              const scene::MarkerDescription& marker) {
  if (!trajectory.up) return std::nullopt;
  const Vec3 up = similarity.rotation * *trajectory.up;
  const Vec3 wanted = marker.upright ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  return Radians(std::acos(std::clamp(Dot(up, wanted) / Norm(up), -1.0, 1.0)));
}

/// Nothing if no view has the marker before the camera.
std::optional<double> MarkerRms_px(const CameraModel& camera, double marker_size_m,
                                   const TrajectorySimilarity& similarity,
                                   const std::vector<TrajectoryView>& views) {
  double squares = 0.0, count = 0.0;
  for (const TrajectoryView& view : views) {
    const double px = CornerDistance_px(camera, marker_size_m, similarity, view);
    if (!std::isfinite(px)) continue;
    squares += px * px;
    count += 1.0;
  }
  return count > 0.0 ? std::optional(std::sqrt(squares / count)) : std::nullopt;
}

/// Observations by the index of their frame.
std::map<std::int64_t, const Observation*> ByFrame(const std::vector<Observation>& observations) {
  std::map<std::int64_t, const Observation*> by_frame;
  for (const Observation& at : observations) by_frame.emplace(at.frame_index, &at);
  return by_frame;
}

const Observation* Of(const std::map<std::int64_t, const Observation*>& by_frame,
                      std::int64_t frame) {
  const auto found = by_frame.find(frame);
  return found == by_frame.end() ? nullptr : found->second;
}

/// Both in order of frames; a frame of both counts once.
std::vector<Observation> WithMoreViews(const std::vector<Observation>& track,
                                       const std::vector<Observation>& more) {
  const auto is_before = [](const Observation& a, const Observation& b) {
    return a.frame_index < b.frame_index;
  };
  std::vector<Observation> all;
  std::set_union(track.begin(), track.end(), more.begin(), more.end(), std::back_inserter(all),
                 is_before);
  return all;
}

TrajectoryOffset OffsetOf(const CameraModel& camera, const scene::MarkerDescription& marker,
                          const std::vector<FrameTime>& times,
                          const std::vector<Observation>& track, const TrajectoryRequest& request) {
  if (request.offset_ns) return {*request.offset_ns, std::nullopt, true};
  if (request.trajectory.by_frame) return {};
  const std::int64_t assumed_ns = AssumedOffset(request.trajectory, times, request.clock_start_ns);
  if (marker.target) return {assumed_ns, std::nullopt, false};
  return EstimateOffset(camera, marker.size_m, request.trajectory, track, assumed_ns);
}

}  // namespace

Observation ObservationByTrajectory(const CameraModel& camera, double marker_size_m,
                                    const FrameTime& time, const Observation* seen,
                                    const TrajectoryAlignment& alignment,
                                    const Transform<TrajectoryWorld, Camera>& world_from_camera) {
  Observation here;
  if (seen != nullptr) here = *seen;
  if (seen != nullptr && marker_size_m > 0.0) {
    here.reprojection_rms_px =
        CornerDistance_px(camera, marker_size_m, alignment.marker_from_trajectory,
                          {world_from_camera, seen->camera_from_marker, seen->corners_px});
  }
  if (seen == nullptr) {
    here.frame_index = time.frame_index;
    here.timestamp_ns = time.timestamp_ns;
    here.visible_fraction = 0.0;
  }
  here.ambiguity_ratio = 0.0;
  here.source = PoseSource::kTrajectory;
  here.camera_from_marker = (alignment.marker_from_trajectory * world_from_camera).Inverse();
  here.centre_deviation_m = CentreDeviation_m(alignment, world_from_camera);
  return here;
}

Result<FollowedTrajectory> FollowTrajectory(const CameraModel& camera,
                                            const scene::MarkerDescription& marker,
                                            const std::vector<FrameTime>& times,
                                            const std::vector<Observation>& track,
                                            const std::vector<Observation>& marker_path,
                                            const TrajectoryRequest& request) {
  const GivenTrajectory& trajectory = request.trajectory;
  FollowedTrajectory followed;
  TrajectorySummary& summary = followed.summary;
  summary.file = trajectory.file;
  summary.by_frame = trajectory.by_frame;
  summary.by_points = !request.points.empty();
  summary.is_metric = trajectory.is_metric;
  const std::vector<Observation> seen_at = WithMoreViews(track, request.more_views);
  summary.offset = OffsetOf(camera, marker, times, seen_at, request);
  // A picture target is no square of a stated size.
  std::vector<TrajectoryView> views;
  if (!marker.target) views = TrajectoryViews(trajectory, seen_at, summary.offset.offset_ns);
  if (summary.by_points) {
    PLEINAIR_ASSIGN_OR_RETURN(summary.alignment,
                              AlignByPoints(request.points, trajectory.is_metric, trajectory.file));
  } else if (marker.target) {
    return InputError(trajectory.file, "cannot be aligned by a picture target",
                      "give three places with --trajectory-points");
  } else {
    PLEINAIR_ASSIGN_OR_RETURN(
        summary.alignment,
        AlignByMarker(camera, marker.size_m, views, trajectory.is_metric, trajectory.file));
  }
  const TrajectorySimilarity& similarity = summary.alignment.marker_from_trajectory;
  PLEINAIR_RETURN_IF_ERROR(
      CheckAgreement(camera, marker.size_m, summary.alignment, views, trajectory.file));
  summary.marker_rms_px = MarkerRms_px(camera, marker.size_m, similarity, views);
  summary.tilt = TiltOf(trajectory, similarity, marker);
  const auto seen_in = ByFrame(track), path_in = ByFrame(marker_path);
  std::vector<double> deviations_m;
  for (const FrameTime& time : times) {
    const Observation* seen = Of(seen_in, time.frame_index);
    const Observation* other = Of(path_in, time.frame_index);
    if (const auto pose =
            PoseIn(trajectory, time.frame_index, time.timestamp_ns, summary.offset.offset_ns)) {
      followed.observations.push_back(
          ObservationByTrajectory(camera, marker.size_m, time, seen, summary.alignment, *pose));
      deviations_m.push_back(followed.observations.back().centre_deviation_m);
      ++summary.frames.by_trajectory;
      summary.frames.without_marker += seen == nullptr ? 1 : 0;
    } else if (other != nullptr) {
      followed.observations.push_back(*other);
      ++summary.frames.by_marker;
    }
  }
  if (deviations_m.empty()) {
    return InputError(trajectory.file, "has a pose for none of the frames",
                      trajectory.by_frame
                          ? "name the images by the numbers of their frames, from 0"
                          : "check --trajectory-offset-s and --trajectory-max-gap-s");
  }
  summary.centre_deviation_m = Median(deviations_m);
  summary.frames.filled = FillGaps(times, &followed.observations).frames;
  summary.frames.missing = static_cast<std::int64_t>(times.size()) -
                           static_cast<std::int64_t>(followed.observations.size());
  return followed;
}

}  // namespace pleinair::session
