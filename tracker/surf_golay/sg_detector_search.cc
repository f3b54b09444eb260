// How SgDetector searches an image by borders and cells.
#include <algorithm>
#include <array>
#include <cstddef>

#include "tracker/surf_golay/decoding_confidence.h"
#include "tracker/surf_golay/marker_square.h"
#include "tracker/surf_golay/sg_detector.h"

namespace pleinair::tracker {
namespace {

constexpr int kFirstSteps = 2, kGuessSteps = 5;
/// Guesses of the S-G search that are looked at together; of which so many are fitted, and so many
/// may turn out not to be readable, before the others are given up.
constexpr int kGuessesAtOnce = 14, kMaxFits = 9, kMaxFailures = 4;
/// Votes times fit that make a guess worth more than a glance. In images without a marker a
/// quarter of the best guesses is.
constexpr double kMinWorth = 1.2;
/// So many markers in view make it likely that there are more.
constexpr std::size_t kMinFoundToSearchOn = 3;
/// The corners of cells are looked for in an image of at most this width.
constexpr int kMaxLatticeWidth_px = 900;
/// Correlation with the border of which little is observed; placements that are read.
constexpr double kCoveredCorrelation = 0.1;
constexpr std::size_t kMaxPlacements = 6;
/// Correlation of a guess's border, pixel by pixel, that makes it worth reading as it is. (Of 3,530
/// guesses in images without a marker none had more than 0.27.)
constexpr double kPlainGuess = 0.3;
/// Share of the border that must look right after a guess was fitted coarsely.
constexpr double kGuessedVisible = 0.15;

}  // namespace

void SgDetector::SearchImage() {
  if (!found_.empty()) {
    FindBySurf(BorderSearch::Sizes::kAll);
    return;
  }
  const bool any = FindBySurf(BorderSearch::Sizes::kLarge);
  // Among several there may be small ones.
  if (any && found_.size() < kMinFoundToSearchOn) return;
  if (!FindBySurf(BorderSearch::Sizes::kAll, any) && !any) FindByCells();
}

bool SgDetector::FindBySurf(BorderSearch::Sizes sizes, bool refill) {
  if (search_ == nullptr) {
    const BorderSearchOptions options;
    search_ = std::make_unique<BorderSearch>(
        lens_, MakeBorderTemplates(options.surf.descriptor_window_scales), options);
  }
  bool any = false;
  for (bool more = true; more; refill = true) {
    taken_.clear();
    for (const Found& found : found_) taken_.push_back(found.reading.corners.px);
    search_->Find(grey_, taken_, sizes, refill, &guesses_);
    tried_.clear();
    // As long as guesses turn out to be markers, more of them may.
    for (std::size_t first = 0; first < guesses_.size(); first += kGuessesAtOnce) {
      const std::size_t count = std::min<std::size_t>(kGuessesAtOnce, guesses_.size() - first);
      if (!TryGuesses(std::span(guesses_).subspan(first, count))) break;
      any = true;
    }
    // Many markers had many of the keypoints, so that others had few.
    more = found_.size() >= taken_.size() + (refill ? 1 : kMinFoundToSearchOn);
  }
  return any;
}

void SgDetector::FindByCells() {
  int level = 0;
  while (grey_.width() >> level > kMaxLatticeWidth_px && level + 1 < ReducedImages::kLevels) {
    ++level;
  }
  lattice_.Find(reduced_.Level(level), 1 << level, &lattices_);
  placements_.clear();
  for (const LatticeGuess& guess : lattices_) {
    // A row of cells without a corner may be at either end: also one cell to each side.
    for (int shift = 0; shift < 9; ++shift) {
      Mat3 by;
      const int column = shift % 3 - 1, row = shift / 3 - 1;
      by(0, 2) = sg::kCell * column;
      by(1, 2) = sg::kCell * row;
      const std::array<Vec2, 4> undistorted =
          UndistortedSquareCorners(by * guess.modules_from_undistorted);
      if (Taken(by * guess.modules_from_undistorted)) continue;
      for (const BorderOrientation& orientation :
           TestOrientation(CornersPx(by * guess.modules_from_undistorted))) {
        if (orientation.mirrored || orientation.correlation < kCoveredCorrelation) continue;
        std::array<Vec2, 4> turned;
        for (int k = 0; k < 4; ++k) turned[k] = undistorted[(orientation.first_corner + k) % 4];
        Placement placement;
        placement.state.modules_from_undistorted = ModulesFromSquareCorners(turned);
        placement.correlation = orientation.correlation;
        placements_.push_back(placement);
      }
    }
  }
  std::ranges::stable_sort(placements_, std::ranges::greater{}, &Placement::correlation);
  if (placements_.size() > kMaxPlacements) placements_.resize(kMaxPlacements);
  for (const Placement& placement : placements_) {
    if (Taken(placement.state.modules_from_undistorted)) continue;
    const std::optional<SgReading> reading = DecodeAsGuessed(placement.state);
    if (reading && RightWayRound(*reading)) Add(*reading, DetectionPath::kSurfGolay);
  }
}

bool SgDetector::TryGuesses(std::span<const BorderGuess> guesses) {
  // A few steps of the fit tell most wrong guesses from those that are worth more.
  ranked_guesses_.clear();
  for (const BorderGuess& guess : guesses) {
    if (Taken(guess.modules_from_undistorted)) continue;
    RankedGuess ranked;
    ranked.state.modules_from_undistorted = ranked.guess.modules_from_undistorted =
        guess.modules_from_undistorted;
    const double correlation =
        reader_.FitBorder(kFirstSteps, SgReader::Detail::kProbe, &ranked.state);
    ranked.rank = guess.votes * (correlation + reader_.VisibleBorder());
    // Covers draw a fit away that the border's pixels are plainly observed without.
    const double observed = UprightCorrelation(ranked.guess);
    ranked.plain = observed >= kPlainGuess;
    if (ranked.plain) ranked.rank = std::max(ranked.rank, 2.0 * guess.votes * observed);
    if (ranked.rank > kMinWorth) ranked_guesses_.push_back(ranked);
  }
  std::stable_sort(ranked_guesses_.begin(), ranked_guesses_.end(),
                   [](const RankedGuess& a, const RankedGuess& b) { return a.rank > b.rank; });
  bool any = false;
  int failures = 0, fits = 0;
  for (RankedGuess& ranked : ranked_guesses_) {
    if (failures >= kMaxFailures || fits >= kMaxFits) break;
    if (Taken(ranked.state.modules_from_undistorted, kSurelyVisible)) continue;
    ++fits;
    bool tried = false;
    std::optional<SgReading> reading = DecodeFitted(&ranked.state, &tried);
    if (!reading && ranked.plain && !Taken(ranked.guess.modules_from_undistorted)) {
      tried = true;
      reading = DecodeAsGuessed(ranked.guess);
    }
    failures += tried;
    if (reading && RightWayRound(*reading) && Add(*reading, DetectionPath::kSurfGolay)) {
      failures = fits = 0;
      any = true;
    }
  }
  return any;
}

std::optional<SgReading> SgDetector::DecodeFitted(BlockFitState* state, bool* tried) {
  reader_.FitBorder(kGuessSteps, SgReader::Detail::kCoarse, state);
  const std::array<Vec2, 4> corners = UndistortedSquareCorners(state->modules_from_undistorted);
  const bool again = std::any_of(tried_.begin(), tried_.end(), [&](const Mat3& tried_before) {
    return MaxCornerDistance(UndistortedSquareCorners(tried_before), corners) <
           kSamePlace * LongestSide(corners);
  });
  if (again) return std::nullopt;
  tried_.push_back(state->modules_from_undistorted);
  if (reader_.VisibleBorder() < kGuessedVisible) return std::nullopt;
  if (Taken(state->modules_from_undistorted, kSurelyVisible)) return std::nullopt;
  *tried = true;
  std::optional<SgReading> reading = reader_.DecodeFast(*state);
  if (!reading) reading = reader_.DecodeFull(*state);
  // Covers that look like ink or paper draw a fine fit away from a guess that was better.
  if (!reading && UprightCorrelation(*state) > kPlainBorder) reading = DecodeAsGuessed(*state);
  return reading;
}

}  // namespace pleinair::tracker
