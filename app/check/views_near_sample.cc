#include "app/check/views_near_sample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "app/check/spread_frames.h"
#include "scene/scene_description.h"
#include "session/light_frames.h"

namespace pleinair::app {
namespace {

// As many views as the estimate of an offset uses, from three places of the walk if possible.
constexpr std::size_t kViewsOfOffset = 24, kPlaces = 3;
constexpr double kReach_s = 0.6;

}  // namespace

std::vector<std::int64_t> FramesNearSample(const std::vector<session::FrameTime>& sample,
                                           const std::vector<session::Observation>& track) {
  if (track.empty() || track.size() >= kViewsOfOffset || sample.size() < 2) return {};
  const auto frames = static_cast<double>(sample.back().frame_index - sample.front().frame_index);
  const double seconds =
      1e-9 * static_cast<double>(sample.back().timestamp_ns - sample.front().timestamp_ns);
  if (!(frames > 0.0 && seconds > 0.0)) return {};
  const std::vector<std::size_t> chosen = session::EvenlySpread(track.size(), kPlaces);
  const auto each_side = static_cast<std::int64_t>(kViewsOfOffset / chosen.size() / 2);
  const double reach = kReach_s * frames / seconds;
  const std::int64_t step =
      std::max<std::int64_t>(1, static_cast<std::int64_t>(reach / static_cast<double>(each_side)));
  std::set<std::int64_t> near;
  for (const std::size_t i : chosen) {
    for (std::int64_t k = -each_side; k <= each_side; ++k) {
      near.insert(track[i].frame_index + k * step);
    }
  }
  for (const session::FrameTime& at : sample) near.erase(at.frame_index);
  near.erase(near.begin(), near.lower_bound(0));
  return {near.begin(), near.end()};
}

Result<std::vector<session::Observation>> ViewsNearSample(
    const session::Pipeline& sample, const session::TrajectoryRequest& request,
    const std::function<Result<devices::Recording>()>& open, const session::PassMonitor& monitor) {
  std::vector<session::Observation> views;
  const std::optional<session::MarkerName> marker = sample.tracks().ReferenceMarker();
  if (!marker || request.offset_ns || request.trajectory.by_frame || sample.scene().marker.target) {
    return views;
  }
  std::vector<std::int64_t> near =
      FramesNearSample(sample.tracks().frame_times(), sample.tracks().TrackOf(*marker));
  if (near.empty()) return views;
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, open());
  const std::optional<std::int64_t> count = recording.frames->FrameCount();
  // Where it is not known, the sample has all frames.
  if (!count || !recording.frames->CountsExactly()) return views;
  std::erase_if(near, [&](std::int64_t frame) { return frame >= *count; });
  if (near.empty()) return views;
  recording.frames = std::make_unique<SpreadFrames>(std::move(recording.frames), std::move(near));
  // Nothing is drawn here.
  scene::SceneDescription marker_only = sample.scene();
  marker_only.objects.clear();
  marker_only.phantoms.clear();
  marker_only.anchors.clear();
  PLEINAIR_ASSIGN_OR_RETURN(const auto pipeline,
                            session::Pipeline::Create(recording.camera, marker_only));
  PLEINAIR_RETURN_IF_ERROR(session::TrackRecording(*pipeline, std::move(recording), {}, monitor));
  return pipeline->tracks().TrackOf(*marker);
}

}  // namespace pleinair::app
