#include "tracker/quads/quad_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/srgb.h"
#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

/// Pixel value at a position, bilinear; positions outside are clamped to the image.
float Sample(ImageView<const std::uint8_t> grey, float x, float y) {
  x = std::clamp(x, 0.0F, static_cast<float>(grey.width()) - 1.001F);
  y = std::clamp(y, 0.0F, static_cast<float>(grey.height()) - 1.001F);
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const float fx = x - static_cast<float>(column), fy = y - static_cast<float>(row);
  const std::uint8_t* upper = grey.row(row) + column;
  const std::uint8_t* lower = upper + grey.stride();
  const float above = static_cast<float>(upper[0]) + fx * static_cast<float>(upper[1] - upper[0]);
  const float below = static_cast<float>(lower[0]) + fx * static_cast<float>(lower[1] - lower[0]);
  return above + fy * (below - above);
}

constexpr int kMaxSteps = 12;     ///< Search range for edges on either side of a side, pixels.
constexpr int kMaxStretches = 8;  ///< Segments of a side, each with its own edge.

/// Nearest pixel; faster than std::lround. Positions outside the image need only stay outside.
int Nearest(double position) {
  const double above = position + 0.5;
  return static_cast<int>(above);
}

struct Line {
  Vec2 point, direction;
};

/// Weighted total least squares.
class LineFit {
 public:
  void Add(double x, double y, double weight) {
    w_ += weight;
    x_ += weight * x;
    y_ += weight * y;
    xx_ += weight * x * x;
    xy_ += weight * x * y;
    yy_ += weight * y * y;
  }
  std::optional<Line> Fit() const {
    if (w_ <= 0.0) return std::nullopt;
    const double mx = x_ / w_, my = y_ / w_;
    const double cxx = xx_ / w_ - mx * mx, cxy = xy_ / w_ - mx * my, cyy = yy_ / w_ - my * my;
    const double angle = 0.5 * std::atan2(2.0 * cxy, cxx - cyy);
    return Line{{mx, my}, {std::cos(angle), std::sin(angle)}};
  }

 private:
  double w_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0, yy_ = 0;
};

double Cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

bool ConvexInside(const std::array<Vec2, 4>& quad, int width, int height) {
  for (int i = 0; i < 4; ++i) {
    const Vec2 p = quad[i];
    if (!(p.x > -0.5 && p.y > -0.5 && p.x < width - 0.5 && p.y < height - 0.5)) return false;
    const Vec2 before = p - quad[(i + 3) % 4], after = quad[(i + 1) % 4] - p;
    if (!(Cross(before, after) > 0.05 * Norm(before) * Norm(after))) return false;
  }
  return true;
}

/// The line near from + t·along where the intensity rises most to the left of `along`. Steps along
/// rows or columns, whichever is closer to the side's direction, so that no interpolation is
/// needed.
std::optional<Line> SteepestLine(ImageView<const std::uint8_t> grey, Vec2 from, Vec2 along,
                                 double reach_px, int max_samples) {
  const std::array<float, 256>& light = LinearFromSrgb8();
  const bool upright = std::fabs(along.y) > std::fabs(along.x);
  // u runs along the side's longer coordinate, v across it.
  const double from_u = upright ? from.y : from.x, from_v = upright ? from.x : from.y;
  const double along_u = upright ? along.y : along.x, along_v = upright ? along.x : along.y;
  const int size_u = upright ? grey.height() : grey.width();
  const int size_v = upright ? grey.width() : grey.height();
  const std::ptrdiff_t step_u = upright ? grey.stride() : 1, step_v = upright ? 1 : grey.stride();
  const double slope = along_v / along_u;
  // Outside is above a side that runs to the right, and right of one that runs down.
  const bool outside_is_behind = upright ? along_u < 0.0 : along_u > 0.0;
  const int steps =
      std::clamp(static_cast<int>(std::lround(reach_px * std::hypot(1.0, slope))), 2, kMaxSteps);

  // Intensity is summed along segments of the side before the search across it, so that noise is
  // small relative to the edge. (Clipping at zero of noisy gradients would bias the edge towards
  // the initial position.)
  const int samples = std::max(4, static_cast<int>(std::fabs(along_u)));
  const int per_stretch = std::clamp((samples + 3) / 4, 1, max_samples / 4);
  const int stretches = std::min(samples / per_stretch, kMaxStretches);
  LineFit fit;
  for (int i = 0; i < stretches; ++i) {
    std::array<float, 2 * kMaxSteps + 1> profile{};
    double mean_u = 0.0, mean_v = 0.0;
    for (int j = 0; j < per_stretch; ++j) {
      const double at = 0.08 + 0.84 * (i * per_stretch + j + 0.5) / (stretches * per_stretch);
      const int u = std::clamp(Nearest(from_u + at * along_u), 0, size_u - 1);
      const int v = Nearest(from_v + (u - from_u) * slope);
      // The image is extended by its last row or column.
      const std::uint8_t* pixels = grey.data() + u * step_u;
      if (v >= steps && v + steps < size_v) {
        const std::uint8_t* pixel = pixels + (v - steps) * step_v;
        for (int k = 0; k <= 2 * steps; ++k, pixel += step_v) profile[k] += light[*pixel];
      } else {
        for (int k = -steps; k <= steps; ++k) {
          profile[k + steps] += light[pixels[std::clamp(v + k, 0, size_v - 1) * step_v]];
        }
      }
      mean_u += u;
      mean_v += v;
    }
    mean_u /= per_stretch;
    mean_v /= per_stretch;
    float moment = 0.0F, sum = 0.0F;
    for (int k = 0; k < 2 * steps; ++k) {
      const float change = profile[k + 1] - profile[k];
      const float rise = std::max(outside_is_behind ? -change : change, 0.0F);
      sum += rise;
      moment += rise * static_cast<float>(k - steps);
    }
    if (sum <= 0.0F) continue;
    const double edge = mean_v + 0.5 + moment / sum;
    fit.Add(upright ? edge : mean_u, upright ? mean_u : edge, sum);
  }
  return fit.Fit();
}

}  // namespace

bool RefineQuad(ImageView<const std::uint8_t> grey, double reach_px, int samples,
                std::array<Vec2, 4>* corners) {
  std::array<Vec2, 4>& quad = *corners;
  const double twice_area = Cross(quad[2] - quad[0], quad[3] - quad[1]);
  std::array<Line, 4> lines;
  for (int side = 0; side < 4; ++side) {
    const Vec2 from = quad[side], along = quad[(side + 1) % 4] - from;
    // The quiet zone and the border are each a tenth of the width across.
    const double across = 0.5 * twice_area / Norm(along);
    const double reach = std::clamp(0.08 * across, 1.5, reach_px);
    const auto line = SteepestLine(grey, from, along, reach, samples);
    if (!line) return false;
    lines[side] = *line;
  }
  std::array<Vec2, 4> refined;
  for (int i = 0; i < 4; ++i) {
    const Line &before = lines[(i + 3) % 4], &after = lines[i];
    const double cross = Cross(before.direction, after.direction);
    if (std::fabs(cross) < 0.05) return false;
    const double s = Cross(after.point - before.point, after.direction) / cross;
    refined[i] = before.point + before.direction * s;
  }
  if (!ConvexInside(refined, grey.width(), grey.height())) return false;
  quad = refined;
  return true;
}

RimEvidence SampleRim(ImageView<const std::uint8_t> grey, const std::array<Vec2, 4>& corners) {
  constexpr int kSamples = 12;
  constexpr double kMiddle = 0.1;  // Half the width of border and quiet zone, in half edges.
  const Mat3 image_from_marker = HomographyToQuad(corners);
  const auto sample = [&](Vec2 at) {
    const Vec2 p = Apply(image_from_marker, at);
    return Sample(grey, static_cast<float>(p.x), static_cast<float>(p.y));
  };
  RimEvidence evidence;
  evidence.min_side = 1.0F;
  float steps = 0.0F, ratios = 0.0F, squares = 0.0F;
  for (int side = 0; side < 4; ++side) {
    float side_whites = 0.0F, side_steps = 0.0F;
    for (int i = 0; i < kSamples; ++i) {
      const double t = -0.9 + 1.8 * (i + 0.5) / kSamples;
      const auto around = [&](double r) {
        switch (side) {
          case 0:
            return Vec2{t, r};
          case 1:
            return Vec2{r, t};
          case 2:
            return Vec2{t, -r};
          default:
            return Vec2{-r, t};
        }
      };
      const float white = sample(around(1.0 + kMiddle)), black = sample(around(1.0 - kMiddle));
      side_whites += white;
      side_steps += white - black;
      const float ratio = black / std::max(white, 1.0F);
      ratios += ratio;
      squares += ratio * ratio;
    }
    steps += side_steps;
    evidence.min_side = std::min(evidence.min_side, side_steps / std::max(side_whites, 1.0F));
  }
  constexpr float kPairs = 4.0F * kSamples;
  evidence.contrast = steps / kPairs;
  evidence.ratio = ratios / kPairs;
  const float variance = squares / kPairs - evidence.ratio * evidence.ratio;
  evidence.spread = std::sqrt(std::max(variance, 0.0F)) / std::max(1.0F - evidence.ratio, 1e-3F);
  return evidence;
}

}  // namespace pleinair::tracker
