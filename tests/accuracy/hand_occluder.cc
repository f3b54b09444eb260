#include "tests/accuracy/hand_occluder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/srgb.h"
#include "base/units.h"

namespace pleinair::accuracy {
namespace {

/// A cone with round ends, seen from above; palm widths.
struct RoundCone {
  Vec2 from, to;
  double from_radius, to_radius;
};

/// Geometry of the hand at one point, in palm widths: signed distance to the outline (negative
/// inside), height above the outline's plane, and surface slope.
struct Surface {
  double distance = 1e9;
  double height = 0.0;
  Vec2 slope;  ///< x and y of the unit normal.
};

Vec2 Turned(Vec2 v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

double Smooth(double from, double to, double value) {
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Palm, fingers of two parts each, thumb and forearm. y points to the fingertips, x away from the
/// thumb.
std::vector<RoundCone> HandParts(double spread) {
  std::vector<RoundCone> parts;
  for (const double x : {-0.27, -0.09, 0.09, 0.27}) {
    parts.push_back({{x * 0.8, -0.5}, {x, 0.4}, 0.24, 0.2});
  }
  constexpr std::array<double, 4> kLengths{0.95, 1.08, 1.0, 0.78};
  for (int i = 0; i < 4; ++i) {
    const Vec2 knuckle{-0.36 + 0.24 * i, 0.5 - 0.05 * std::abs(i - 1)};
    const double lean = (i - 1.4) * (0.04 + 0.22 * spread);
    const Vec2 along = Turned({0, 1}, -lean);
    const Vec2 joint = knuckle + along * (0.55 * kLengths[i]);
    const Vec2 tip = joint + Turned(along, -0.05 * (i - 1)) * (0.45 * kLengths[i]);
    parts.push_back({knuckle, joint, 0.125, 0.11});
    parts.push_back({joint, tip, 0.11, 0.085});
  }
  const double thumb = 0.35 + 0.4 * spread;
  const Vec2 base{-0.4, -0.35}, joint = base + Turned({0, 0.55}, thumb);
  parts.push_back({base, joint, 0.19, 0.13});
  parts.push_back({joint, joint + Turned({0, 0.4}, thumb * 0.6), 0.13, 0.1});
  parts.push_back({{0.0, -0.6}, {0.1, -1.4}, 0.33, 0.3});
  parts.push_back({{0.1, -1.4}, {0.6, -9.0}, 0.3, 0.62});
  return parts;
}

Surface SurfaceAt(const std::vector<RoundCone>& parts, Vec2 at) {
  Surface surface;
  for (const RoundCone& part : parts) {
    const Vec2 axis = part.to - part.from, to = at - part.from;
    const double t =
        std::clamp((to.x * axis.x + to.y * axis.y) / (axis.x * axis.x + axis.y * axis.y), 0.0, 1.0);
    const double radius = std::lerp(part.from_radius, part.to_radius, t);
    const Vec2 off = to - axis * t;
    const double away = Norm(off);
    surface.distance = std::min(surface.distance, away - radius);
    const double height = away < radius ? std::sqrt(radius * radius - away * away) : 0.0;
    if (height > surface.height) {
      surface.height = height;
      surface.slope = off * (1 / radius);
    }
  }
  return surface;
}

/// Light reflected by the skin, display-linear BGR, in the recordings' sunlight. White paper has
/// about 0.9 there.
std::array<double, 3> SkinLight(const Surface& surface, Vec2 at, double turn) {
  const Vec2 slope = Turned(surface.slope, turn);  // x right and y up in the image.
  const double up = std::sqrt(std::max(0.0, 1 - slope.x * slope.x - slope.y * slope.y));
  constexpr double kSunX = -0.45, kSunY = 0.55, kSunUp = 0.70;
  const double lambert = std::max(0.0, kSunX * slope.x + kSunY * slope.y + kSunUp * up);
  // Less of the sky is visible between the fingers and along the outline.
  const double open = Smooth(-0.02, -0.12, surface.distance);
  const double light = 0.16 * (0.35 + 0.65 * open) * (0.5 + 0.5 * up) + 0.95 * lambert;
  // Creases and blotches make the skin uneven.
  const double grain = 1 + 0.05 * std::sin(9 * at.x + 4 * std::sin(5 * at.y)) +
                       0.04 * std::sin(31 * at.y + 3 * std::sin(11 * at.x));
  const double redness = Smooth(1.0, 1.5, at.y);  // Fingertips.
  return {light * grain * (0.20 + 0.01 * redness), light * grain * (0.28 - 0.02 * redness),
          light * grain * (0.50 + 0.05 * redness)};
}

}  // namespace

cv::Mat PaintHand(const HandPlace& place, cv::Mat* bgr) {
  const std::vector<RoundCone> parts = HandParts(place.spread);
  const Vec2 shadow_offset{0.20, -0.16};  // Right and down, away from the sun; palm widths, y up.
  cv::Mat covered(bgr->size(), CV_32F);
  const auto& linear = LinearFromSrgb8();
  for (int y = 0; y < bgr->rows; ++y) {
    for (int x = 0; x < bgr->cols; ++x) {
      const Vec2 in_picture{(x - place.palm_px.x) / place.palm_width_px,
                            (place.palm_px.y - y) / place.palm_width_px};
      const Vec2 at = Turned(in_picture, place.turn);
      const Surface hand = SurfaceAt(parts, at);
      const double alpha = std::clamp(0.5 - hand.distance * place.palm_width_px, 0.0, 1.0);
      const double shaded =
          SurfaceAt(parts, Turned(in_picture - shadow_offset, place.turn)).distance;
      const double sunlit = std::lerp(0.25, 1.0, Smooth(-0.03, 0.03, shaded));
      covered.at<float>(y, x) = static_cast<float>(alpha);
      if (alpha == 0.0 && sunlit == 1.0) continue;
      const std::array<double, 3> skin = SkinLight(hand, at, -place.turn);
      cv::Vec3b& pixel = bgr->at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c) {
        pixel[c] = Srgb8FromLinear(std::lerp(linear[pixel[c]] * sunlit, skin[c], alpha));
      }
    }
  }
  return covered;
}

HandPlace PassingHand(double share, Vec2 middle_px, double side_px) {
  // Enters over the lower right corner, crosses the marker to its left half and leaves downwards.
  struct Key {
    double share, x, y, turn, spread;  // x right, y down, sides of the marker.
  };
  constexpr std::array<Key, 6> kKeys{{{0.00, 2.9, 2.2, -1.0, 0.2},
                                      {0.25, 0.75, 0.75, -0.75, 0.8},
                                      {0.45, 0.58, 0.35, -0.55, 0.9},
                                      {0.60, 0.10, 0.72, -0.10, 0.6},
                                      {0.75, -0.65, 0.70, 0.25, 0.3},
                                      {1.00, -1.4, 3.2, 0.35, 0.1}}};
  std::size_t next = 1;
  while (next + 1 < kKeys.size() && share > kKeys[next].share) ++next;
  const Key &a = kKeys[next - 1], &b = kKeys[next];
  const double t = Smooth(a.share, b.share, share);
  const auto mix = [t](double from, double to) { return std::lerp(from, to, t); };
  return {{middle_px.x + side_px * mix(a.x, b.x), middle_px.y + side_px * mix(a.y, b.y)},
          0.70 * side_px,
          mix(a.turn, b.turn),
          mix(a.spread, b.spread)};
}

}  // namespace pleinair::accuracy
