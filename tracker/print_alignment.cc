#include "tracker/print_alignment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/srgb.h"
#include "tracker/homography.h"
#include "tracker/print_coverage.h"

namespace pleinair::tracker {
namespace {

constexpr int kHomographyParameters = 8;
constexpr int kBlurParameter = 8;
constexpr int kFirstLevel = 9;

constexpr double kInitialBlur_px = 0.6;
constexpr double kMinBlur_px = 0.05, kMaxBlur_px = 12.0;
/// The blur is never below 0.05 px; a weak prior in the logarithm (±1) keeps sharp pictures, which
/// do not tell it, from drifting there.
constexpr double kBlurPriorSigma = 1.0;
/// Levels of neighbouring nodes differ by about this share of the print's contrast.
constexpr double kLevelPriorShare = 0.3;
/// Rounding to 8 bits alone leaves 0.29 codes.
constexpr double kMinResidual_codes = 0.3;
/// Tukey's biweight: 95 % efficient for Gaussian noise (Huber & Ronchetti 2009).
constexpr double kTukey = 4.685;
/// Node spacing of the level fields.
constexpr double kNodeSpacing_px = 30.0;
constexpr int kMaxNodes = 6;
/// Pixels near edges, and others, that are looked at; more cost time and gain nothing.
constexpr std::size_t kMaxEdgePixels = 6000, kMaxFlatPixels = 2000;
constexpr int kMaxIterations = 25;
/// An edge of the square lies at most this far from where the detector saw it, more when blurred;
/// and more where the contrast is so many residuals that the prediction must be right. (A camera's
/// sharpening leaves 10 to 20 of 255 codes unexplained.)
constexpr double kEdgeMayMove_px = 0.58, kEdgeMayMoveAtMost_px = 2.0, kEdgeMayMovePerBlur = 0.6;
constexpr double kModestContrast = 25.0;
/// Residuals of neighbouring pixels go together (JPEG blocks, texture of the paper, edges of
/// shadows); the covariance is scaled by what blocks of this side show.
constexpr int kBlock_px = 8;
/// What no residual tells: flatness of the print, calibration, the lens's blur that is no Gaussian.
constexpr double kSystematicCorner_px = 0.01;

/// One pixel of the picture that the print covers.
struct PrintPixel {
  int x = 0, y = 0;
  Vec2 ray;      ///< Undistorted normalised coordinates.
  Vec2 ray_d_x;  ///< … and their derivative by the pixel's x,
  Vec2 ray_d_y;  ///< … and y.
  double code = 0.0;
};

/// sRGB code (0…255) of linear light and its slope, continued beyond 0…1 so that a fit can come
/// back from there.
struct Encoded {
  double code, slope;
};

Encoded Encode(double linear) {
  // IEC 61966-2-1, as in base/srgb.h.
  if (linear <= 0.0031308) return {255.0 * 12.92 * linear, 255.0 * 12.92};
  if (linear >= 1.0) return {255.0 * (1.0 + 1.055 / 2.4 * (linear - 1.0)), 255.0 * 1.055 / 2.4};
  const double power = std::pow(linear, 1.0 / 2.4);
  return {255.0 * (1.055 * power - 0.055), 255.0 * 1.055 / 2.4 * power / linear};
}

struct State {
  Mat3 rays_from_print;  ///< Homography from the print (half edges, y up) to normalised rays.
  double log_blur = 0.0;
  Eigen::VectorXd levels;  ///< Black and white of each node, in linear light.
};

/// What one pixel should hold, against what it holds.
struct Predicted {
  Vec2 print;  ///< The pixel's centre on the print.
  Coverage coverage;
  std::array<double, 4> hat{};  ///< Weights of the four level nodes around it,
  std::array<int, 4> node{};    ///< … which are these, ascending.
  double contrast = 0.0;        ///< White less black here, linear light.
  double slope = 0.0;           ///< Codes per linear light.
  double residual = 0.0;        ///< Predicted less observed, codes.
  bool clipped = false;         ///< Both are beyond white: nothing to learn.
};

struct NormalEquations {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;
  double cost = 0.0;  ///< Robust, in units of the residual scale, priors included.
};

/// Sums of the homography's gradient over blocks of pixels, with the block's place.
using BlockGradients = std::map<std::pair<int, int>, Eigen::VectorXd>;

double Median(std::vector<double>* values) {
  if (values->empty()) return 0.0;
  const auto middle = values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2);
  std::nth_element(values->begin(), middle, values->end());
  return *middle;
}

class PrintFit {
 public:
  PrintFit(const CameraModel& camera, const PrintPattern& pattern,
           ImageView<const std::uint8_t> grey)
      : camera_(camera), pattern_(pattern), grey_(grey) {}

  std::optional<PrintAlignment> Run(const std::array<Vec2, 4>& corners_px);

 private:
  bool Begin(const std::array<Vec2, 4>& corners_px);
  void GatherPixels();
  bool InitialLevels();
  bool Optimize();
  Predicted Predict(const State& state, const Mat3& print_from_rays, double blur_px,
                    const PrintPixel& pixel) const;
  NormalEquations Evaluate(const State& state, double scale, BlockGradients* blocks) const;
  double CorrelationFactor(const BlockGradients& blocks, const Eigen::MatrixXd& covariance) const;
  void AddPriors(const State& state, NormalEquations* equations) const;
  State Moved(const State& state, const Eigen::VectorXd& step) const;
  std::vector<double> Residuals(const State& state) const;
  double RobustScale(const State& state) const;
  PrintAlignment Result() const;
  double VisibleFraction() const;
  double MayMove_px(const PrintAlignment& alignment, int corner) const;
  bool Plausible(const PrintAlignment& alignment, const std::array<Vec2, 4>& corners_px) const;

  int Parameters() const { return kFirstLevel + 2 * nodes_ * nodes_; }
  int LevelIndex(int node, int white) const { return 2 * node + white; }
  Vec2 PixelOf(const State& state, Vec2 print) const {
    const Vec2 ray = Apply(state.rays_from_print, print);
    return ProjectToPixel(camera_, Point<Camera>{{ray.x, ray.y, 1.0}});
  }

  const CameraModel& camera_;
  const PrintPattern& pattern_;
  ImageView<const std::uint8_t> grey_;
  std::vector<PrintPixel> pixels_;
  State state_;
  int nodes_ = 2;
  double side_px_ = 0.0;
  double contrast_ = 0.0;        ///< White less black in linear light, at the start.
  double contrast_codes_ = 0.0;  ///< The same in codes.
  double scale_codes_ = 0.0;     ///< Robust standard deviation of the residuals.
  double seen_share_ = 1.0;      ///< Share of the print that lies inside the picture.
};

bool PrintFit::Begin(const std::array<Vec2, 4>& corners_px) {
  std::array<Vec2, 4> rays;
  double perimeter_px = 0.0;
  for (int i = 0; i < 4; ++i) {
    rays[i] = UndistortPixel(camera_, corners_px[i]);
    perimeter_px += Norm(corners_px[(i + 1) % 4] - corners_px[i]);
  }
  side_px_ = perimeter_px / 4.0;
  state_.rays_from_print = HomographyToQuad(rays);
  for (const double value : state_.rays_from_print.m) {
    if (!std::isfinite(value)) return false;
  }
  state_.log_blur = std::log(kInitialBlur_px);
  nodes_ = std::clamp(static_cast<int>(std::lround(side_px_ / kNodeSpacing_px)) + 1, 2, kMaxNodes);
  GatherPixels();
  return pixels_.size() >= 40 && InitialLevels();
}

void PrintFit::GatherPixels() {
  const double extent = pattern_.Extent();
  Vec2 low{1e9, 1e9}, high{-1e9, -1e9};
  for (const Vec2 corner : kSquareCorners) {
    const Vec2 pixel = PixelOf(state_, corner * extent);
    low = {std::min(low.x, pixel.x), std::min(low.y, pixel.y)};
    high = {std::max(high.x, pixel.x), std::max(high.y, pixel.y)};
  }
  const int left = std::max(0, static_cast<int>(std::floor(low.x)));
  const int top = std::max(0, static_cast<int>(std::floor(low.y)));
  const int right = std::min(grey_.width() - 1, static_cast<int>(std::ceil(high.x)));
  const int bottom = std::min(grey_.height() - 1, static_cast<int>(std::ceil(high.y)));
  const Mat3 print_from_rays = Adjugate(state_.rays_from_print);
  // Bounds the work on huge prints: a coarser raster of pixels, the same in x and y.
  const double area_px = std::max(0.0, high.x - low.x) * std::max(0.0, high.y - low.y);
  const int stride = std::max(1, static_cast<int>(std::sqrt(area_px / 250'000.0)));

  std::vector<PrintPixel> edge, flat;
  for (int y = top; y <= bottom; y += stride) {
    for (int x = left; x <= right; x += stride) {
      PrintPixel pixel{.x = x,
                       .y = y,
                       .ray = UndistortPixel(camera_, {1.0 * x, 1.0 * y}),
                       .ray_d_x = {},
                       .ray_d_y = {},
                       .code = 1.0 * grey_(x, y)};
      const Vec2 print = Apply(print_from_rays, pixel.ray);
      const double beyond = std::max(std::fabs(print.x), std::fabs(print.y));
      if (!(beyond <= extent)) continue;
      pixel.ray_d_x = (UndistortPixel(camera_, {x + 0.5, 1.0 * y}) -
                       UndistortPixel(camera_, {x - 0.5, 1.0 * y}));
      pixel.ray_d_y = (UndistortPixel(camera_, {1.0 * x, y + 0.5}) -
                       UndistortPixel(camera_, {1.0 * x, y - 0.5}));
      const Vec2 d_x = Apply(print_from_rays, pixel.ray + pixel.ray_d_x) - print;
      const Vec2 d_y = Apply(print_from_rays, pixel.ray + pixel.ray_d_y) - print;
      // What lies beyond the quiet zone is unknown: the pixel must not see it.
      const double footprint = std::max(std::hypot(d_x.x, d_y.x), std::hypot(d_x.y, d_y.y));
      const double module = 2.0 / pattern_.edge_modules;
      if (beyond > std::max(extent - 0.8 * footprint, 1.0 + std::min(0.5 * footprint, module))) {
        continue;
      }
      const Coverage coverage = CoverageOfPixel(pattern_, print, d_x, d_y, kInitialBlur_px);
      (coverage.uniform ? flat : edge).push_back(pixel);
    }
  }
  const auto keep = [&](const std::vector<PrintPixel>& from, std::size_t most) {
    const std::size_t step = from.size() / most + 1;
    for (std::size_t i = 0; i < from.size(); i += step) pixels_.push_back(from[i]);
  };
  keep(edge, kMaxEdgePixels);
  keep(flat, kMaxFlatPixels);

  int inside = 0, all = 0;
  for (int j = 0; j < pattern_.modules; ++j) {
    for (int i = 0; i < pattern_.modules; ++i, ++all) {
      const Vec2 pixel = PixelOf(state_, {extent * (2.0 * (i + 0.5) / pattern_.modules - 1.0),
                                          extent * (2.0 * (j + 0.5) / pattern_.modules - 1.0)});
      inside += pixel.x > -0.5 && pixel.y > -0.5 && pixel.x < grey_.width() - 0.5 &&
                pixel.y < grey_.height() - 0.5;
    }
  }
  seen_share_ = static_cast<double>(inside) / all;
}

bool PrintFit::InitialLevels() {
  // Straight line of linear light over predicted coverage.
  const Mat3 print_from_rays = Adjugate(state_.rays_from_print);
  double n = 0.0, sum_t = 0.0, sum_tt = 0.0, sum_i = 0.0, sum_ti = 0.0;
  for (const PrintPixel& pixel : pixels_) {
    const Vec2 print = Apply(print_from_rays, pixel.ray);
    const Vec2 d_x = Apply(print_from_rays, pixel.ray + pixel.ray_d_x) - print;
    const Vec2 d_y = Apply(print_from_rays, pixel.ray + pixel.ray_d_y) - print;
    const double t = CoverageOfPixel(pattern_, print, d_x, d_y, kInitialBlur_px).white;
    const double light = LinearFromSrgb8()[static_cast<std::size_t>(pixel.code)];
    n += 1.0;
    sum_t += t;
    sum_tt += t * t;
    sum_i += light;
    sum_ti += t * light;
  }
  const double determinant = n * sum_tt - sum_t * sum_t;
  if (!(determinant > 1e-6)) return false;
  contrast_ = (n * sum_ti - sum_t * sum_i) / determinant;
  const double black = (sum_i - contrast_ * sum_t) / n;
  if (!(contrast_ > 0.002)) return false;
  contrast_codes_ =
      Encode(std::max(black, 0.0) + contrast_).code - Encode(std::max(black, 0.0)).code;
  state_.levels.resize(2 * nodes_ * nodes_);
  for (int node = 0; node < nodes_ * nodes_; ++node) {
    state_.levels[LevelIndex(node, 0)] = std::max(black, 0.0005);
    state_.levels[LevelIndex(node, 1)] = std::max(black, 0.0005) + contrast_;
  }
  return true;
}

Predicted PrintFit::Predict(const State& state, const Mat3& print_from_rays, double blur_px,
                            const PrintPixel& pixel) const {
  Predicted predicted;
  const double extent = pattern_.Extent();
  predicted.print = Apply(print_from_rays, pixel.ray);
  const Vec2 d_x = Apply(print_from_rays, pixel.ray + pixel.ray_d_x) - predicted.print;
  const Vec2 d_y = Apply(print_from_rays, pixel.ray + pixel.ray_d_y) - predicted.print;
  predicted.coverage = CoverageOfPixel(pattern_, predicted.print, d_x, d_y, blur_px);

  const auto grid = [&](double at) {
    return std::clamp((at / extent + 1.0) * 0.5 * (nodes_ - 1), 0.0, nodes_ - 1.0 - 1e-9);
  };
  const double column = grid(predicted.print.x), row = grid(predicted.print.y);
  const int i = static_cast<int>(column), j = static_cast<int>(row);
  const double a = column - i, b = row - j;
  predicted.hat = {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b};
  predicted.node = {j * nodes_ + i, j * nodes_ + i + 1, (j + 1) * nodes_ + i,
                    (j + 1) * nodes_ + i + 1};
  double black = 0.0, white = 0.0;
  for (int k = 0; k < 4; ++k) {
    black += predicted.hat[k] * state.levels[LevelIndex(predicted.node[k], 0)];
    white += predicted.hat[k] * state.levels[LevelIndex(predicted.node[k], 1)];
  }
  predicted.contrast = white - black;
  const Encoded encoded = Encode(black + predicted.contrast * predicted.coverage.white);
  predicted.slope = encoded.slope;
  predicted.clipped = pixel.code >= 255.0 && encoded.code > 255.0;
  predicted.residual = predicted.clipped ? 0.0 : encoded.code - pixel.code;
  return predicted;
}

std::vector<double> PrintFit::Residuals(const State& state) const {
  const Mat3 print_from_rays = Adjugate(state.rays_from_print);
  const double blur_px = std::exp(state.log_blur);
  std::vector<double> residuals;
  residuals.reserve(pixels_.size());
  for (const PrintPixel& pixel : pixels_) {
    residuals.push_back(Predict(state, print_from_rays, blur_px, pixel).residual);
  }
  return residuals;
}

NormalEquations PrintFit::Evaluate(const State& state, double scale, BlockGradients* blocks) const {
  NormalEquations equations;
  equations.hessian = Eigen::MatrixXd::Zero(Parameters(), Parameters());
  equations.gradient = Eigen::VectorXd::Zero(Parameters());
  const Mat3 print_from_rays = Adjugate(state.rays_from_print);
  const double blur_px = std::exp(state.log_blur);
  constexpr int kTouched = kFirstLevel + 8;
  std::array<double, kTouched> jacobian{};
  std::array<int, kTouched> index{};  // Ascending.
  for (int i = 0; i < kFirstLevel; ++i) index[i] = i;
  for (const PrintPixel& pixel : pixels_) {
    const Predicted predicted = Predict(state, print_from_rays, blur_px, pixel);
    if (predicted.clipped) continue;
    const Coverage& coverage = predicted.coverage;
    const double residual = predicted.residual;
    const double u = predicted.print.x, v = predicted.print.y;

    const double z = residual / (kTukey * scale);
    const double kept = 1.0 - z * z;
    // Tukey's biweight: ρ = c²/6 (1 - (1 - z²)³), weight (1 - z²)².
    equations.cost += kTukey * kTukey / 3.0 * (std::fabs(z) < 1.0 ? 1.0 - kept * kept * kept : 1.0);
    if (std::fabs(z) >= 1.0) continue;
    const double weight = kept * kept / (scale * scale);

    const double by_coverage = predicted.slope * predicted.contrast;
    const double g_u = by_coverage * coverage.d_u, g_v = by_coverage * coverage.d_v;
    // The homography moves by rays_from_print (I + Δ), so that a pixel's print coordinates change
    // by minus the flow of Δ.
    const double along = g_u * u + g_v * v;
    jacobian = {-g_u,      -g_u * u,  -g_u * v,
                -g_v,      -g_v * u,  -g_v * v,
                along * u, along * v, by_coverage * coverage.d_log_blur};
    for (int k = 0; k < 4; ++k) {
      index[kFirstLevel + 2 * k] = kFirstLevel + LevelIndex(predicted.node[k], 0);
      index[kFirstLevel + 2 * k + 1] = kFirstLevel + LevelIndex(predicted.node[k], 1);
      jacobian[kFirstLevel + 2 * k] = predicted.slope * (1.0 - coverage.white) * predicted.hat[k];
      jacobian[kFirstLevel + 2 * k + 1] = predicted.slope * coverage.white * predicted.hat[k];
    }
    if (blocks != nullptr) {
      Eigen::VectorXd& sum = blocks
                                 ->try_emplace({pixel.x / kBlock_px, pixel.y / kBlock_px},
                                               Eigen::VectorXd::Zero(Parameters()))
                                 .first->second;
      for (int i = 0; i < kTouched; ++i) sum[index[i]] += weight * residual * jacobian[i];
    }
    for (int i = coverage.uniform ? kFirstLevel : 0; i < kTouched; ++i) {
      const double weighted = weight * jacobian[i];
      equations.gradient[index[i]] += weighted * residual;
      for (int j = i; j < kTouched; ++j) {
        equations.hessian(index[j], index[i]) += weighted * jacobian[j];
      }
    }
  }
  AddPriors(state, &equations);
  equations.hessian.triangularView<Eigen::StrictlyUpper>() = equations.hessian.transpose();
  return equations;
}

void PrintFit::AddPriors(const State& state, NormalEquations* equations) const {
  const double blur_weight = 1.0 / (kBlurPriorSigma * kBlurPriorSigma);
  const double blur_error = state.log_blur - std::log(kInitialBlur_px);
  equations->hessian(kBlurParameter, kBlurParameter) += blur_weight;
  equations->gradient[kBlurParameter] += blur_weight * blur_error;
  equations->cost += blur_weight * blur_error * blur_error;
  const double level_weight = 1.0 / std::pow(kLevelPriorShare * contrast_, 2);
  const auto tie = [&](int node, int neighbour) {
    for (int white = 0; white < 2; ++white) {
      const int p = LevelIndex(node, white), q = LevelIndex(neighbour, white);
      const double difference = state.levels[p] - state.levels[q];
      equations->cost += level_weight * difference * difference;
      equations->gradient[kFirstLevel + p] += level_weight * difference;
      equations->gradient[kFirstLevel + q] -= level_weight * difference;
      equations->hessian(kFirstLevel + p, kFirstLevel + p) += level_weight;
      equations->hessian(kFirstLevel + q, kFirstLevel + q) += level_weight;
      equations->hessian(kFirstLevel + q, kFirstLevel + p) -= level_weight;
    }
  };
  for (int j = 0; j < nodes_; ++j) {
    for (int i = 0; i < nodes_; ++i) {
      if (i + 1 < nodes_) tie(j * nodes_ + i, j * nodes_ + i + 1);
      if (j + 1 < nodes_) tie(j * nodes_ + i, (j + 1) * nodes_ + i);
    }
  }
}

State PrintFit::Moved(const State& state, const Eigen::VectorXd& step) const {
  State moved = state;
  const Mat3 motion{
      {1.0 + step[1], step[2], step[0], step[4], 1.0 + step[5], step[3], step[6], step[7], 1.0}};
  moved.rays_from_print = state.rays_from_print * motion;
  moved.log_blur = std::clamp(state.log_blur + step[kBlurParameter], std::log(kMinBlur_px),
                              std::log(kMaxBlur_px));
  moved.levels += step.tail(step.size() - kFirstLevel);
  return moved;
}

double PrintFit::RobustScale(const State& state) const {
  std::vector<double> residuals = Residuals(state);
  for (double& residual : residuals) residual = std::fabs(residual);
  // 1.4826: standard deviation of a Gaussian over its median absolute deviation.
  return std::max(kMinResidual_codes, 1.4826 * Median(&residuals));
}

bool PrintFit::Optimize() {
  double damping = 1e-3;
  // The scale of the residuals falls as the fit gets better; it is held while steps are compared.
  scale_codes_ = std::max(4.0, 1.5 * RobustScale(state_));
  NormalEquations equations = Evaluate(state_, scale_codes_, nullptr);
  int since_scale = 0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    Eigen::MatrixXd damped = equations.hessian;
    damped.diagonal() += damping * equations.hessian.diagonal();
    damped.diagonal().array() += 1e-9;
    const Eigen::VectorXd step = damped.ldlt().solve(-equations.gradient);
    if (!step.allFinite()) return false;
    const State candidate = Moved(state_, step);
    NormalEquations next = Evaluate(candidate, scale_codes_, nullptr);
    const bool better = next.cost < equations.cost;
    const double moved_px = step.head(kHomographyParameters).cwiseAbs().maxCoeff() * side_px_ / 2.0;
    if (better) {
      state_ = candidate;
      equations = std::move(next);
      damping = std::max(1e-7, damping * 0.2);
      ++since_scale;
    } else {
      damping *= 8.0;
      if (damping > 1e4) break;
    }
    if (since_scale >= 2 || moved_px < 1e-3) {
      since_scale = 0;
      const double scale = std::max(RobustScale(state_), 0.6 * scale_codes_);
      const bool settled = std::fabs(scale / scale_codes_ - 1.0) < 0.02;
      if (settled && moved_px < 1e-3) break;
      scale_codes_ = std::min(scale, scale_codes_);
      equations = Evaluate(state_, scale_codes_, nullptr);
    }
  }
  return true;
}

double PrintFit::VisibleFraction() const {
  const std::vector<double> residuals = Residuals(state_);
  const auto seen = std::count_if(residuals.begin(), residuals.end(), [&](double residual) {
    return std::fabs(residual) < std::max(12.0, kTukey * scale_codes_);
  });
  return seen_share_ * static_cast<double>(seen) / static_cast<double>(residuals.size());
}

double PrintFit::CorrelationFactor(const BlockGradients& blocks,
                                   const Eigen::MatrixXd& covariance) const {
  // Clustered sandwich estimate of a covariance (Liang & Zeger 1986): H⁻¹ (Σ_blocks g gᵀ) H⁻¹ in
  // place of H⁻¹. With few blocks the matrix is too ragged to use; its mean ratio is not.
  Eigen::MatrixXd sandwich = Eigen::MatrixXd::Zero(kHomographyParameters, kHomographyParameters);
  for (const auto& [place, gradient] : blocks) {
    const Eigen::VectorXd moved = (covariance * gradient).head<kHomographyParameters>();
    sandwich += moved * moved.transpose();
  }
  const Eigen::MatrixXd plain =
      covariance.topLeftCorner(kHomographyParameters, kHomographyParameters);
  return std::max(1.0, plain.ldlt().solve(sandwich).trace() / kHomographyParameters);
}

PrintAlignment PrintFit::Result() const {
  PrintAlignment alignment;
  alignment.blur_px = std::exp(state_.log_blur);
  alignment.residual_codes = scale_codes_;
  alignment.visible_fraction = VisibleFraction();
  BlockGradients blocks;
  const NormalEquations equations = Evaluate(state_, scale_codes_, &blocks);
  Eigen::MatrixXd covariance =
      equations.hessian.ldlt().solve(Eigen::MatrixXd::Identity(Parameters(), Parameters()));
  covariance *= CorrelationFactor(blocks, covariance);
  Eigen::Matrix<double, 8, 8> corners_by_motion;
  for (int i = 0; i < 4; ++i) {
    const Vec2 corner = kSquareCorners[i];
    alignment.corners_px[i] = PixelOf(state_, corner);
    constexpr double kStep = 1e-5;
    const Vec2 by_u =
        (PixelOf(state_, corner + Vec2{kStep, 0}) - PixelOf(state_, corner - Vec2{kStep, 0})) *
        (0.5 / kStep);
    const Vec2 by_v =
        (PixelOf(state_, corner + Vec2{0, kStep}) - PixelOf(state_, corner - Vec2{0, kStep})) *
        (0.5 / kStep);
    const double u = corner.x, v = corner.y;
    const std::array<double, 8> flow_u{1, u, v, 0, 0, 0, -u * u, -u * v};
    const std::array<double, 8> flow_v{0, 0, 0, 1, u, v, -u * v, -v * v};
    for (int k = 0; k < 8; ++k) {
      corners_by_motion(2 * i, k) = by_u.x * flow_u[k] + by_v.x * flow_v[k];
      corners_by_motion(2 * i + 1, k) = by_u.y * flow_u[k] + by_v.y * flow_v[k];
    }
  }
  Eigen::Map<Eigen::Matrix<double, 8, 8, Eigen::RowMajor>>(alignment.corner_covariance_px2.data()) =
      corners_by_motion * covariance.topLeftCorner<8, 8>() * corners_by_motion.transpose() +
      kSystematicCorner_px * kSystematicCorner_px * Eigen::Matrix<double, 8, 8>::Identity();
  return alignment;
}

double PrintFit::MayMove_px(const PrintAlignment& alignment, int corner) const {
  // Where a detector sees the edges of an sRGB picture a third of a pixel, and more where it is
  // blurred, inside the square, the corner is off by that over the sine of its half angle.
  const Vec2 here = alignment.corners_px[corner];
  const Vec2 a = alignment.corners_px[(corner + 1) % 4] - here;
  const Vec2 b = alignment.corners_px[(corner + 3) % 4] - here;
  const double cosine = (a.x * b.x + a.y * b.y) / std::max(1e-12, Norm(a) * Norm(b));
  const double half_angle_sine = std::sqrt(std::max(0.02, 0.5 * (1.0 - cosine)));
  const double blurred_px =
      kEdgeMayMovePerBlur * std::max(0.0, alignment.blur_px - kInitialBlur_px);
  const double trust = std::max(1.0, contrast_codes_ / scale_codes_ / kModestContrast);
  const double edge_px = std::min(kEdgeMayMoveAtMost_px, kEdgeMayMove_px * trust) + blurred_px;
  return edge_px / half_angle_sine;
}

bool PrintFit::Plausible(const PrintAlignment& alignment,
                         const std::array<Vec2, 4>& corners_px) const {
  for (int i = 0; i < 4; ++i) {
    const Vec2 corner = alignment.corners_px[i];
    if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) return false;
    if (Norm(corner - corners_px[i]) > MayMove_px(alignment, i)) return false;
    const double variance = std::max(alignment.corner_covariance_px2[(2 * i) * 8 + 2 * i],
                                     alignment.corner_covariance_px2[(2 * i + 1) * 8 + 2 * i + 1]);
    if (!(variance >= 0.0 && variance < 0.3 * 0.3)) return false;
  }
  return alignment.visible_fraction > 0.4;
}

std::optional<PrintAlignment> PrintFit::Run(const std::array<Vec2, 4>& corners_px) {
  if (!Begin(corners_px) || !Optimize()) return std::nullopt;
  PrintAlignment alignment = Result();
  if (!Plausible(alignment, corners_px)) return std::nullopt;
  return alignment;
}

}  // namespace

std::optional<PrintAlignment> AlignPrint(const CameraModel& camera, const PrintPattern& pattern,
                                         ImageView<const std::uint8_t> grey,
                                         const std::array<Vec2, 4>& corners_px) {
  return PrintFit(camera, pattern, grey).Run(corners_px);
}

}  // namespace pleinair::tracker
