#include "app/replay/frame_choice.h"

#include <algorithm>
#include <cstdlib>

namespace pleinair::app {
namespace {

constexpr std::size_t kReportPictures = 4;
// The light is read from so many frames; more hardly show other surfaces.
constexpr std::size_t kLightFrames = 8;
// Within half a minute about the middle the sun moves an eighth of a degree.
constexpr std::int64_t kOneSunNs = 30'000'000'000;

/// Numbers below `size`, at most `most`: the middles of as many equal parts.
std::vector<std::size_t> EvenlySpread(std::size_t size, std::size_t most) {
  std::vector<std::size_t> chosen(std::min(size, most));
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    chosen[i] = (2 * i + 1) * size / (2 * chosen.size());
  }
  return chosen;
}

}  // namespace

std::vector<std::size_t> LightFrames(const std::vector<session::Observation>& path) {
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

std::set<std::int64_t> ReportFrames(const std::vector<session::Observation>& path,
                                    std::int64_t frames) {
  std::set<std::int64_t> shown;
  if (path.empty()) {
    for (const std::size_t at : EvenlySpread(static_cast<std::size_t>(frames), kReportPictures)) {
      shown.insert(static_cast<std::int64_t>(at));
    }
  } else {
    for (const std::size_t at : EvenlySpread(path.size(), kReportPictures)) {
      shown.insert(path[at].frame_index);
    }
  }
  return shown;
}

}  // namespace pleinair::app
