#include "app/window/window_layout.h"

#include <algorithm>

namespace pleinair::app {
namespace {

// In font heights: width of the panel beside the image, and its min. visible height below.
constexpr double kPanelWidth = 21.0, kPanelHeight = 14.0;
// Min. image size beside or below the panel, as a fraction of the maximum size.
constexpr double kMin = 0.4;
// Max. share of the window's width for a panel over the image.
constexpr double kOver = 0.8;

/// Image scale in an area; 0 for an empty area.
double Scale(Vec2 area, Vec2 picture) {
  return std::max(0.0, std::min(area.x / picture.x, area.y / picture.y));
}

}  // namespace

WindowLayout WindowLayout::For(Vec2 window, double letter, bool panel, Vec2 picture) {
  const Vec2 all{window.x, std::max(window.y - letter * kStatusHeight, 1.0)};
  if (!panel) return {all, {}, {}};
  const double width = letter * kPanelWidth;
  const Vec2 beside{all.x - width, all.y}, above{all.x, all.y - letter * kPanelHeight};
  const double scale_beside = Scale(beside, picture), scale_above = Scale(above, picture);
  if (std::max(scale_beside, scale_above) < kMin * Scale(all, picture)) {
    const double over = std::min(width, window.x * kOver);
    return {all, {window.x - over, 0.0}, {over, window.y}};
  }
  if (scale_beside >= scale_above) return {beside, {beside.x, 0.0}, {width, window.y}};
  // At most the height of the image.
  const double height = std::min(above.y, picture.y * scale_above);
  const double top = height + letter * kStatusHeight;
  return {{all.x, height}, {0.0, top}, {all.x, window.y - top}};
}

bool WindowLayout::OnPanel(Vec2 screen) const {
  const Vec2 inside = screen - panel_corner;
  return inside.x >= 0.0 && inside.y >= 0.0 && inside.x < panel_size.x && inside.y < panel_size.y;
}

}  // namespace pleinair::app
