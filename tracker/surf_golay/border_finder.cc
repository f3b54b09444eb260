#include "tracker/surf_golay/border_finder.h"

#include <algorithm>
#include <utility>

#include "tracker/surf_golay/border_templates.h"
#include "tracker/surf_golay/cells/decoding_confidence.h"
#include "tracker/surf_golay/marker_square.h"

namespace pleinair::tracker {
namespace {

constexpr int kFirstSteps = 2, kGuessSteps = 5;
/// Number of S-G search hypotheses that are ranked together; the maximum number that is fitted; the
/// maximum number that may prove unreadable before the search ends.
constexpr int kGuessesAtOnce = 14, kMaxFits = 9, kMaxFailures = 4;
/// Minimum product of votes and fit that makes a hypothesis worth a fit. In images without a marker
/// a quarter of the best hypotheses reach it.
constexpr double kMinWorth = 1.2;
/// Minimum correlation of a hypothesis's border, pixel by pixel, that makes it worth decoding
/// without a fit. In images without a marker none of 3,530 hypotheses had more than 0.27.
constexpr double kPlainGuess = 0.3;
/// Minimum share of the border that matches after the coarse fit of a hypothesis.
constexpr double kGuessedVisible = 0.15;

}  // namespace

bool BorderFinder::Find(ImageView<const std::uint8_t> grey, BorderSearch::Sizes sizes,
                        bool refill) {
  if (search_ == nullptr) {
    const BorderSearchOptions options;
    search_ = std::make_unique<BorderSearch>(
        lens_, MakeBorderTemplates(options.surf.descriptor_window_scales), options);
  }
  bool any = false;
  for (bool more = true; more; refill = true) {
    taken_.clear();
    for (const FoundMarker& found : image_.found.markers())
      taken_.push_back(found.reading.corners.px);
    search_->Find(grey, taken_, sizes, refill, &guesses_);
    tried_.clear();
    // While hypotheses prove to be markers, more of them may.
    for (std::size_t first = 0; first < guesses_.size(); first += kGuessesAtOnce) {
      const std::size_t count = std::min<std::size_t>(kGuessesAtOnce, guesses_.size() - first);
      if (!TryGuesses(std::span(guesses_).subspan(first, count))) break;
      any = true;
    }
    // Many markers had many of the keypoints, so that others had few.
    more = image_.found.markers().size() >= taken_.size() + (refill ? 1 : kMinFoundToSearchOn);
  }
  return any;
}

bool BorderFinder::TryGuesses(std::span<const BorderGuess> guesses) {
  // A few steps of the fit separate most wrong hypotheses from the better ones.
  ranked_guesses_.clear();
  for (const BorderGuess& guess : guesses) {
    if (image_.found.IsTaken(guess.modules_from_undistorted)) continue;
    RankedGuess ranked;
    ranked.state.modules_from_undistorted = ranked.guess.modules_from_undistorted =
        guess.modules_from_undistorted;
    const double correlation =
        image_.reader.FitBorder(kFirstSteps, SgReader::Detail::kProbe, &ranked.state);
    ranked.rank = guess.votes * (correlation + image_.reader.VisibleBorder());
    // An occluder may draw the fit away although the pixels of the border match clearly.
    const double observed = image_.upright.UprightCorrelation(ranked.guess);
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
    if (image_.found.IsTaken(ranked.state.modules_from_undistorted, kSurelyVisible)) continue;
    ++fits;
    bool tried = false;
    std::optional<SgReading> reading = DecodeFitted(&ranked.state, &tried);
    if (!reading && ranked.plain && !image_.found.IsTaken(ranked.guess.modules_from_undistorted)) {
      tried = true;
      reading = image_.DecodeAsGuessed(ranked.guess);
    }
    failures += tried;
    if (reading && image_.upright.IsUpright(*reading) &&
        image_.Add(*reading, DetectionPath::kSurfGolay)) {
      failures = fits = 0;
      any = true;
    }
  }
  return any;
}

std::optional<SgReading> BorderFinder::DecodeFitted(BlockFitState* state, bool* tried) {
  image_.reader.FitBorder(kGuessSteps, SgReader::Detail::kCoarse, state);
  const std::array<Vec2, 4> corners = UndistortedSquareCorners(state->modules_from_undistorted);
  const bool again = std::any_of(tried_.begin(), tried_.end(), [&](const Mat3& tried_before) {
    return MaxCornerDistance(UndistortedSquareCorners(tried_before), corners) <
           kSameMarkerDistance * LongestSide(corners);
  });
  if (again) return std::nullopt;
  tried_.push_back(state->modules_from_undistorted);
  if (image_.reader.VisibleBorder() < kGuessedVisible) return std::nullopt;
  if (image_.found.IsTaken(state->modules_from_undistorted, kSurelyVisible)) return std::nullopt;
  *tried = true;
  std::optional<SgReading> reading = image_.reader.DecodeFast(*state);
  if (!reading) reading = image_.reader.DecodeFull(*state);
  // An occluder that looks like ink or paper draws a fine fit away from a better hypothesis.
  if (!reading && image_.upright.UprightCorrelation(*state) > kPlainBorder)
    reading = image_.DecodeAsGuessed(*state);
  return reading;
}

}  // namespace pleinair::tracker
