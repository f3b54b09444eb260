#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "compositor/ink/ink_shape.h"

namespace pleinair::compositor {

/// A segment as shaders/ink_coverage.glsl takes it. Map coordinates, metres.
struct InkPart {
  glm::vec4 from;  ///< w: way along the line.
  glm::vec4 to;    ///< w: by how much surfaces may differ from the segment's height.
};

/// The segments of a line. Where it climbs a vertical face, its band on one side reaches beside
/// segments on the other. Parts near a face therefore count on surfaces within
/// the height of the face. `half_width_m`: of the band.
std::vector<InkPart> PartsOfLine(const std::vector<InkSegment>& segments, float half_width_m);

}  // namespace pleinair::compositor
