#include "compositor/picture_look.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/vector.h"
#include "compositor/quantile.h"

namespace pleinair::compositor {
namespace {

constexpr int kStripesPerSide = 48;
constexpr double kNarrowestBandPx = 5.0;
constexpr double kFarthestPx = 14.0;  // From an edge: a blur of a third of it still shows whole.
constexpr int kFewestPixels = 40;     // Of a side's edge.
constexpr int kFewestPairs = 150;     // Of a level's noise.
constexpr double kBadFit = 0.12;      // RMS of a side's fit, of the step from black to white.
constexpr double kLeastBlurPx = 0.2;
// Noise: the largest 5 % of the differences are something else's; a normal distribution cut at
// 1.96 standard deviations keeps 0.7588 of its variance.
constexpr double kKept = 0.95, kKeptVariance = 0.7588;
constexpr double kTooFarFromMedian = 0.35;
constexpr double kClipped = 250.0 / 255.0;
// The smoothest blocks of a picture have no more noise than the camera makes (after Liu, Freeman,
// Szeliski & Kang 2006, "Noise Estimation from a Single Image"): of pure noise, the block that one
// in fifty is smoother than has so much of the variance.
constexpr int kBlock = 8;
// Nearer to an edge than a compressed block is wide, what compression leaves of the edge passes
// for noise of about so many steps of 8 bits.
constexpr double kBlockReachPx = 8.5, kEdgeSteps = 3.0;
constexpr double kSmoothest = 0.02, kSmoothestVariance = 0.62;
constexpr int kMostBlocks = 1200, kFewestBlocks = 60;
constexpr int kDarkestGrey = 25, kBrightestGrey = 235;

double Gauss(double t) { return std::exp(-t * t / 2) / std::sqrt(2 * std::numbers::pi); }
double GaussIntegral(double t) { return 0.5 * std::erfc(-t / std::numbers::sqrt2); }

/// A pixel near an edge: distance across it, towards the white, and brightness.
struct EdgePixel {
  double distance_px, value;
};

/// Least squares of black + (white − black) Φ((d − shift) / blur), Gauss–Newton with steps kept
/// small (Levenberg 1944); nothing where the pixels are no such edge.
std::optional<double> FitBlur(const std::vector<EdgePixel>& pixels) {
  double shift = 0.0, blur = 0.7, damping = 1e-3;
  const auto cost_of = [&](double s, double b) {
    double cost = 0.0;
    for (const EdgePixel& p : pixels) {
      const double r = p.value - GaussIntegral((p.distance_px - s) / b);
      cost += r * r;
    }
    return cost;
  };
  double cost = cost_of(shift, blur);
  for (int iteration = 0; iteration < 30; ++iteration) {
    double a00 = 0.0, a01 = 0.0, a11 = 0.0, g0 = 0.0, g1 = 0.0;
    for (const EdgePixel& p : pixels) {
      const double t = (p.distance_px - shift) / blur;
      const double residual = p.value - GaussIntegral(t);
      const double by_shift = -Gauss(t) / blur, by_blur = -Gauss(t) * t / blur;
      a00 += by_shift * by_shift;
      a01 += by_shift * by_blur;
      a11 += by_blur * by_blur;
      g0 += by_shift * residual;
      g1 += by_blur * residual;
    }
    const double b00 = a00 * (1 + damping), b11 = a11 * (1 + damping);
    const double determinant = b00 * b11 - a01 * a01;
    if (!(determinant > 0.0)) return std::nullopt;
    const double new_shift = shift + (b11 * g0 - a01 * g1) / determinant;
    const double new_blur = std::max(kLeastBlurPx, blur + (b00 * g1 - a01 * g0) / determinant);
    const double new_cost = cost_of(new_shift, new_blur);
    if (new_cost > cost) {
      damping = damping * 10 + 1e-6;
      if (damping > 1e6) break;
      continue;
    }
    const bool still = std::fabs(new_blur - blur) + std::fabs(new_shift - shift) < 1e-4;
    shift = new_shift;
    blur = new_blur;
    cost = new_cost;
    damping *= 0.3;
    if (still) break;
  }
  if (std::sqrt(cost / static_cast<double>(pixels.size())) > kBadFit) return std::nullopt;
  return blur;
}

/// The print in one frame.
class PrintInPicture {
 public:
  PrintInPicture(ImageView<const std::uint8_t> rgb, const CameraModel& camera,
                 const Transform<Camera, Marker>& pose, const MarkerPrint& print,
                 const CameraResponse& response)
      : rgb_(rgb), camera_(camera), pose_(pose), print_(print), response_(response) {
    const double margin_m = (print.board_size_m - print.size_m) / 2;
    white_m_ = margin_m > 0.0 ? margin_m : print.black_band_m;
    band_m_ = std::min(white_m_, print.black_band_m);
  }

  /// Blur of every side that shows well enough.
  std::vector<double> BlurOfSides() const {
    std::vector<double> blurs;
    for (int side = 0; side < 4; ++side) {
      std::vector<EdgePixel> pixels;
      for (int i = 0; i < kStripesPerSide; ++i) {
        // Away from the corners, where two edges meet.
        AddStripe(side, 0.8 * (2.0 * (i + 0.5) / kStripesPerSide - 1.0), &pixels);
      }
      if (static_cast<int>(pixels.size()) < kFewestPixels) continue;
      if (const auto blur = FitBlur(pixels)) blurs.push_back(*blur);
    }
    return blurs;
  }

  bool MeasureNoise(double blur_px, PictureLook* look) const;
  /// Noise of the picture's smoothest blocks over `look`'s, variances; at most 1.
  double NoiseOfSmoothest(const PictureLook& look) const;

 private:
  struct Level {
    std::array<double, 3> light{}, variance{};
    double neighbour = 0.0, channel = 0.0;
  };

  std::optional<Vec2> PixelOf(Vec2 on_print) const {
    const Point<Camera> p = pose_ * Point<Marker>{{on_print.x, on_print.y, 0.0}};
    if (p.xyz.z <= 0.0) return std::nullopt;
    return ProjectToPixel(camera_, p);
  }
  bool IsInside(int x, int y) const {
    return x >= 0 && y >= 0 && x < rgb_.width() && y < rgb_.height();
  }
  double Light(int x, int y, int c) const { return response_.Linear(c)[rgb_(x, y, c)]; }
  double Grey(int x, int y) const { return (Light(x, y, 0) + Light(x, y, 1) + Light(x, y, 2)) / 3; }

  /// Variance that rounding to codes adds: a twelfth of a step squared.
  double RoundingAt(int c, double light) const {
    const auto& table = response_.Linear(c);
    const auto above = std::upper_bound(table.begin(), table.end(), static_cast<float>(light));
    const auto code = std::clamp<std::ptrdiff_t>(above - table.begin(), 1, 255);
    const double step = table[code] - table[code - 1];
    return step * step / 12;
  }

  void AddStripe(int side, double along, std::vector<EdgePixel>* pixels) const {
    const double c = std::array{1.0, 0.0, -1.0, 0.0}[side];
    const double s = std::array{0.0, 1.0, 0.0, -1.0}[side];
    const double half = print_.size_m / 2;
    const auto at = [&](double x, double y) { return PixelOf({c * x - s * y, s * x + c * y}); };
    const auto edge = at(along * half, half), beside = at((along + 0.01) * half, half);
    const auto outer = at(along * half, half + band_m_ / 2);
    const auto inner = at(along * half, half - band_m_ / 2);
    if (!edge || !beside || !outer || !inner) return;
    const Vec2 step = *beside - *edge;
    if (!(Norm(step) > 0.0)) return;
    const Vec2 tangent = step * (1.0 / Norm(step));
    Vec2 normal{-tangent.y, tangent.x};
    const Vec2 outwards = *outer - *inner;
    if (normal.x * outwards.x + normal.y * outwards.y < 0.0) normal = normal * -1.0;
    const double band_px = std::fabs(normal.x * outwards.x + normal.y * outwards.y);
    if (band_px < kNarrowestBandPx) return;
    const double reach = std::min(0.9 * band_px, kFarthestPx);
    // The levels on either side, far from the edge, then every pixel whose centre lies in a strip
    // of one pixel's width.
    double white = 0.0, black = 0.0;
    int whites = 0, blacks = 0;
    std::vector<EdgePixel> strip;
    const int x0 = static_cast<int>(std::lround(edge->x)),
              y0 = static_cast<int>(std::lround(edge->y));
    const int r = static_cast<int>(std::ceil(reach)) + 1;
    for (int y = y0 - r; y <= y0 + r; ++y) {
      for (int x = x0 - r; x <= x0 + r; ++x) {
        if (!IsInside(x, y)) continue;
        const Vec2 offset = Vec2{static_cast<double>(x), static_cast<double>(y)} - *edge;
        if (std::fabs(offset.x * tangent.x + offset.y * tangent.y) > 0.5) continue;
        const double distance = offset.x * normal.x + offset.y * normal.y;
        if (std::fabs(distance) > reach) continue;
        if (rgb_(x, y, 0) >= 255 * kClipped || rgb_(x, y, 1) >= 255 * kClipped) return;
        const double value = Grey(x, y);
        strip.push_back({distance, value});
        if (distance > 0.7 * reach) {
          white += value;
          ++whites;
        }
        if (distance < -0.7 * reach) {
          black += value;
          ++blacks;
        }
      }
    }
    if (whites == 0 || blacks == 0) return;
    white /= whites;
    black /= blacks;
    // Paper reflects twenty times what ink does; a hand or a shadow's edge does not look like it.
    if (white < 2.0 * black || white - black < 0.02) return;
    for (const EdgePixel& p : strip) {
      pixels->push_back({p.distance_px, (p.value - black) / (white - black)});
    }
  }

  std::optional<Level> NoiseOf(bool white, double clearance_px) const;

  ImageView<const std::uint8_t> rgb_;
  const CameraModel& camera_;
  const Transform<Camera, Marker>& pose_;
  const MarkerPrint& print_;
  const CameraResponse& response_;
  double white_m_ = 0.0, band_m_ = 0.0;
};

double TrimmedVariance(std::vector<double> differences) {
  for (double& d : differences) d = d * d;
  const auto kept = static_cast<std::size_t>(kKept * static_cast<double>(differences.size()));
  std::nth_element(differences.begin(), differences.begin() + static_cast<std::ptrdiff_t>(kept),
                   differences.end());
  double sum = 0.0;
  for (std::size_t i = 0; i < kept; ++i) sum += differences[i];
  return sum / (static_cast<double>(kept) * kKeptVariance);
}

/// Noise of the middle of the black band or of the white round it, from differences of pixels side
/// by side and three apart: light that changes slowly cancels.
std::optional<PrintInPicture::Level> PrintInPicture::NoiseOf(bool white,
                                                             double clearance_px) const {
  Vec2 low{1e9, 1e9}, high{-1e9, -1e9};
  const double reach = print_.size_m / 2 + white_m_;
  for (const Vec2 corner :
       {Vec2{-reach, -reach}, {reach, -reach}, {reach, reach}, {-reach, reach}}) {
    const auto pixel = PixelOf(corner);
    if (!pixel) return std::nullopt;
    low = {std::min(low.x, pixel->x), std::min(low.y, pixel->y)};
    high = {std::max(high.x, pixel->x), std::max(high.y, pixel->y)};
  }
  const int x0 = std::max(0, static_cast<int>(low.x)), y0 = std::max(0, static_cast<int>(low.y));
  const int x1 = std::min(rgb_.width() - 1, static_cast<int>(high.x) + 1);
  const int y1 = std::min(rgb_.height() - 1, static_cast<int>(high.y) + 1);
  if (x1 - x0 < 8 || y1 - y0 < 8) return std::nullopt;
  const auto from_camera = pose_.Inverse();
  const double footprint_m = Norm(pose_.translation_m) / std::min(camera_.fx, camera_.fy);
  const double clear_m = clearance_px * footprint_m;
  const int columns = x1 - x0 + 1;
  std::vector<std::uint8_t> good(static_cast<std::size_t>(columns) * (y1 - y0 + 1));
  std::vector<double> greys;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Vec2 ray = UndistortPixel(camera_, {static_cast<double>(x), static_cast<double>(y)});
      const Vec3 direction = from_camera.rotation * Vec3{ray.x, ray.y, 1.0};
      const Vec3 eye = from_camera.translation_m;
      if (direction.z == 0.0) continue;
      const double t = -eye.z / direction.z;
      const Vec3 at = eye + direction * t;
      const double outwards = std::max(std::fabs(at.x), std::fabs(at.y)) - print_.size_m / 2;
      const bool inside = white ? outwards > clear_m && outwards < white_m_ - clear_m
                                : outwards < -clear_m && outwards > -print_.black_band_m + clear_m;
      if (!inside || rgb_(x, y, 0) >= 255 * kClipped || rgb_(x, y, 1) >= 255 * kClipped ||
          rgb_(x, y, 2) >= 255 * kClipped) {
        continue;
      }
      good[static_cast<std::size_t>(y - y0) * columns + (x - x0)] = 1;
      greys.push_back(Grey(x, y));
    }
  }
  if (static_cast<int>(greys.size()) < kFewestPairs) return std::nullopt;
  const double usual = Median(greys);
  const auto is_good = [&](int x, int y) {
    return x <= x1 && y <= y1 && good[static_cast<std::size_t>(y - y0) * columns + (x - x0)] != 0 &&
           std::fabs(Grey(x, y) - usual) < kTooFarFromMedian * usual + 0.01;
  };
  std::array<std::vector<double>, 3> beside, apart;
  std::vector<double> sums;
  Level level;
  double count = 0.0;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      if (!is_good(x, y)) continue;
      for (int c = 0; c < 3; ++c) level.light[c] += Light(x, y, c);
      ++count;
      for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, 1}}) {
        for (const int lag : {1, 3}) {
          if (!is_good(x + lag * dx, y + lag * dy)) continue;
          double sum = 0.0;
          for (int c = 0; c < 3; ++c) {
            const double d = Light(x + lag * dx, y + lag * dy, c) - Light(x, y, c);
            (lag == 1 ? beside : apart)[c].push_back(d);
            sum += d;
          }
          if (lag == 3) sums.push_back(sum);
        }
      }
    }
  }
  if (static_cast<int>(apart[0].size()) < kFewestPairs) return std::nullopt;
  double variance_sum = 0.0, root_sum = 0.0, beside_sum = 0.0, apart_sum = 0.0;
  for (int c = 0; c < 3; ++c) {
    level.light[c] /= count;
    const double of_apart = TrimmedVariance(apart[c]) / 2;
    beside_sum += TrimmedVariance(beside[c]) / 2;
    apart_sum += of_apart;
    level.variance[c] = std::max(0.0, of_apart - RoundingAt(c, level.light[c]));
    variance_sum += of_apart;
    root_sum += std::sqrt(of_apart);
  }
  level.neighbour = apart_sum > 0.0 ? std::clamp(1.0 - beside_sum / apart_sum, 0.0, 0.7) : 0.0;
  // Var(r + g + b) = sum of variances + correlation * (square of summed deviations − that sum).
  const double crossed = root_sum * root_sum - variance_sum;
  const double together = TrimmedVariance(sums) / 2 - variance_sum;
  level.channel = crossed > 0.0 ? std::clamp(together / crossed, 0.0, 1.0) : 0.0;
  return level;
}

double PrintInPicture::NoiseOfSmoothest(const PictureLook& look) const {
  const int columns = rgb_.width() / kBlock, rows = rgb_.height() / kBlock;
  const int step = std::max(1, columns * rows / kMostBlocks);
  constexpr int kGreen = 1, kLag = 3;
  std::vector<double> shares;
  for (int block = 0; block < columns * rows; block += step) {
    const int x0 = block % columns * kBlock, y0 = block / columns * kBlock;
    double sum = 0.0, squares = 0.0;
    int count = 0;
    bool usable = true;
    for (int y = y0; y < y0 + kBlock; ++y) {
      for (int x = x0; x < x0 + kBlock; ++x) {
        const int code = rgb_(x, y, kGreen);
        usable = usable && code >= kDarkestGrey && code <= kBrightestGrey;
        const double light = Light(x, y, kGreen);
        sum += light;
        for (const auto& [dx, dy] : {std::pair{kLag, 0}, std::pair{0, kLag}}) {
          if (x + dx >= x0 + kBlock || y + dy >= y0 + kBlock) continue;
          const double d = Light(x + dx, y + dy, kGreen) - light;
          squares += d * d;
          ++count;
        }
      }
    }
    if (!usable) continue;
    const double light = sum / (kBlock * kBlock);
    const double predicted =
        std::pow(look.NoiseSigma(kGreen, light), 2) + RoundingAt(kGreen, light);
    if (predicted > 0.0) shares.push_back(squares / (2 * count) / predicted);
  }
  if (static_cast<int>(shares.size()) < kFewestBlocks) return 1.0;
  const auto at =
      shares.begin() + static_cast<std::ptrdiff_t>(kSmoothest * static_cast<double>(shares.size()));
  std::nth_element(shares.begin(), at, shares.end());
  return std::min(1.0, *at / kSmoothestVariance);
}

bool PrintInPicture::MeasureNoise(double blur_px, PictureLook* look) const {
  // Out of the reach of an edge's compression block, where the print is large enough for that.
  const double near_px = 1.0 + 2.5 * blur_px;
  auto white = NoiseOf(true, std::max(near_px, kBlockReachPx));
  auto black = NoiseOf(false, std::max(near_px, kBlockReachPx));
  for (auto* level : {&white, &black}) {
    if (*level) continue;
    *level = NoiseOf(level == &white, near_px);
    if (!*level) continue;
    for (int c = 0; c < 3; ++c) {
      const double of_edges = 12 * RoundingAt(c, (*level)->light[c]) * kEdgeSteps * kEdgeSteps;
      (*level)->variance[c] = std::max(0.0, (*level)->variance[c] - of_edges);
    }
  }
  if (!white && !black) return false;
  for (int c = 0; c < 3; ++c) {
    if (!white || !black) {
      // One level tells how much there is, not how it grows with light: photon noise.
      const Level& only = white ? *white : *black;
      look->noise_slope[c] = only.light[c] > 0.0 ? only.variance[c] / only.light[c] : 0.0;
      continue;
    }
    const double slope =
        (white->variance[c] - black->variance[c]) / (white->light[c] - black->light[c]);
    look->noise_slope[c] = std::max(0.0, slope);
    look->noise_constant[c] =
        std::max(0.0, black->variance[c] - look->noise_slope[c] * black->light[c]);
  }
  const Level& brighter = white ? *white : *black;
  // What compression leaves around the print's edges is not noise: it is not elsewhere.
  const double share = NoiseOfSmoothest(*look);
  for (int c = 0; c < 3; ++c) {
    look->noise_constant[c] *= share;
    look->noise_slope[c] *= share;
  }
  look->neighbour_correlation = brighter.neighbour;
  look->channel_correlation = brighter.channel;
  return true;
}

}  // namespace

double PictureLook::NoiseSigma(int channel, double light) const {
  return std::sqrt(noise_constant[channel] + noise_slope[channel] * std::max(0.0, light));
}

std::optional<PictureLook> MeasurePictureLook(ImageView<const std::uint8_t> rgb,
                                              const CameraModel& camera,
                                              const Transform<Camera, Marker>& camera_from_marker,
                                              const MarkerPrint& print,
                                              const CameraResponse& response) {
  if (!(print.size_m > 0.0) || !(print.black_band_m > 0.0)) return std::nullopt;
  const PrintInPicture in_picture(rgb, camera, camera_from_marker, print, response);
  const std::vector<double> blurs = in_picture.BlurOfSides();
  if (blurs.size() < 2) return std::nullopt;
  PictureLook look;
  double sum = 0.0;
  for (const double blur : blurs) sum += blur * blur;
  // Motion blurs some sides more than others: their mean square is what one number can say.
  look.blur_px = std::sqrt(sum / static_cast<double>(blurs.size()));
  if (!in_picture.MeasureNoise(look.blur_px, &look)) return std::nullopt;
  return look;
}

}  // namespace pleinair::compositor
