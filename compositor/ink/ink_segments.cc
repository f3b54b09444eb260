#include "compositor/ink/ink_segments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pleinair::compositor {
namespace {

constexpr float kLeastFace_m = 0.01F;
// The band of a line that meets a face at 22° or more ends within so many half widths.
constexpr float kReach = 2.5F;

/// What parts at both ends of a segment may differ in height, and the shares that have it.
struct NearFaces {
  float start_share = 0.0F, start_m = 0.0F;
  float end_share = 0.0F, end_m = 0.0F;
};

float PlanLength(const InkSegment& segment) {
  return glm::length(glm::vec2(segment.to_m) - glm::vec2(segment.from_m));
}

/// As CoverageOfSegment() of shaders/ink_coverage.glsl tells them.
bool IsFace(const InkSegment& segment) {
  const float climb_m = std::fabs(segment.to_m.z - segment.from_m.z);
  return climb_m > kLeastFace_m && PlanLength(segment) <= 1e-3F * climb_m;
}

/// Marks the way from a face forward or backward.
void Mark(const std::vector<InkSegment>& segments, std::size_t face, float half_width_m,
          bool forward, std::vector<NearFaces>* near) {
  const float climb_m = std::fabs(segments[face].to_m.z - segments[face].from_m.z);
  float left_m = kReach * half_width_m;
  for (std::size_t i = face; left_m > 0.0F;) {
    if (forward ? i + 1 == segments.size() : i == 0) return;
    i = forward ? i + 1 : i - 1;
    const float length_m = PlanLength(segments[i]);
    const float share = length_m > left_m ? left_m / length_m : 1.0F;
    NearFaces& marked = (*near)[i];
    if (forward) {
      marked.start_share = std::max(marked.start_share, share);
      marked.start_m = std::max(marked.start_m, climb_m);
    } else {
      marked.end_share = std::max(marked.end_share, share);
      marked.end_m = std::max(marked.end_m, climb_m);
    }
    left_m -= length_m;
  }
}

}  // namespace

std::vector<InkPart> PartsOfLine(const std::vector<InkSegment>& segments, float half_width_m) {
  std::vector<NearFaces> near(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (!IsFace(segments[i])) continue;
    Mark(segments, i, half_width_m, true, &near);
    Mark(segments, i, half_width_m, false, &near);
  }
  std::vector<InkPart> parts;
  parts.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const InkSegment& segment = segments[i];
    const auto add = [&](float begin, float end, float differs_m) {
      if (end <= begin) return;
      const float way_m = segment.from_arc_m + begin * (segment.to_arc_m - segment.from_arc_m);
      parts.push_back({glm::vec4(glm::mix(segment.from_m, segment.to_m, begin), way_m),
                       glm::vec4(glm::mix(segment.from_m, segment.to_m, end), differs_m)});
    };
    if (IsFace(segment) || PlanLength(segment) == 0.0F) {
      add(0.0F, 1.0F, 0.0F);
      continue;
    }
    const NearFaces& marked = near[i];
    const float middle_begin = marked.start_share, middle_end = 1.0F - marked.end_share;
    if (middle_end <= middle_begin) {
      add(0.0F, 1.0F, std::max(marked.start_m, marked.end_m));
      continue;
    }
    add(0.0F, middle_begin, marked.start_m);
    add(middle_begin, middle_end, 0.0F);
    add(middle_end, 1.0F, marked.end_m);
  }
  return parts;
}

}  // namespace pleinair::compositor
