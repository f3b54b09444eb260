#include "accuracy/peer_summary.h"

#include <functional>
#include <map>

namespace pleinair::accuracy {
namespace {

/// One frame under both detectors.
struct FramePair {
  const FrameRecord* ours = nullptr;
  const FrameRecord* peer = nullptr;
};

bool IsHit(const MarkerRecord& marker) { return marker.outcome == Outcome::kHit; }

std::vector<FramePair> PairFrames(const std::vector<FrameRecord>& records, const std::string& sweep,
                                  const std::string& ours, const std::string& peer) {
  std::map<std::int64_t, FramePair> by_frame;
  for (const FrameRecord& record : records) {
    if (record.sweep != sweep) continue;
    if (record.detector == ours) by_frame[record.frame].ours = &record;
    if (record.detector == peer) by_frame[record.frame].peer = &record;
  }
  std::vector<FramePair> pairs;
  for (const auto& [frame, pair] : by_frame) {
    if (pair.ours != nullptr && pair.peer != nullptr) pairs.push_back(pair);
  }
  return pairs;
}

/// Calls `use` with each marker as both have seen it, of the frames with these indices.
void ForMarkers(const std::vector<FramePair>& pairs, const std::vector<std::size_t>& frames,
                const std::function<void(const MarkerRecord&, const MarkerRecord&)>& use) {
  for (const std::size_t frame : frames) {
    const auto& ours = pairs[frame].ours->markers;
    const auto& peer = pairs[frame].peer->markers;
    for (std::size_t i = 0; i < std::min(ours.size(), peer.size()); ++i) use(ours[i], peer[i]);
  }
}

}  // namespace

std::optional<PeerSummary> CompareWithPeer(const std::vector<FrameRecord>& records,
                                           const std::string& sweep, const std::string& ours,
                                           const std::string& peer) {
  const std::vector<FramePair> pairs = PairFrames(records, sweep, ours, peer);
  if (pairs.empty()) return std::nullopt;
  PeerSummary summary{.sweep = sweep, .peer = peer};
  std::vector<std::size_t> all(pairs.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = i;
    summary.our_false += pairs[i].ours->false_numbers;
    summary.peer_false += pairs[i].peer->false_numbers;
  }
  ForMarkers(pairs, all, [&](const MarkerRecord& a, const MarkerRecord& b) {
    ++summary.markers;
    summary.both += IsHit(a) && IsHit(b);
    summary.only_ours += IsHit(a) && !IsHit(b);
    summary.only_peer += !IsHit(a) && IsHit(b);
  });
  if (summary.markers == 0) return summary;
  summary.p = McNemarExact(summary.only_ours, summary.only_peer);
  const auto rate_ratio = [&](const std::vector<std::size_t>& frames) {
    double our_hits = 0.0, peer_hits = 0.0;
    ForMarkers(pairs, frames, [&](const MarkerRecord& a, const MarkerRecord& b) {
      our_hits += IsHit(a);
      peer_hits += IsHit(b);
    });
    return our_hits / peer_hits;
  };
  // Of medians, over the markers that both hit.
  const auto median_ratio = [&](double (*error)(const MarkerRecord&)) {
    return [&pairs, error](const std::vector<std::size_t>& frames) {
      std::vector<double> our_errors, peer_errors;
      ForMarkers(pairs, frames, [&](const MarkerRecord& a, const MarkerRecord& b) {
        if (!a.pose || !b.pose) return;
        our_errors.push_back(error(a));
        peer_errors.push_back(error(b));
      });
      return Percentile(our_errors, 0.5) / Percentile(peer_errors, 0.5);
    };
  };
  const auto corner_ratio = median_ratio([](const MarkerRecord& m) { return m.CornerRms(); });
  const auto rotation_ratio =
      median_ratio([](const MarkerRecord& m) { return m.pose->rotation_error_deg; });
  summary.rate_ratio = rate_ratio(all);
  summary.corner_ratio = corner_ratio(all);
  summary.rotation_ratio = rotation_ratio(all);
  const std::string purpose = "bootstrap/" + sweep + "/" + peer;
  summary.rate_interval = BootstrapInterval(all.size(), rate_ratio, purpose);
  summary.corner_interval = BootstrapInterval(all.size(), corner_ratio, purpose);
  summary.rotation_interval = BootstrapInterval(all.size(), rotation_ratio, purpose);
  return summary;
}

}  // namespace pleinair::accuracy
