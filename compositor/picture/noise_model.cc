#include "compositor/picture/noise_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/quantile.h"
#include "base/vector.h"

namespace pleinair::compositor {
namespace {

constexpr int kMinPairs = 150;  // For the noise of one level.
// The largest 5 % of the differences have other causes. A normal distribution cut at 1.96 standard
// deviations keeps 0.7588 of its variance.
constexpr double kKept = 0.95, kKeptVariance = 0.7588;
constexpr double kTooFarFromMedian = 0.35;
// The smoothest blocks of an image have only the camera's noise (after Liu, Freeman, Szeliski &
// Kang 2006, "Noise Estimation from a Single Image"). In pure noise, one block in fifty has less
// than kSmoothestVariance of the variance.
constexpr int kBlock = 8;
// Within the width of a compressed block, artefacts of an edge look like noise of about so many
// 8-bit steps.
constexpr double kBlockReach_px = 8.5, kEdgeSteps = 3.0;
constexpr double kSmoothest = 0.02, kSmoothestVariance = 0.62;
constexpr int kMaxBlocks = 1200, kMinBlocks = 60;
constexpr int kDarkestGrey = 25, kBrightestGrey = 235;

/// Light and noise of the band or of the white: variances per channel, correlations.
struct Level {
  std::array<double, 3> light{}, variance{};
  double neighbour = 0.0, channel = 0.0;
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

/// Measures the noise in the middle of the black band or of the white around it. It uses
/// differences of adjacent pixels and of pixels three apart, in which slow changes of light cancel.
std::optional<Level> NoiseOf(const MarkerInImage& marker, bool white, double clearance_px) {
  const int width = marker.rgb().width(), height = marker.rgb().height();
  const double size_m = marker.marker().size_m, white_m = marker.white_m();
  const CameraModel& camera = marker.camera();
  const Transform<Camera, Marker>& pose = marker.camera_from_marker();
  Vec2 low{1e9, 1e9}, high{-1e9, -1e9};
  const double reach = size_m / 2 + white_m;
  for (const Vec2 corner :
       {Vec2{-reach, -reach}, {reach, -reach}, {reach, reach}, {-reach, reach}}) {
    const auto pixel = marker.PixelOf(corner);
    if (!pixel) return std::nullopt;
    low = {std::min(low.x, pixel->x), std::min(low.y, pixel->y)};
    high = {std::max(high.x, pixel->x), std::max(high.y, pixel->y)};
  }
  const int x0 = std::max(0, static_cast<int>(low.x)), y0 = std::max(0, static_cast<int>(low.y));
  const int x1 = std::min(width - 1, static_cast<int>(high.x) + 1);
  const int y1 = std::min(height - 1, static_cast<int>(high.y) + 1);
  if (x1 - x0 < 8 || y1 - y0 < 8) return std::nullopt;
  const auto from_camera = pose.Inverse();
  const double footprint_m = Norm(pose.translation_m) / std::min(camera.fx, camera.fy);
  const double clear_m = clearance_px * footprint_m;
  const int columns = x1 - x0 + 1;
  std::vector<std::uint8_t> good(static_cast<std::size_t>(columns) * (y1 - y0 + 1));
  std::vector<double> greys;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Vec2 ray = UndistortPixel(camera, {static_cast<double>(x), static_cast<double>(y)});
      const Vec3 direction = from_camera.rotation * Vec3{ray.x, ray.y, 1.0};
      const Vec3 eye = from_camera.translation_m;
      if (direction.z == 0.0) continue;
      const double t = -eye.z / direction.z;
      const Vec3 at = eye + direction * t;
      const double outwards = std::max(std::fabs(at.x), std::fabs(at.y)) - size_m / 2;
      const bool inside =
          white ? outwards > clear_m && outwards < white_m - clear_m
                : outwards < -clear_m && outwards > -marker.marker().black_band_m + clear_m;
      if (!inside || marker.IsClipped(x, y, 3)) continue;
      good[static_cast<std::size_t>(y - y0) * columns + (x - x0)] = 1;
      greys.push_back(marker.Grey(x, y));
    }
  }
  if (static_cast<int>(greys.size()) < kMinPairs) return std::nullopt;
  const double usual = Median(greys);
  const auto is_good = [&](int x, int y) {
    return x <= x1 && y <= y1 && good[static_cast<std::size_t>(y - y0) * columns + (x - x0)] != 0 &&
           std::fabs(marker.Grey(x, y) - usual) < kTooFarFromMedian * usual + 0.01;
  };
  std::array<std::vector<double>, 3> beside, apart;
  std::vector<double> sums;
  Level level;
  double count = 0.0;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      if (!is_good(x, y)) continue;
      for (int c = 0; c < 3; ++c) level.light[c] += marker.Light(x, y, c);
      ++count;
      for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, 1}}) {
        for (const int lag : {1, 3}) {
          if (!is_good(x + lag * dx, y + lag * dy)) continue;
          double sum = 0.0;
          for (int c = 0; c < 3; ++c) {
            const double d = marker.Light(x + lag * dx, y + lag * dy, c) - marker.Light(x, y, c);
            (lag == 1 ? beside : apart)[c].push_back(d);
            sum += d;
          }
          if (lag == 3) sums.push_back(sum);
        }
      }
    }
  }
  if (static_cast<int>(apart[0].size()) < kMinPairs) return std::nullopt;
  double variance_sum = 0.0, root_sum = 0.0, beside_sum = 0.0, apart_sum = 0.0;
  for (int c = 0; c < 3; ++c) {
    level.light[c] /= count;
    const double of_apart = TrimmedVariance(apart[c]) / 2;
    beside_sum += TrimmedVariance(beside[c]) / 2;
    apart_sum += of_apart;
    level.variance[c] = std::max(0.0, of_apart - marker.RoundingAt(c, level.light[c]));
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

/// Variance of the smoothest blocks' noise over that of `look`; at most 1.
double NoiseOfSmoothest(const MarkerInImage& marker, const CameraLook& look) {
  const ImageView<const std::uint8_t> rgb = marker.rgb();
  const int columns = rgb.width() / kBlock, rows = rgb.height() / kBlock;
  const int step = std::max(1, columns * rows / kMaxBlocks);
  constexpr int kGreen = 1, kLag = 3;
  std::vector<double> shares;
  for (int block = 0; block < columns * rows; block += step) {
    const int x0 = block % columns * kBlock, y0 = block / columns * kBlock;
    double sum = 0.0, squares = 0.0;
    int count = 0;
    bool usable = true;
    for (int y = y0; y < y0 + kBlock; ++y) {
      for (int x = x0; x < x0 + kBlock; ++x) {
        const int code = rgb(x, y, kGreen);
        usable = usable && code >= kDarkestGrey && code <= kBrightestGrey;
        const double light = marker.Light(x, y, kGreen);
        sum += light;
        for (const auto& [dx, dy] : {std::pair{kLag, 0}, std::pair{0, kLag}}) {
          if (x + dx >= x0 + kBlock || y + dy >= y0 + kBlock) continue;
          const double d = marker.Light(x + dx, y + dy, kGreen) - light;
          squares += d * d;
          ++count;
        }
      }
    }
    if (!usable) continue;
    const double light = sum / (kBlock * kBlock);
    const double predicted =
        std::pow(look.NoiseSigma(kGreen, light), 2) + marker.RoundingAt(kGreen, light);
    if (predicted > 0.0) shares.push_back(squares / (2 * count) / predicted);
  }
  if (static_cast<int>(shares.size()) < kMinBlocks) return 1.0;
  const auto at =
      shares.begin() + static_cast<std::ptrdiff_t>(kSmoothest * static_cast<double>(shares.size()));
  std::nth_element(shares.begin(), at, shares.end());
  return std::min(1.0, *at / kSmoothestVariance);
}

}  // namespace

bool MeasureNoise(const MarkerInImage& marker, double blur_px, CameraLook* look) {
  // Beyond an edge's compression block, where the marker is large enough.
  const double near_px = 1.0 + 2.5 * blur_px;
  auto white = NoiseOf(marker, true, std::max(near_px, kBlockReach_px));
  auto black = NoiseOf(marker, false, std::max(near_px, kBlockReach_px));
  for (auto* level : {&white, &black}) {
    if (*level) continue;
    *level = NoiseOf(marker, level == &white, near_px);
    if (!*level) continue;
    for (int c = 0; c < 3; ++c) {
      const double of_edges =
          12 * marker.RoundingAt(c, (*level)->light[c]) * kEdgeSteps * kEdgeSteps;
      (*level)->variance[c] = std::max(0.0, (*level)->variance[c] - of_edges);
    }
  }
  if (!white && !black) return false;
  for (int c = 0; c < 3; ++c) {
    if (!white || !black) {
      // One level shows the amount of noise, not its growth with light: photon noise is assumed.
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
  // Compression artefacts around the marker's edges are not noise: the rest of the image lacks
  // them.
  const double share = NoiseOfSmoothest(marker, *look);
  for (int c = 0; c < 3; ++c) {
    look->noise_constant[c] *= share;
    look->noise_slope[c] *= share;
  }
  look->neighbour_correlation = brighter.neighbour;
  look->channel_correlation = brighter.channel;
  return true;
}

}  // namespace pleinair::compositor
