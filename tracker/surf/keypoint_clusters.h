#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tracker/surf/surf_descriptor.h"
#include "tracker/surf/surf_keypoint.h"

namespace pleinair::tracker {

struct DescribedKeypoint {
  SurfKeypoint keypoint;
  SurfDescriptor descriptor;
};

/// Detections of one keypoint in several simulated views.
using KeypointCluster = std::vector<DescribedKeypoint>;

inline bool SameKeypoint(const SurfKeypoint& a, const SurfKeypoint& b) {
  if (a.bright != b.bright) return false;
  const float ratio = a.scale / b.scale;
  if (ratio > 1.3F || ratio < 1.0F / 1.3F) return false;
  if (std::hypot(a.x - b.x, a.y - b.y) > 0.7F * a.scale) return false;
  return std::fabs(std::remainder(a.angle_rad - b.angle_rad, 2.0F * std::numbers::pi_v<float>)) <
         0.35F;
}

/// Adds a detection to the cluster of the same keypoint or, if `may_begin`, starts a new cluster.
inline void AddToClusters(const DescribedKeypoint& observed, bool may_begin,
                          std::vector<KeypointCluster>* clusters) {
  const auto same = std::ranges::find_if(*clusters, [&](const KeypointCluster& cluster) {
    return SameKeypoint(cluster.front().keypoint, observed.keypoint);
  });
  if (same != clusters->end()) {
    same->push_back(observed);
  } else if (may_begin) {
    clusters->push_back({observed});
  }
}

}  // namespace pleinair::tracker
