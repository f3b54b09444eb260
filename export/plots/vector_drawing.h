#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/vector.h"

namespace pleinair::exports {

/// sRGB, 8 bits per channel.
struct DrawingColor {
  std::uint8_t r = 0, g = 0, b = 0;
};

/// An open polyline; a closed one repeats its first point.
struct DrawingLine {
  std::vector<Vec2> points;
  DrawingColor color;
  double width = 1.0;
  bool dashed = false;
};

struct DrawingDisc {
  Vec2 centre;
  double radius = 1.0;
  DrawingColor fill;
};

/// One line of ASCII text, centred on `centre`, with a white halo for readability over lines.
struct DrawingText {
  Vec2 centre;
  double size = 12.0;  ///< Font size.
  std::string text;
  DrawingColor color;
};

/// A drawing of colored lines on white, in its own units: x right, y down, from the top-left
/// corner. Lines are drawn first, then discs, then texts, each in order.
struct VectorDrawing {
  double width = 0.0, height = 0.0;
  std::string title;
  std::vector<DrawingLine> lines;
  std::vector<DrawingDisc> discs;
  std::vector<DrawingText> texts;
};

/// SVG 1.1, `width_px` wide. Coordinates are rounded, so that equal drawings give equal bytes.
std::string DrawingSvg(const VectorDrawing& drawing, int width_px);

/// The same as an 8-bit sRGB image.
RgbImage RasterizeDrawing(const VectorDrawing& drawing, int width_px);

}  // namespace pleinair::exports
