#include "session/anchor_follower.h"

#include <bit>
#include <utility>

#include "session/anchors.h"
#include "session/scene_marker.h"

namespace pleinair::session {
namespace {

constexpr std::size_t kMaxSharedFrames = 64;

}  // namespace

AnchorFollower::AnchorFollower(const CameraModel& camera, const scene::SceneDescription& scene)
    : camera_(camera),
      names_{{scene.marker.family.value_or(kSgFamily), scene.marker.id.value_or(0)}},
      described_(DescribedAnchors(scene)),
      placed_(described_),
      shared_frames_(described_.size(), 0) {
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
  Place(view.markers);
  return ObservationBy(camera_, placed_, std::move(view));
}

void AnchorFollower::Place(const tracker::AnchorFrame& frame) {
  if (frame.size() < 2) return;
  bool is_kept = false, is_doubled = false;
  for (const tracker::AnchorSighting& sighting : frame) {
    std::size_t& count = shared_frames_[sighting.marker];
    if (described_[sighting.marker].reference_from_marker || count >= kMaxSharedFrames) continue;
    is_kept = true;
    is_doubled = std::has_single_bit(++count) || is_doubled;
  }
  if (is_kept) shared_.push_back(frame);
  if (!is_doubled) return;
  placed_ = described_;
  tracker::PlaceAnchorMarkers(camera_, shared_, &placed_);
}

}  // namespace pleinair::session
