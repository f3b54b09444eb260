#include "session/light_frames.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace pleinair::session {
namespace {

// Number of frames for light estimation. More hardly show other surfaces.
constexpr std::size_t kLightFrames = 8;
// Within half a minute around the middle the sun moves an eighth of a degree.
constexpr std::int64_t kOneSunNs = 30'000'000'000;

}  // namespace

std::vector<std::size_t> EvenlySpread(std::size_t size, std::size_t most) {
  std::vector<std::size_t> chosen(std::min(size, most));
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    chosen[i] = (2 * i + 1) * size / (2 * chosen.size());
  }
  return chosen;
}

std::vector<std::size_t> LightFrames(const std::vector<Observation>& path) {
  if (path.empty()) return {};
  const std::int64_t middle_ns = path[path.size() / 2].timestamp_ns;
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (std::abs(path[i].timestamp_ns - middle_ns) <= kOneSunNs) near.push_back(i);
  }
  std::vector<std::size_t> chosen = EvenlySpread(near.size(), kLightFrames);
  for (std::size_t& index : chosen) index = near[index];
  return chosen;
}

}  // namespace pleinair::session
