// How SgDetector searches a picture by borders and cells.
#include <algorithm>
#include <array>
#include <cstddef>

#include "tracker/surf_golay/number_proof.h"
#include "tracker/surf_golay/print_square.h"
#include "tracker/surf_golay/sg_detector.h"

namespace pleinair::tracker {
namespace {

constexpr int kFirstSteps = 2, kGuessSteps = 5;
/// Guesses of the S-G search that are looked at together; of which so many are fitted, and so many
/// may turn out not to be readable, before the others are given up.
constexpr int kGuessesAtOnce = 14, kMostFits = 9, kMostFailures = 4;
/// Votes times fit that make a guess worth more than a glance. In pictures without a marker a
/// quarter of the best guesses is.
constexpr double kLeastWorth = 1.2;
/// So many markers in view make it likely that there are more.
constexpr std::size_t kFewestForMore = 3;
/// The corners of cells are looked for in a picture of at most this width.
constexpr int kMostLatticeWidth_px = 900;
/// Correlation with the border of which little is seen; placements that are read.
constexpr double kCoveredCorrelation = 0.1;
constexpr std::size_t kMostPlacements = 6;
/// Correlation of a guess's border, pixel by pixel, that makes it worth reading as it is. (Of 3,530
/// guesses in pictures without a marker none had more than 0.27.)
constexpr double kPlainGuess = 0.3;
/// Share of the border that must look right after a guess was fitted coarsely.
constexpr double kGuessedVisible = 0.15;

}  // namespace

void SgDetector::SearchPicture() {
  if (!found_.empty()) {
    FindBySurf(BorderSearch::Sizes::kAll);
    return;
  }
  const bool any = FindBySurf(BorderSearch::Sizes::kLarge);
  // Among several there may be small ones.
  if (any && found_.size() < kFewestForMore) return;
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
    more = found_.size() >= taken_.size() + (refill ? 1 : kFewestForMore);
  }
  return any;
}

void SgDetector::FindByCells() {
  int level = 0;
  while (grey_.width() >> level > kMostLatticeWidth_px && level + 1 < ReducedPictures::kLevels) {
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
      const std::array<Vec2, 4> ideal = SquareCornersIdeal(by * guess.modules_from_ideal);
      if (Taken(by * guess.modules_from_ideal)) continue;
      for (const ProbedOrientation& orientation : Probe(CornersPx(by * guess.modules_from_ideal))) {
        if (orientation.mirrored || orientation.correlation < kCoveredCorrelation) continue;
        std::array<Vec2, 4> turned;
        for (int k = 0; k < 4; ++k) turned[k] = ideal[(orientation.first_corner + k) % 4];
        Placement placement;
        placement.state.modules_from_ideal = ModulesFromSquareCorners(turned);
        placement.correlation = orientation.correlation;
        placements_.push_back(placement);
      }
    }
  }
  std::ranges::stable_sort(placements_, std::ranges::greater{}, &Placement::correlation);
  if (placements_.size() > kMostPlacements) placements_.resize(kMostPlacements);
  for (const Placement& placement : placements_) {
    if (Taken(placement.state.modules_from_ideal)) continue;
    const std::optional<SgReading> reading = ReadAsGuessed(placement.state);
    if (reading && RightWayRound(*reading)) Add(*reading, DetectionPath::kSurfGolay);
  }
}

bool SgDetector::TryGuesses(std::span<const BorderGuess> guesses) {
  // A few steps of the fit tell most wrong guesses from those that are worth more.
  hopes_.clear();
  for (const BorderGuess& guess : guesses) {
    if (Taken(guess.modules_from_ideal)) continue;
    Hope hope;
    hope.state.modules_from_ideal = hope.guess.modules_from_ideal = guess.modules_from_ideal;
    const double correlation =
        reader_.FitBorder(kFirstSteps, SgReader::Detail::kGlance, &hope.state);
    hope.worth = guess.votes * (correlation + reader_.VisibleBorder());
    // Covers draw a fit away that the border's pixels are plainly seen without.
    const double seen = UprightCorrelation(hope.guess);
    hope.plain = seen >= kPlainGuess;
    if (hope.plain) hope.worth = std::max(hope.worth, 2.0 * guess.votes * seen);
    if (hope.worth > kLeastWorth) hopes_.push_back(hope);
  }
  std::stable_sort(hopes_.begin(), hopes_.end(),
                   [](const Hope& a, const Hope& b) { return a.worth > b.worth; });
  bool any = false;
  int failures = 0, fits = 0;
  for (Hope& hope : hopes_) {
    if (failures >= kMostFailures || fits >= kMostFits) break;
    if (Taken(hope.state.modules_from_ideal, kSurelyVisible)) continue;
    ++fits;
    bool tried = false;
    std::optional<SgReading> reading = ReadFitted(&hope.state, &tried);
    if (!reading && hope.plain && !Taken(hope.guess.modules_from_ideal)) {
      tried = true;
      reading = ReadAsGuessed(hope.guess);
    }
    failures += tried;
    if (reading && RightWayRound(*reading) && Add(*reading, DetectionPath::kSurfGolay)) {
      failures = fits = 0;
      any = true;
    }
  }
  return any;
}

std::optional<SgReading> SgDetector::ReadFitted(BlockFitState* state, bool* tried) {
  reader_.FitBorder(kGuessSteps, SgReader::Detail::kCoarse, state);
  const std::array<Vec2, 4> corners = SquareCornersIdeal(state->modules_from_ideal);
  const bool again = std::any_of(tried_.begin(), tried_.end(), [&](const Mat3& tried_before) {
    return FarthestApart(SquareCornersIdeal(tried_before), corners) <
           kSamePlace * LongestSide(corners);
  });
  if (again) return std::nullopt;
  tried_.push_back(state->modules_from_ideal);
  if (reader_.VisibleBorder() < kGuessedVisible) return std::nullopt;
  if (Taken(state->modules_from_ideal, kSurelyVisible)) return std::nullopt;
  *tried = true;
  std::optional<SgReading> reading = reader_.ReadPlain(*state);
  if (!reading) reading = reader_.Read(*state);
  // Covers that look like ink or paper draw a fine fit away from a guess that was better.
  if (!reading && UprightCorrelation(*state) > kPlainBorder) reading = ReadAsGuessed(*state);
  return reading;
}

}  // namespace pleinair::tracker
