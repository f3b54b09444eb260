#include "tracker/alignment/block_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/srgb.h"
#include "tracker/homography.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {
namespace {

constexpr int kMostBlocksAlong = 8;
constexpr double kLeastBlockContrast = 0.04;  ///< Standard deviation of the share of white.
constexpr double kLeastWeight = 0.02;
constexpr double kDoubtfulCorrelation = 0.3, kCredibleCorrelation = 0.8;
constexpr int kClippedCode = 253;
constexpr float kMostReach_modules = 2.4F;
constexpr double kLeastBlur_px = 0.25, kMostBlur_px = 6.0;

/// d code / d linear light of the sRGB curve, squared: the certainty of a code's linear light.
const std::array<float, 256>& CertaintyOfCode() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (int code = 0; code < 256; ++code) {
      const int low = std::max(0, code - 1), high = std::min(255, code + 1);
      const double slope =
          (high - low) / (255.0 * (LinearFromSrgb(high / 255.0) - LinearFromSrgb(low / 255.0)));
      values[code] = code >= kClippedCode ? 0.0F : static_cast<float>(slope * slope);
    }
    return values;
  }();
  return table;
}

}  // namespace

void TakeLinearWindow(const LensGrid& lens, ImageView<const std::uint8_t> grey,
                      const PixelWindow& window, SeenWindow* seen) {
  LookUpRays(lens, window, &seen->rays);
  seen->value.resize(window.size());
  seen->certainty.resize(window.size());
  const auto& linear = LinearFromSrgb8();
  const auto& certainty = CertaintyOfCode();
  const int side = 1 << window.level;
  const float share = 1.0F / static_cast<float>(side * side);
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) {
      float sum = 0.0F, least = std::numeric_limits<float>::max();
      for (int j = 0; j < side; ++j) {
        const std::uint8_t* row = grey.row((window.y0 + y) * side + j) + (window.x0 + x) * side;
        for (int i = 0; i < side; ++i) {
          sum += linear[row[i]];
          least = std::min(least, certainty[row[i]]);
        }
      }
      const std::size_t at = static_cast<std::size_t>(y) * window.width + x;
      seen->value[at] = sum * share;
      seen->certainty[at] = least;
    }
  }
}

void TakeCodeWindow(const LensGrid& lens, ImageView<const std::uint8_t> reduced,
                    const PixelWindow& window, SeenWindow* seen) {
  LookUpRays(lens, window, &seen->rays);
  seen->value.resize(window.size());
  seen->certainty.assign(window.size(), 1.0F);
  for (int y = 0; y < window.height; ++y) {
    const std::uint8_t* row = reduced.row(window.y0 + y) + window.x0;
    for (int x = 0; x < window.width; ++x) {
      seen->value[static_cast<std::size_t>(y) * window.width + x] =
          static_cast<float>(row[x]) * (1.0F / 255.0F);
    }
  }
}

int BlockFit::BlocksAlong(double print_side_px, double block_px) {
  return std::clamp(static_cast<int>(print_side_px / block_px), 1, kMostBlocksAlong);
}

/// Weighted sums over one block's pixels; J are the derivatives of the share of white.
struct BlockFit::Sums {
  static constexpr int kP = 0, kI = 1, kPP = 2, kPI = 3, kII = 4, kW = 5, kJ = 6,
                       kPJ = kJ + kParameters, kIJ = kPJ + kParameters, kJJ = kIJ + kParameters,
                       kCount = kJJ + kParameters * (kParameters + 1) / 2;
};

void BlockFit::AssignBlocks(const PrintPattern& pattern, PrintPart part, const SeenWindow& seen,
                            double blur_px) {
  const std::size_t pixels = seen.value.size();
  block_of_.resize(pixels);
  weight_.resize(pixels);
  const float modules = static_cast<float>(pattern.modules);
  const float per_block = static_cast<float>(blocks_along_) / modules;
  const float middle = 0.5F * modules;
  const float content = 0.5F * static_cast<float>(sg::kCells * sg::kCell);
  for (std::size_t i = 0; i < pixels; ++i) {
    const float c = map_.column[i], r = map_.row[i];
    block_of_[i] = -1;
    weight_[i] = 0.0F;
    // What lies beyond the margin, or in the content, must not be blurred into the pixel.
    const float reach = static_cast<float>(0.5 + 1.3 * blur_px);
    // Of small prints too little would be left: there the robust weights have to do.
    const float rc = std::min(kMostReach_modules,
                              reach * (std::fabs(map_.column_x[i]) + std::fabs(map_.column_y[i])));
    const float rr =
        std::min(kMostReach_modules, reach * (std::fabs(map_.row_x[i]) + std::fabs(map_.row_y[i])));
    if (!(c > rc && c < modules - rc && r > rr && r < modules - rr)) continue;
    if (part == PrintPart::kBorder && std::fabs(c - middle) < content + 0.8F * rc &&
        std::fabs(r - middle) < content + 0.8F * rr) {
      continue;
    }
    const int bc = std::min(static_cast<int>(c * per_block), blocks_along_ - 1);
    const int br = std::min(static_cast<int>(r * per_block), blocks_along_ - 1);
    block_of_[i] = static_cast<std::int16_t>(br * blocks_along_ + bc);
    weight_[i] = seen.certainty[i];  // 0 for clipped pixels: of the print, but of no use here.
  }
}

void BlockFit::FitLevels(const SeenWindow& seen) {
  struct Level {
    double w = 0, p = 0, i = 0, pp = 0, pi = 0, ii = 0;  // With the pixels' certainty alone,
    double rw = 0, rp = 0, ri = 0, rpp = 0, rpi = 0;     // … and with the robust weights.
    int pixels = 0;
  };
  std::array<Level, kMostBlocksAlong * kMostBlocksAlong> levels{};
  for (std::size_t n = 0; n < block_of_.size(); ++n) {
    if (block_of_[n] < 0) continue;
    Level& level = levels[block_of_[n]];
    const double p = picture_.white[n], i = seen.value[n], w = seen.certainty[n], rw = weight_[n];
    level.w += w;
    level.p += w * p;
    level.i += w * i;
    level.pp += w * p * p;
    level.pi += w * p * i;
    level.ii += w * i * i;
    level.rw += rw;
    level.rp += rw * p;
    level.ri += rw * i;
    level.rpp += rw * p * p;
    level.rpi += rw * p * i;
    ++level.pixels;
  }
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const Level& level = levels[k];
    PrintBlock& block = blocks_[k];
    block = PrintBlock{};
    block.pixels = level.pixels;
    if (level.pixels < 6 || !(level.w > 0.0)) continue;
    const double vp = level.pp / level.w - std::pow(level.p / level.w, 2);
    const double vi = level.ii / level.w - std::pow(level.i / level.w, 2);
    const double vpi = level.pi / level.w - level.p / level.w * (level.i / level.w);
    block.contrast = std::sqrt(std::max(0.0, vp));
    if (block.contrast < kLeastBlockContrast || !(vi > 1e-12)) continue;
    block.correlation = vpi / std::sqrt(vp * vi);
    if (!(level.rw > 0.0)) continue;
    const double rvp = level.rpp / level.rw - std::pow(level.rp / level.rw, 2);
    const double rvpi = level.rpi / level.rw - level.rp / level.rw * (level.ri / level.rw);
    if (!(rvp > 1e-4)) continue;
    block.gain = rvpi / rvp;
    block.offset = (level.ri - block.gain * level.rp) / level.rw;
    block.noise = std::sqrt(std::max(0.0, vi - vpi * vpi / vp));
    if (!(block.gain > 0.0)) continue;
    block.weight = std::clamp(
        (block.correlation - kDoubtfulCorrelation) / (kCredibleCorrelation - kDoubtfulCorrelation),
        kLeastWeight, 1.0);
  }
}

void BlockFit::WeighPixels(const SeenWindow& seen, double robust_share) {
  std::array<float, kMostBlocksAlong * kMostBlocksAlong> inverse_gain{}, offset{}, weight{};
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    weight[k] = static_cast<float>(blocks_[k].weight);
    if (blocks_[k].weight <= 0.0) continue;
    inverse_gain[k] = static_cast<float>(1.0 / (blocks_[k].gain * robust_share));
    offset[k] = static_cast<float>(blocks_[k].offset);
  }
  const float share = static_cast<float>(1.0 / robust_share);
  for (std::size_t n = 0; n < block_of_.size(); ++n) {
    const int k = block_of_[n];
    if (k < 0) continue;
    // Geman & McClure's weight of the residual in shares of white.
    const float z = (seen.value[n] - offset[k]) * inverse_gain[k] - picture_.white[n] * share;
    const float kept = 1.0F / (1.0F + z * z);
    weight_[n] = weight[k] > 0.0F ? weight[k] * seen.certainty[n] * kept * kept : 0.0F;
  }
}

void BlockFit::AddUp(const SeenWindow& seen, const PrintPattern& pattern) {
  sums_.assign(blocks_.size() * Sums::kCount, 0.0);
  const int width = seen.rays.window.width, height = seen.rays.window.height;
  const float middle = 0.5F * static_cast<float>(pattern.modules);
  const float per_half = 2.0F / static_cast<float>(pattern.edge_modules);
  std::array<float, kParameters> j{};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t n = static_cast<std::size_t>(y) * width + x;
      if (block_of_[n] < 0 || weight_[n] <= 0.0F) continue;
      const float w = weight_[n], p = picture_.white[n], i = seen.value[n];
      double* sums = &sums_[static_cast<std::size_t>(block_of_[n]) * Sums::kCount];
      sums[Sums::kW] += w;
      sums[Sums::kP] += w * p;
      sums[Sums::kI] += w * i;
      sums[Sums::kPP] += w * p * p;
      sums[Sums::kPI] += w * p * i;
      sums[Sums::kII] += w * i * i;
      const float px = picture_.white_x[n], py = picture_.white_y[n];
      if (std::fabs(px) + std::fabs(py) < 1e-3F) continue;
      const float u = (map_.column[n] - middle) * per_half;
      const float v = (map_.row[n] - middle) * per_half;
      const float ux = map_.column_x[n] * per_half, uy = map_.column_y[n] * per_half;
      const float vx = map_.row_x[n] * per_half, vy = map_.row_y[n] * per_half;
      const float inverse = 1.0F / (ux * vy - uy * vx);
      const float pu = (px * vy - py * vx) * inverse, pv = (py * ux - px * uy) * inverse;
      const float along = pu * u + pv * v;
      j = {-pu, -pu * u, -pu * v, -pv, -pv * u, -pv * v, along * u, along * v, 0.0F};
      if (x > 0 && y > 0 && x + 1 < width && y + 1 < height) {
        // The heat equation: a Gaussian's variance spreads like time.
        j[kMotions] = 0.25F * (picture_.white_x[n + 1] - picture_.white_x[n - 1] +
                               picture_.white_y[n + width] - picture_.white_y[n - width]);
      }
      double* jj = sums + Sums::kJJ;
      for (int a = 0; a < kParameters; ++a) {
        const float wj = w * j[a];
        sums[Sums::kJ + a] += wj;
        sums[Sums::kPJ + a] += wj * p;
        sums[Sums::kIJ + a] += wj * i;
        for (int b = 0; b <= a; ++b) *jj++ += wj * j[b];
      }
    }
  }
  hessian_.fill(0.0);
  gradient_.fill(0.0);
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const double* s = &sums_[k * Sums::kCount];
    const double determinant = s[Sums::kW] * s[Sums::kPP] - s[Sums::kP] * s[Sums::kP];
    if (!(blocks_[k].weight > 0.0) || !(determinant > 1e-9 * s[Sums::kW] * s[Sums::kW])) continue;
    const double gain = (s[Sums::kW] * s[Sums::kPI] - s[Sums::kP] * s[Sums::kI]) / determinant;
    const double offset = (s[Sums::kI] - gain * s[Sums::kP]) / s[Sums::kW];
    if (!(gain > 0.0)) continue;
    // Gain and offset are eliminated: J loses what a change of them could do as well.
    const double* jj = s + Sums::kJJ;
    std::array<double, kParameters> on_white{}, on_one{};
    for (int a = 0; a < kParameters; ++a) {
      on_white[a] = (s[Sums::kW] * s[Sums::kPJ + a] - s[Sums::kP] * s[Sums::kJ + a]) / determinant;
      on_one[a] = (s[Sums::kPP] * s[Sums::kJ + a] - s[Sums::kP] * s[Sums::kPJ + a]) / determinant;
    }
    for (int a = 0; a < kParameters; ++a) {
      gradient_[a] +=
          gain * (s[Sums::kIJ + a] - gain * s[Sums::kPJ + a] - offset * s[Sums::kJ + a]);
      for (int b = 0; b <= a; ++b) {
        const double kept = *jj++ - on_white[a] * s[Sums::kPJ + b] - on_one[a] * s[Sums::kJ + b];
        hessian_[a * kParameters + b] += gain * gain * kept;
      }
    }
  }
  for (int a = 0; a < kParameters; ++a) {
    for (int b = 0; b < a; ++b) hessian_[b * kParameters + a] = hessian_[a * kParameters + b];
  }
}

void BlockFit::Evaluate(const PrintPattern& pattern, PrintPart part, const SeenWindow& seen,
                        int blocks_along, const BlockFitState& state) {
  blocks_along_ = std::clamp(blocks_along, 1, kMostBlocksAlong);
  blocks_.resize(static_cast<std::size_t>(blocks_along_) * blocks_along_);
  const double blur = state.blur_px / seen.rays.window.Scale();
  raster_.Render(pattern, state.modules_from_ideal, seen.rays, blur, &map_, &picture_);
  AssignBlocks(pattern, part, seen, blur);
  FitLevels(seen);
}

bool BlockFit::Run(const PrintPattern& pattern, PrintPart part, const SeenWindow& seen,
                   int blocks_along, const BlockFitOptions& options, BlockFitState* state) {
  const double scale = seen.rays.window.Scale();
  const double half = 0.5 * pattern.edge_modules, middle = 0.5 * pattern.modules;
  const Mat3 modules_from_unit{{half, 0, middle, 0, half, middle, 0, 0, 1}};
  const Mat3 unit_from_modules{{1 / half, 0, -middle / half, 0, 1 / half, -middle / half, 0, 0, 1}};
  for (int step = 0;; ++step) {
    Evaluate(pattern, part, seen, blocks_along, *state);
    WeighPixels(seen, options.robust_share);
    FitLevels(seen);
    WeighPixels(seen, options.robust_share);
    AddUp(seen, pattern);
    if (step == options.steps) return true;
    const int parameters = kParameters;
    Eigen::Matrix<double, kParameters, kParameters> hessian =
        Eigen::Map<Eigen::Matrix<double, kParameters, kParameters>>(hessian_.data());
    Eigen::Matrix<double, kParameters, 1> gradient =
        Eigen::Map<Eigen::Matrix<double, kParameters, 1>>(gradient_.data());
    const double size = hessian.topLeftCorner<kMotions, kMotions>().trace() / kMotions;
    if (!(size > 0.0)) return false;
    hessian.diagonal().head<kMotions>().array() += 1e-5 * size;
    if (!options.fit_projection) {
      for (const int p : {6, 7}) {
        hessian.row(p).setZero();
        hessian.col(p).setZero();
        hessian(p, p) = 1.0;
        gradient[p] = 0.0;
      }
    }
    if (!options.fit_blur) {
      hessian.row(kMotions).setZero();
      hessian.col(kMotions).setZero();
      hessian(kMotions, kMotions) = 1.0;
      gradient[kMotions] = 0.0;
    } else {
      hessian(kMotions, kMotions) *= 1.05;
      hessian(kMotions, kMotions) += 1e-12;
    }
    Eigen::Matrix<double, kParameters, 1> move = hessian.ldlt().solve(gradient);
    static_cast<void>(parameters);
    if (!move.allFinite()) return false;
    // How far the square's corners go, in the window's pixels.
    const Mat3 ideal_from_unit = Adjugate(unit_from_modules * state->modules_from_ideal);
    double side_px = 0.0;
    for (int i = 0; i < 4; ++i) {
      side_px += Norm(Apply(ideal_from_unit, kSquareCorners[i]) -
                      Apply(ideal_from_unit, kSquareCorners[(i + 1) % 4]));
    }
    side_px /= 4.0 * scale;
    double moved_px = 0.0;
    for (const Vec2& corner : kSquareCorners) {
      const double u = corner.x, v = corner.y;
      const double projective = move[6] * u + move[7] * v;
      moved_px =
          std::max(moved_px, std::hypot(move[0] + move[1] * u + move[2] * v - projective * u,
                                        move[3] + move[4] * u + move[5] * v - projective * v) *
                                 0.5 * side_px);
    }
    // The prediction is good for a fraction of the smallest shapes.
    const double farthest = std::max(1.0, 0.06 * side_px);
    if (moved_px > farthest) move.head<kMotions>() *= farthest / moved_px;
    const Mat3 motion{
        {1.0 + move[1], move[2], move[0], move[4], 1.0 + move[5], move[3], move[6], move[7], 1.0}};
    state->modules_from_ideal =
        modules_from_unit * (Adjugate(motion) * (unit_from_modules * state->modules_from_ideal));
    if (options.fit_blur) {
      const double blur = state->blur_px / scale;
      const double change =
          std::clamp(move[kMotions], -0.5 * blur * blur - 0.05, blur * blur + 0.3);
      const double variance = blur * blur + change;
      state->blur_px = std::clamp(std::sqrt(std::max(0.0, variance)) * scale, kLeastBlur_px * scale,
                                  kMostBlur_px * scale);
    }
    // One more round predicts and weighs at the end of the way.
    if (moved_px < options.done_px) step = options.steps - 1;
  }
}

double BlockFit::Correlation() const {
  double sum = 0.0, share = 0.0;
  for (const PrintBlock& block : blocks_) {
    if (block.contrast < kLeastBlockContrast) continue;
    const double weight = block.pixels * block.contrast;
    sum += weight * block.correlation;
    share += weight;
  }
  return share > 0.0 ? sum / share : 0.0;
}

std::array<double, 64> BlockFit::MotionCovariance() const {
  double residual = 0.0, count = 0.0;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const double* s = &sums_[k * Sums::kCount];
    const PrintBlock& block = blocks_[k];
    if (!(block.weight > 0.0) || !(s[Sums::kW] > 0.0)) continue;
    const double determinant = s[Sums::kW] * s[Sums::kPP] - s[Sums::kP] * s[Sums::kP];
    if (!(determinant > 1e-9 * s[Sums::kW] * s[Sums::kW])) continue;
    const double gain = (s[Sums::kW] * s[Sums::kPI] - s[Sums::kP] * s[Sums::kI]) / determinant;
    const double offset = (s[Sums::kI] - gain * s[Sums::kP]) / s[Sums::kW];
    residual += std::max(0.0, s[Sums::kII] - gain * s[Sums::kPI] - offset * s[Sums::kI]);
    count += block.pixels * block.weight;
  }
  Eigen::Matrix<double, kMotions, kMotions> hessian =
      Eigen::Map<const Eigen::Matrix<double, kParameters, kParameters>>(hessian_.data())
          .topLeftCorner<kMotions, kMotions>();
  const double variance = residual / std::max(1.0, count - kParameters);
  std::array<double, 64> covariance{};
  Eigen::Map<Eigen::Matrix<double, 8, 8, Eigen::RowMajor>> out(covariance.data());
  out = hessian.ldlt().solve(Eigen::Matrix<double, kMotions, kMotions>::Identity()) * variance;
  return covariance;
}

}  // namespace pleinair::tracker
