#include "accuracy/peer_summary.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

namespace pleinair::accuracy {
namespace {

/// One frame, scored for both detectors.
struct FramePair {
  const FrameRecord* ours = nullptr;
  const FrameRecord* peer = nullptr;
};

bool IsHit(const MarkerRecord& marker) { return marker.outcome == Outcome::kHit; }

std::vector<FramePair> PairFrames(const std::vector<FrameRecord>& records, const PeerFrames& which,
                                  const std::string& ours, const std::string& peer) {
  std::map<std::int64_t, FramePair> by_frame;
  for (const FrameRecord& record : records) {
    if (record.sweep != which.sweep) continue;
    if (!which.film.empty() && record.pattern != which.film) continue;
    if (record.detector == ours) by_frame[record.frame].ours = &record;
    if (record.detector == peer) by_frame[record.frame].peer = &record;
  }
  std::vector<FramePair> pairs;
  for (const auto& [frame, pair] : by_frame) {
    if (pair.ours != nullptr && pair.peer != nullptr) pairs.push_back(pair);
  }
  return pairs;
}

using Block = std::vector<FramePair>;

/// Blocks of pairs that may be treated as independent.
std::vector<Block> BlocksOf(const std::vector<FramePair>& pairs) {
  std::map<std::string, std::vector<FramePair>> films;
  std::vector<Block> blocks;
  for (const FramePair& pair : pairs) {
    if (IsFilm(*pair.ours)) {
      films[pair.ours->pattern].push_back(pair);
    } else {
      blocks.push_back({pair});
    }
  }
  for (const auto& [name, frames] : films) {
    const auto length =
        static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(frames.size()))));
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (i % length == 0) blocks.emplace_back();
      blocks.back().push_back(frames[i]);
    }
  }
  return blocks;
}

/// Calls `use` with each marker's two records, for the blocks with these indices.
void ForMarkers(const std::vector<Block>& blocks, const std::vector<std::size_t>& indices,
                const std::function<void(const MarkerRecord&, const MarkerRecord&)>& use) {
  for (const std::size_t index : indices) {
    for (const FramePair& pair : blocks[index]) {
      const auto &ours = pair.ours->markers, &peer = pair.peer->markers;
      for (std::size_t i = 0; i < std::min(ours.size(), peer.size()); ++i) use(ours[i], peer[i]);
    }
  }
}

}  // namespace

std::optional<PeerSummary> CompareWithPeer(const std::vector<FrameRecord>& records,
                                           const PeerFrames& which, const std::string& ours,
                                           const std::string& peer) {
  const std::vector<FramePair> pairs = PairFrames(records, which, ours, peer);
  if (pairs.empty()) return std::nullopt;
  PeerSummary summary{.sweep = which.sweep, .peer = peer, .film = which.film};
  for (const FramePair& pair : pairs) {
    summary.our_false += pair.ours->false_numbers;
    summary.peer_false += pair.peer->false_numbers;
  }
  const std::vector<Block> blocks = BlocksOf(pairs);
  std::vector<std::size_t> all(blocks.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  ForMarkers(blocks, all, [&](const MarkerRecord& a, const MarkerRecord& b) {
    ++summary.hits.markers;
    summary.hits.both += IsHit(a) && IsHit(b);
    summary.hits.only_ours += IsHit(a) && !IsHit(b);
    summary.hits.only_peer += !IsHit(a) && IsHit(b);
  });
  if (summary.hits.markers == 0) return summary;
  summary.hits.p = McNemarExact(summary.hits.only_ours, summary.hits.only_peer);
  const auto rate_ratio = [&](const std::vector<std::size_t>& indices) {
    double our_hits = 0.0, peer_hits = 0.0;
    ForMarkers(blocks, indices, [&](const MarkerRecord& a, const MarkerRecord& b) {
      our_hits += IsHit(a);
      peer_hits += IsHit(b);
    });
    return our_hits / peer_hits;
  };
  // Ratio of medians, over the markers that both detectors hit.
  const auto median_ratio = [&](double (*error)(const MarkerRecord&)) {
    return [&blocks, error](const std::vector<std::size_t>& indices) {
      std::vector<double> our_errors, peer_errors;
      ForMarkers(blocks, indices, [&](const MarkerRecord& a, const MarkerRecord& b) {
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
  summary.rate.value = rate_ratio(all);
  summary.corner.value = corner_ratio(all);
  summary.rotation.value = rotation_ratio(all);
  const std::string purpose = "bootstrap/" + which.sweep + "/" + peer;
  summary.rate.interval = BootstrapInterval(all.size(), rate_ratio, purpose);
  summary.corner.interval = BootstrapInterval(all.size(), corner_ratio, purpose);
  summary.rotation.interval = BootstrapInterval(all.size(), rotation_ratio, purpose);
  return summary;
}

}  // namespace pleinair::accuracy
