#include "session/anchor_follower.h"

#include <bit>
#include <chrono>
#include <utility>

#include "session/anchors.h"
#include "session/following/low_priority.h"
#include "session/scene_marker.h"

namespace pleinair::session {
namespace {

constexpr std::size_t kMaxSharedFrames = 64;

}  // namespace

AnchorFollower::AnchorFollower(const CameraModel& camera, const scene::SceneDescription& scene,
                               bool in_background)
    : camera_(camera),
      names_{{scene.marker.family.value_or(kSgFamily), scene.marker.id.value_or(0)}},
      described_(DescribedAnchors(scene)),
      placed_(described_),
      shared_frames_(described_.size(), 0),
      in_background_(in_background) {
  for (const scene::AnchorDescription& anchor : scene.anchors) names_.push_back(NameOf(anchor));
}

std::optional<Observation> AnchorFollower::Add(const MarkerTracks& tracks,
                                               std::int64_t frame_index) {
  AnchorView view;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const std::vector<Observation>& track = tracks.TrackOf(names_[i]);
    if (track.empty() || track.back().frame_index != frame_index) continue;
    AddToView(i, track.back(), &view);
  }
  if (view.markers.empty()) return std::nullopt;
  Keep(view.markers);
  Place();
  return ObservationBy(camera_, placed_, std::move(view));
}

void AnchorFollower::Keep(const tracker::AnchorFrame& frame) {
  if (frame.size() < 2) return;
  bool is_kept = false;
  for (const tracker::AnchorSighting& sighting : frame) {
    std::size_t& count = shared_frames_[sighting.marker];
    if (described_[sighting.marker].reference_from_marker || count >= kMaxSharedFrames) continue;
    is_kept = true;
    is_due_ = std::has_single_bit(++count) || is_due_;
  }
  if (is_kept) shared_.push_back(frame);
}

void AnchorFollower::Place() {
  if (placing_.valid() && placing_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    placed_ = placing_.get();
  }
  if (!is_due_ || placing_.valid()) return;
  is_due_ = false;
  placing_ = std::async(in_background_ ? std::launch::async : std::launch::deferred,
                        [camera = camera_, shared = shared_, placed = described_,
                         in_background = in_background_]() mutable {
                          if (in_background) LowerPriority();
                          tracker::PlaceAnchorMarkers(camera, shared, &placed);
                          return placed;
                        });
  if (!in_background_) placed_ = placing_.get();
}

}  // namespace pleinair::session
