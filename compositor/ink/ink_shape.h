#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "base/vector.h"

namespace pleinair::compositor {

/// How ink changes the picture of a real surface; `a` is coverage times opacity, all in linear
/// light.
enum class InkBlend {
  kStain,  ///< Camera pixel × mix(1, color, a). Texture, grain and real shadows stay.
  kPaint,  ///< mix(camera pixel, color / π × irradiance of the surface × exposure, a).
  kGlow,   ///< mix(camera pixel, color, a): unlit.
};

struct InkStyle {
  LinearRgb color;  ///< Linear Rec.709: factor (stain), reflectance (paint), light (glow).
  float opacity = 1.0F;
  InkBlend blend = InkBlend::kStain;
};

/// A straight part of a line that lies on a surface. Equal ends: a disc.
struct InkSegment {
  glm::vec3 from_m{0.0F}, to_m{0.0F};        ///< Map coordinates: InkGrid.
  float from_arc_m = 0.0F, to_arc_m = 0.0F;  ///< Way along the line, for dashes.
};

/// What a line is drawn with.
struct InkPen {
  float width_m = 0.0F;               ///< Across the line, seen from above.
  float width_px = 0.0F;              ///< Camera pixels, if width_m is 0.
  float dash_m = 0.0F, gap_m = 0.0F;  ///< Along the line. No gap: it is continuous.
};

/// Ink of one kind on the real surfaces: lines, or an area if there are rings. Within a shape,
/// opacity does not add up where parts overlap.
struct InkShape {
  InkStyle style;
  InkPen pen = {};
  std::vector<InkSegment> segments = {};
  /// Closed; outer rings counter-clockwise seen from above, holes clockwise. East and north,
  /// metres.
  std::vector<std::vector<glm::vec2>> rings = {};
};

}  // namespace pleinair::compositor
