// How SgReader measures partly occluded markers.
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "tracker/pose/homography.h"
#include "tracker/surf_golay/sg_layout.h"
#include "tracker/surf_golay/sg_reader.h"

namespace pleinair::tracker {
namespace {

constexpr int kContentSteps = 4;
/// Under occluders: maximum noise of the black, in shares of white, of a usable light model; noise
/// of the white below which edges indicate occluders reliably; steps of the fits; their robust
/// shares, and the minimum ratio of these to the noise; maximum loss of inner correlation by the
/// fits.
constexpr double kMaxUncertainBlack = 0.25, kPlainWhite = 0.1;
constexpr int kBeneathSteps = 6;
constexpr std::array<double, 2> kBeneathShares{0.3, 0.15};
constexpr double kBeneathNoises = 3.0, kMaxCorrelationLoss = 0.1;
constexpr double kMiddle = 0.5 * sg::kModules;

}  // namespace

int SgReader::FineBlocks(const PixelWindow& window, const BlockFitState& state) {
  return BlockFit::BlocksAlong(
      1.2 * MarkerWindows::SidePx(state.modules_from_undistorted) / window.Scale(), kFineBlock_px);
}

bool SgReader::FitContent(int number, BlockFitState* state) {
  // Coarsely first: an occluder may have drawn the fit away by half a cell.
  for (const Detail detail : {Detail::kCoarse, Detail::kFine}) {
    PixelWindow window;
    const bool taken = detail == Detail::kCoarse
                           ? windows_.TakeCoarse(state->modules_from_undistorted, kCoarseSide_px,
                                                 &window, &fitted_.observed)
                           : windows_.TakeFine(*state, &window, &fitted_.observed);
    if (!taken) return false;
    KeepContent(window, state->modules_from_undistorted);
    const double side = windows_.SidePx(state->modules_from_undistorted);
    BlockFitOptions options;
    options.label_blocks = false;
    options.steps = kContentSteps;
    BlockFitState fitted = *state;
    if (detail == Detail::kCoarse) {
      fitted.blur_px = std::max(fitted.blur_px, kCoarseBlur_px * window.Scale());
    }
    if (!fitted_.fit.Run(patterns_.OfNumber(number), MarkerPart::kWhole, fitted_.observed,
                         BlockFit::BlocksAlong(1.2 * side / window.Scale(), kCoarseBlock_px),
                         options, &fitted)) {
      return false;
    }
    state->modules_from_undistorted = fitted.modules_from_undistorted;
  }
  return true;
}

void SgReader::KeepContent(const PixelWindow& window, const Mat3& modules_from_undistorted) {
  constexpr double kReach = 0.5 * sg::kCells * sg::kCell + 1.0;
  const int stride = window.width + 2 * kWindowBorder;
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) {
      const std::size_t ray =
          static_cast<std::size_t>(y + kWindowBorder) * stride + kWindowBorder + x;
      const Vec2 modules = Apply(modules_from_undistorted,
                                 {fitted_.observed.rays.x[ray], fitted_.observed.rays.y[ray]});
      if (!(std::fabs(modules.x - kMiddle) < kReach && std::fabs(modules.y - kMiddle) < kReach)) {
        fitted_.observed.inverse_variance[static_cast<std::size_t>(y) * window.width + x] = 0.0F;
      }
    }
  }
}

void SgReader::RefineBeneathCovers(SgReading* reading) {
  if (reading->visible_fraction >= kNearlyAllVisible) return;
  std::optional<SgReading> beneath =
      MeasureBeneathCovers(reading->number, {reading->modules_from_undistorted, reading->blur_px});
  if (!beneath || beneath->inner_correlation < reading->inner_correlation - kMaxCorrelationLoss)
    return;
  beneath->margin = reading->margin;
  *reading = std::move(*beneath);
}

std::optional<SgReading> SgReader::MeasureBeneathCovers(int number, const BlockFitState& guess) {
  PixelWindow window;
  if (!windows_.TakeFine(guess, &window, &fitted_.observed)) return std::nullopt;
  const MarkerPattern& marker = patterns_.OfNumber(number);
  const int blocks = FineBlocks(window, guess);
  BlockFitState state = guess;
  const auto fit = [&](const BlockFitOptions& options) {
    return fitted_.fit.Run(marker, MarkerPart::kWhole, fitted_.observed, blocks, options, &state);
  };
  fitted_.fit.Evaluate(marker, MarkerPart::kWhole, fitted_.observed, blocks, state);
  MarkerLight light;
  if (!cover_light_.Measure(marker, fitted_.fit, fitted_.observed, false, &light) ||
      light.white_clips || light.black_noise > kMaxUncertainBlack) {
    return std::nullopt;
  }
  cover_.TakeShares(marker, fitted_.fit, light, &fitted_.observed);
  BlockFitOptions options;
  options.fit_blur = true;
  options.label_blocks = false;
  BlockFitOptions sharp = options;
  sharp.steps = kBeneathSteps;
  sharp.known_light = true;
  const double noise = kBeneathNoises * std::max(light.white_noise, light.black_noise);
  CoverMask::Edges edges = CoverMask::Edges::kUnreliable;
  for (const double share : kBeneathShares) {
    sharp.robust_share = std::max(share, noise);
    cover_.Lay(fitted_.fit, state.blur_px / window.Scale(), edges, &fitted_.observed);
    if (!fit(sharp)) return std::nullopt;
    if (light.white_noise < kPlainWhite) edges = CoverMask::Edges::kReliable;
  }
  // Occluders cast shadows too: in the last fit each block has its own light again, and all have a
  // common slope.
  options.fit_light = true;
  cover_.Lay(fitted_.fit, state.blur_px / window.Scale(), edges, &fitted_.observed);
  cover_.RestoreValues(&fitted_.observed);
  if (!fit(options)) return std::nullopt;
  SgReading reading;
  reading.number = number;
  DescribeFit(lens_, fitted_.fit, state, &reading);
  if (IsNoisy()) {
    cover_.Lay(fitted_.fit, state.blur_px / window.Scale(), edges, &fitted_.observed,
               CoverMask::Dark::kBeyondNoise);
    MeasureThroughNoise(marker, MarkerPart::kWhole, options, state, &reading);
  }
  cover_.RestoreWeights(&fitted_.observed);
  fitted_.fit.Evaluate(marker, MarkerPart::kWhole, fitted_.observed, blocks, state);
  DescribeAppearance(fitted_.fit, &reading);
  return reading;
}

}  // namespace pleinair::tracker
