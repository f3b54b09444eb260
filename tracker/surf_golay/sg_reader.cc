#include "tracker/surf_golay/sg_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracker/pose/homography.h"
#include "tracker/surf_golay/cells/decoding_confidence.h"
#include "tracker/surf_golay/cells/fast_cell_sampling.h"
#include "tracker/surf_golay/marker_square.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {
namespace {

constexpr double kProbeSide_px = 36.0;  ///< Maximum side of a marker that is only probed.
/// Correlation of a border below which a reduced image is tried too; the minimum increase of the
/// correlation there; the minimum side of the reduced marker.
constexpr double kNoisyCorrelation = 0.65, kClearer = 0.3, kMinReducedSide_px = 30.0;
constexpr double kCoarseBlurShare = 0.03, kFirstBlur_px = 0.7;
/// Maximum blur at which the fit starts; from it the fit reaches the sharpest marker's blur in a
/// few steps.
constexpr double kMaxPlainBlur_px = 1.2;
/// Minimum visible share: an occluder of one side alone can draw the fit to its own edge.
constexpr double kPlainVisible = 0.985;
/// Minimum inner correlation, relative to that which noise leaves; and the contrast of the inside,
/// in shares of white. Occluders of two sides can draw the fit to both of their edges, where all of
/// the border seems visible. The inside then does not fit.
constexpr double kInsideFits = 0.998, kInnerContrast = 0.45;
constexpr double kMinSide_px = 6.0;
constexpr double kVisibleCorrelation = 0.7;
constexpr double kMinVisibleBorder = 0.06;
constexpr double kOpenBorder = 0.9;  ///< Minimum matching share of an unoccluded border.
constexpr int kReadSteps = 4;
/// Maximum distance of corners between two fits whose cells need not be decoded again.
constexpr double kSameCells_modules = 0.5;
/// Noise, in shares of white, from which on pixels are weighted by their predicted variance; steps
/// of the fit with these weights.
constexpr double kPlainNoise = 0.02;
constexpr int kNoisySteps = 3;
constexpr int kFollowSteps = 4;
constexpr double kFarFollowBlur_px = 0.9, kFollowBlur_px = 0.3;
/// Correlation of a tracked marker that certainly is at the predicted position.
constexpr double kExpected = 0.95;
/// Mean correlation of the content's blocks at which a tracked marker's number is certain, and
/// likely.
constexpr double kContentSure = 0.9, kContentRight = 0.4;
/// Decision margin of a clearly visible number, in nats: at least eight cells of 6 nats, either
/// way.
constexpr float kPlainMargin = 96.0F;
/// Minimum visible share of a tracked marker: if its number is known, and if no evidence confirms
/// the number.
constexpr double kBarelyVisible = 0.1, kWellVisible = 0.3;
constexpr double kMiddle = 0.5 * sg::kModules;

/// Length in pixels of a step, from nearby, that may be the last: the remaining error is a fortieth
/// of it. Large markers determine their corners best and need a shorter step. Noise moves the
/// corners of small ones by more.
double LastStepPx(double side_px) {
  constexpr double kSmall_px = 90.0, kLarge_px = 130.0;
  return side_px < kSmall_px ? 0.06 : side_px < kLarge_px ? 0.04 : 0.02;
}

/// Maximum distance of a marker's corners under two homographies, in modules.
double ModulesApart(const Mat3& modules_from_undistorted,
                    const Mat3& other_modules_from_undistorted) {
  const Mat3 other = modules_from_undistorted * Adjugate(other_modules_from_undistorted);
  double farthest = 0.0;
  for (const Vec2& corner : kSquareCorners) {
    const Vec2 modules = ModulesOfUnit(corner);
    farthest = std::max(farthest, Norm(Apply(other, modules) - modules));
  }
  return farthest;
}

/// Whether a reading explains more of the marker than another of the same number. An occluder of
/// the border has edges that resemble the outer ones, but none that resemble the inside. Only if
/// the inside fits alike, the visible share decides. Alike are correlations that differ by less
/// than 0.01, and by less than half of what the other leaves unexplained.
bool Explains(const SgReading& reading, const SgReading& other) {
  const double alike = std::min(0.01, 0.5 * (1.0 - other.inner_correlation));
  const double better = reading.inner_correlation - other.inner_correlation;
  return better > alike || (better > -alike && reading.visible_fraction > other.visible_fraction);
}

}  // namespace

void SgReader::SetImage(ImageView<const std::uint8_t> grey) {
  grey_ = grey;
  plain_blur_px_ = kFirstBlur_px;
  unread_borders_.clear();
  windows_.SetImage(grey);
}

double SgReader::FitBorder(int steps, Detail detail, BlockFitState* state) {
  const bool coarse = detail != Detail::kFine;
  const double side = windows_.SidePx(state->modules_from_undistorted);
  if (side < kMinSide_px) return -1.0;
  PixelWindow window;
  if (coarse) {
    const double max_side = detail == Detail::kProbe ? kProbeSide_px : kCoarseSide_px;
    if (!windows_.TakeCoarse(state->modules_from_undistorted, max_side, &window, &fitted_.observed))
      return -1.0;
    state->blur_px =
        std::clamp(kCoarseBlurShare * side / window.Scale(), 0.7, kCoarseBlur_px) * window.Scale();
  } else if (!windows_.TakeFine(*state, &window, &fitted_.observed)) {
    return -1.0;
  }
  const int blocks =
      BlockFit::BlocksAlong(1.2 * side / window.Scale(), coarse ? kCoarseBlock_px : kFineBlock_px);
  BlockFitOptions options;
  options.steps = steps;
  options.fit_blur = !coarse;
  options.done_px = coarse ? 0.05 : 0.02;
  if (!fitted_.fit.Run(patterns_.blank(), MarkerPart::kBorder, fitted_.observed, blocks, options,
                       state))
    return -1.0;
  return fitted_.fit.Correlation();
}

double SgReader::FitBorderThroughNoise(int steps, BlockFitState* state) {
  const BlockFitState guess = *state;
  windows_.SetHalvingsForNoise(0);
  double correlation = FitBorder(steps, Detail::kFine, state);
  // Reduction averages out noise, but does not restore what an occluder hides.
  while (correlation > 0.0 && correlation < kNoisyCorrelation &&
         windows_.SidePx(guess.modules_from_undistorted) / (2 << windows_.halvings_for_noise()) >
             kMinReducedSide_px) {
    std::swap(fitted_, other_);
    windows_.SetHalvingsForNoise(windows_.halvings_for_noise() + 1);
    BlockFitState reduced = guess;
    const double better = FitBorder(steps, Detail::kFine, &reduced);
    if (better < correlation + kClearer) {
      windows_.SetHalvingsForNoise(windows_.halvings_for_noise() - 1);
      std::swap(fitted_, other_);
      break;
    }
    *state = reduced;
    correlation = better;
  }
  return correlation;
}

std::optional<DecodedNumber> SgReader::DecodeNumber(const BlockFitState& state) {
  return numbers_.Decode(patterns_.blank(), fitted_, state, VisibleBorder());
}

double SgReader::VisibleBorder() const {
  double visible = 0.0, border = 0.0;
  for (const MarkerBlock& block : fitted_.fit.blocks()) {
    if (block.contrast < fitted_.fit.min_contrast()) continue;
    border += block.pixels;
    if (block.correlation > kVisibleCorrelation) visible += block.pixels;
  }
  return border > 0.0 ? visible / border : 0.0;
}

std::optional<SgReading> SgReader::Track(int number, const BlockFitState& guess) {
  windows_.SetHalvingsForNoise(0);
  BlockFitState state = guess;
  const double side = windows_.SidePx(state.modules_from_undistorted);
  if (side < kMinSide_px) return std::nullopt;
  PixelWindow window;
  if (!windows_.TakeCoarseLight(state.modules_from_undistorted, kCoarseSide_px, &window,
                                &fitted_.observed))
    return std::nullopt;
  const double scale = window.Scale();
  BlockFitOptions options;
  options.label_blocks = false;
  options.steps = kFollowSteps;
  options.done_px = 0.1;
  const int blocks = BlockFit::BlocksAlong(1.2 * side / scale, kCoarseBlock_px);
  const auto fit = [&](double blur_px) {
    state.blur_px = std::max(guess.blur_px, blur_px * scale);
    return fitted_.fit.Run(patterns_.OfNumber(number), MarkerPart::kWhole, fitted_.observed, blocks,
                           options, &state);
  };
  // A large blur finds a marker from farther away. A small one finds it near the predicted
  // position, where it mostly is.
  if (!fit(kFollowBlur_px) || fitted_.fit.Correlation() < kExpected) {
    state = guess;
    if (!fit(kFarFollowBlur_px) || !fit(kFollowBlur_px)) return std::nullopt;
  }
  state.blur_px = guess.blur_px;
  std::optional<SgReading> reading = Measure(number, state, LastStepPx(side));
  if (!reading || reading->visible_fraction < kBarelyVisible) return std::nullopt;
  // Check the code: where the content is observed, it must be this number's.
  double right = 0.0, observed = 0.0;
  const int along = fitted_.fit.blocks_along();
  for (int row = 0; row < along; ++row) {
    for (int column = 0; column < along; ++column) {
      const MarkerBlock& block = fitted_.fit.blocks()[row * along + column];
      const auto central = [&](int at) {
        const double middle = (at + 0.5) / along * sg::kModules - kMiddle;
        return std::fabs(middle) < 0.5 * sg::kCells * sg::kCell;
      };
      if (!central(column) || !central(row) || block.contrast < fitted_.fit.min_contrast())
        continue;
      observed += block.pixels;
      right += block.pixels * std::clamp(block.correlation, 0.0, 1.0);
    }
  }
  reading->margin = NumberDecoder::kSafeMargin;
  RefineBeneathCovers(&*reading);
  if (observed > 0.0 && right > kContentSure * observed) return reading;
  // Something occludes the content, or it is another marker's: two numbers share up to two thirds
  // of their cells.
  const std::optional<SgReading> other =
      DecodeFull({reading->modules_from_undistorted, reading->blur_px});
  if (other && other->number != number) return std::nullopt;
  const bool content_right = observed > 0.0 && right > kContentRight * observed;
  if (!content_right && !other && reading->visible_fraction < kWellVisible) return std::nullopt;
  return reading;
}

std::optional<SgReading> SgReader::DecodeFast(const BlockFitState& guess) {
  const std::optional<CellLikelihoods> cells =
      SampleCellsFast(grey_, lens_, guess.modules_from_undistorted);
  if (!cells) return std::nullopt;
  GolayWord white = 0;
  for (int i = 0; i < kGolayBits; ++i) white |= static_cast<GolayWord>((*cells)[i] > 0.0F) << i;
  const std::optional<int> number = numbers_.in_use().NumberOfCells(white);
  if (!number) return std::nullopt;
  windows_.SetHalvingsForNoise(0);
  std::optional<SgReading> reading =
      Measure(*number, {guess.modules_from_undistorted, plain_blur_px_},
              LastStepPx(windows_.SidePx(guess.modules_from_undistorted)));
  if (reading && !InsideFits(*reading)) LetContentPull(guess, &*reading);
  if (!reading || reading->visible_fraction < kPlainVisible) return std::nullopt;
  plain_blur_px_ = std::min(reading->blur_px, kMaxPlainBlur_px);
  reading->margin = kPlainMargin;
  reading->confidence_bits = ConfidenceBits(*cells, *number, numbers_.in_use().NumbersInUse());
  return reading;
}

std::optional<SgReading> SgReader::DecodeFull(const BlockFitState& guess) {
  std::optional<SgReading> reading = DecodeFull(guess, kReadSteps);
  if (reading && !IsConfident(reading->confidence_bits, reading->visible_fraction, 0.0))
    reading.reset();
  return reading;
}

std::optional<SgReading> SgReader::DecodeFull(const BlockFitState& guess, int border_steps) {
  BlockFitState state = guess;
  state.blur_px = kFirstBlur_px;
  FitBorderThroughNoise(border_steps, &state);
  // Where nearly all of the border is occluded, it may have no block that matches as a whole.
  if (border_steps > 0 && VisibleBorder() < kMinVisibleBorder) return std::nullopt;
  const double visible_border = VisibleBorder();
  const std::optional<DecodedNumber> number = DecodeNumber(state);
  std::optional<SgReading> reading;
  if (number) reading = MeasureDecoded(*number, state);
  const bool confident =
      reading && IsConfident(reading->confidence_bits, reading->visible_fraction, 0.0);
  if (visible_border > kOpenBorder && !confident) {
    if (number) {
      BlockFitState border = state;
      FitBorder(0, Detail::kFine, &border);
    }
    if (!numbers_.ShowAnotherNumber(patterns_.blank(), fitted_, state, visible_border))
      unread_borders_.push_back(state.modules_from_undistorted);
  }
  return reading;
}

std::optional<SgReading> SgReader::MeasureDecoded(DecodedNumber number,
                                                  const BlockFitState& state) {
  std::optional<SgReading> reading = Measure(number.number, state);
  if (!reading) return std::nullopt;
  if (reading->visible_fraction < kNearlyAllVisible || !InsideFits(*reading)) {
    LetContentPull(state, &*reading);
  }
  RefineBeneathCovers(&*reading);
  if (ModulesApart(state.modules_from_undistorted, reading->modules_from_undistorted) >
      kSameCells_modules) {
    // At the measured position the cells must decode to the same number.
    BlockFitState measured{reading->modules_from_undistorted, reading->blur_px};
    FitBorder(0, Detail::kFine, &measured);
    const std::optional<DecodedNumber> again = DecodeNumber(measured);
    if (!again || again->number != number.number) return std::nullopt;
    number = *again;
  }
  reading->margin = number.margin;
  reading->confidence_bits = number.confidence_bits;
  return reading;
}

void SgReader::LetContentPull(const BlockFitState& guess, SgReading* reading) {
  BlockFitState by_content = guess;
  if (!FitContent(reading->number, &by_content)) return;
  std::optional<SgReading> other = Measure(reading->number, by_content);
  // A guess of another size has other blocks, which are not comparable.
  if (other && other->blocks_along != reading->blocks_along) DescribeAnew(&*other);
  if (other && Explains(*other, *reading)) *reading = *std::move(other);
}

void SgReader::DescribeAnew(SgReading* reading) {
  const BlockFitState state{reading->modules_from_undistorted, reading->blur_px};
  PixelWindow window;
  if (!windows_.TakeFine(state, &window, &fitted_.observed)) return;
  fitted_.fit.Evaluate(patterns_.OfNumber(reading->number), MarkerPart::kWhole, fitted_.observed,
                       FineBlocks(window, state), state);
  DescribeAppearance(fitted_.fit, reading);
}

bool SgReader::InsideFits(const SgReading& reading) const {
  const double noise = fitted_.fit.noise_share() / kInnerContrast;
  return reading.inner_correlation * std::sqrt(1.0 + noise * noise) > kInsideFits;
}

bool SgReader::IsNoisy() {
  return fitted_.fit.noise_share() >= kPlainNoise &&
         noise_estimator_.Share(fitted_.fit, fitted_.observed) >= kPlainNoise;
}

void SgReader::MeasureThroughNoise(const MarkerPattern& pattern, MarkerPart part,
                                   BlockFitOptions options, BlockFitState state,
                                   SgReading* reading) {
  fitted_.fit.UsePredictedVariance(&fitted_.observed);
  options.steps = kNoisySteps;
  // The result of the first fit is still to be validated.
  if (!other_.fit.Run(pattern, part, fitted_.observed, fitted_.fit.blocks_along(), options,
                      &state)) {
    return;
  }
  reading->corners_through_noise = CornersOfFit(lens_, other_.fit, state);
}

std::optional<SgReading> SgReader::Measure(int number, const BlockFitState& guess, double done_px) {
  std::optional<SgReading> reading =
      MeasurePattern(patterns_.OfNumber(number), MarkerPart::kWhole, guess, done_px);
  if (reading) reading->number = number;
  return reading;
}

std::optional<SgReading> SgReader::MeasureBorder(const BlockFitState& guess) {
  windows_.SetHalvingsForNoise(0);
  return MeasurePattern(patterns_.blank(), MarkerPart::kBorder, guess, kDone_px);
}

std::optional<SgReading> SgReader::MeasurePattern(const MarkerPattern& pattern, MarkerPart part,
                                                  const BlockFitState& guess, double done_px) {
  const double side = windows_.SidePx(guess.modules_from_undistorted);
  if (side < kMinSide_px) return std::nullopt;
  PixelWindow window;
  if (!windows_.TakeFine(guess, &window, &fitted_.observed)) return std::nullopt;
  BlockFitState state = guess;
  BlockFitOptions options;
  options.steps = 5;
  options.fit_blur = true;
  options.fit_light = true;
  options.label_blocks = false;
  options.done_px = done_px;
  if (!fitted_.fit.Run(pattern, part, fitted_.observed, FineBlocks(window, guess), options,
                       &state)) {
    return std::nullopt;
  }
  SgReading reading;
  DescribeFit(lens_, fitted_.fit, state, &reading);
  if (IsNoisy()) MeasureThroughNoise(pattern, part, options, state, &reading);
  return reading;
}

}  // namespace pleinair::tracker
