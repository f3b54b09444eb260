#include "session/path_gaps.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "session/motion/path_motion.h"

namespace pleinair::session {
namespace {

constexpr double kPerNanosecond = 1e-9;

}  // namespace

FilledGaps FillGaps(const std::vector<FrameTime>& times, std::vector<Observation>* path) {
  FilledGaps filled;
  std::vector<Observation> whole;
  auto time = times.begin();
  for (std::size_t i = 0; i < path->size(); ++i) {
    const Observation& here = (*path)[i];
    whole.push_back(here);
    if (i + 1 == path->size()) break;
    const Observation& next = (*path)[i + 1];
    const double length_s =
        static_cast<double>(next.timestamp_ns - here.timestamp_ns) * kPerNanosecond;
    if (next.frame_index == here.frame_index + 1 || !(length_s > 0.0 && length_s <= kMaxGap_s)) {
      continue;
    }
    const PathMotion motion(*path, i);
    while (time != times.end() && time->frame_index <= here.frame_index) ++time;
    for (; time != times.end() && time->frame_index < next.frame_index; ++time) {
      Observation& between = whole.emplace_back();
      between.frame_index = time->frame_index;
      between.timestamp_ns = time->timestamp_ns;
      between.camera_from_marker = motion.At(time->timestamp_ns);
      between.visible_fraction = 0.0;
      between.source = PoseSource::kMotion;
      ++filled.frames;
    }
    ++filled.gaps;
    filled.longest_s = std::max(filled.longest_s, length_s);
  }
  *path = std::move(whole);
  return filled;
}

}  // namespace pleinair::session
