#include "tracker/quads/quad_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/srgb.h"
#include "tracker/homography.h"

namespace pleinair::tracker {
namespace {

/// Bilinear samples; positions outside are moved to the border.
template <class Table>
float Sample(ImageView<const std::uint8_t> grey, float x, float y, const Table& table) {
  x = std::clamp(x, 0.0F, static_cast<float>(grey.width()) - 1.001F);
  y = std::clamp(y, 0.0F, static_cast<float>(grey.height()) - 1.001F);
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const float fx = x - static_cast<float>(column), fy = y - static_cast<float>(row);
  const std::uint8_t* upper = grey.row(row) + column;
  const std::uint8_t* lower = upper + grey.stride();
  const float above = table(upper[0]) + fx * (table(upper[1]) - table(upper[0]));
  const float below = table(lower[0]) + fx * (table(lower[1]) - table(lower[0]));
  return above + fy * (below - above);
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

}  // namespace

bool RefineQuad(ImageView<const std::uint8_t> grey, double reach_px, std::array<Vec2, 4>* corners) {
  const std::array<float, 256>& light = LinearFromSrgb8();
  const auto linear = [&](std::uint8_t code) { return light[code]; };
  std::array<Vec2, 4>& quad = *corners;
  const double twice_area = Cross(quad[2] - quad[0], quad[3] - quad[1]);
  std::array<Line, 4> lines;
  for (int side = 0; side < 4; ++side) {
    const Vec2 from = quad[side], along = quad[(side + 1) % 4] - from;
    const double length = Norm(along);
    const Vec2 outward = Vec2{along.y, -along.x} * (1.0 / length);
    // The quiet zone and the rim are each a tenth of what lies across.
    const double across = 0.5 * twice_area / length;
    const double reach = std::clamp(0.08 * across, 1.5, reach_px);
    const int steps = static_cast<int>(std::lround(reach));
    const int samples = std::clamp(static_cast<int>(length / 2.0), 6, 20);
    LineFit fit;
    for (int i = 0; i < samples; ++i) {
      const double at = 0.08 + 0.84 * (i + 0.5) / samples;
      const Vec2 middle = from + along * at;
      float moment = 0.0F, sum = 0.0F;
      const auto value = [&](double offset) {
        return Sample(grey, static_cast<float>(middle.x + offset * outward.x),
                      static_cast<float>(middle.y + offset * outward.y), linear);
      };
      float inner = value(-steps - 0.5);
      for (int k = -steps; k <= steps; ++k) {
        const float outer = value(k + 0.5);
        const float rise = std::max(outer - inner, 0.0F);
        sum += rise;
        moment += rise * static_cast<float>(k);
        inner = outer;
      }
      if (sum <= 0.0F) continue;
      const double offset = moment / sum;
      fit.Add(middle.x + offset * outward.x, middle.y + offset * outward.y, sum);
    }
    const auto line = fit.Fit();
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
  constexpr double kMiddle = 0.1;  // Half of the rim's and the quiet zone's width, in half edges.
  const auto code = [](std::uint8_t value) { return static_cast<float>(value); };
  const Mat3 picture_from_marker = HomographyToQuad(corners);
  const auto sample = [&](Vec2 at) {
    const Vec2 p = Apply(picture_from_marker, at);
    return Sample(grey, static_cast<float>(p.x), static_cast<float>(p.y), code);
  };
  RimEvidence evidence;
  evidence.least_side = 1.0F;
  float sum = 0.0F;
  int dark = 0;
  for (int side = 0; side < 4; ++side) {
    std::array<float, kSamples> steps;
    float outside = 0.0F, step_sum = 0.0F;
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
      steps[i] = white - black;
      outside += white;
      step_sum += steps[i];
    }
    for (const float step : steps) dark += step > 0.5F * step_sum / kSamples ? 1 : 0;
    evidence.least_side = std::min(evidence.least_side, step_sum / std::max(outside, 1.0F));
    sum += step_sum;
  }
  evidence.contrast = sum / (4.0F * kSamples);
  evidence.share_dark = static_cast<float>(dark) / (4.0F * kSamples);
  return evidence;
}

}  // namespace pleinair::tracker
