#include "tracker/surf_golay/sg_detector.h"

#include <algorithm>
#include <cmath>

#include "tracker/homography.h"
#include "tracker/surf_golay/number_proof.h"
#include "tracker/surf_golay/print_square.h"

namespace pleinair::tracker {
namespace {

/// Correlation of a quadrilateral with the border that makes it worth a fit, by single pixels and
/// after one.
constexpr double kProbedCorrelation = 0.35, kRivalCorrelation = 0.12, kFittedCorrelation = 0.45;
constexpr int kQuadSteps = 4, kFirstSteps = 2, kGuessSteps = 5;
constexpr double kProbeSide_px = 70.0;
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
constexpr double kSamePlace = 0.04;  ///< Of the side: two fits that ended here are one.
/// Frames between two searches for markers that are new: for quadrilaterals, for borders of which
/// something is covered, and for those while a marker that was there is missing.
constexpr int kFastEvery = 5, kSearchEvery = 30, kMissingSearchEvery = 15;
/// A marker that was not seen for so many frames is forgotten; a search for its border is tried in
/// each of the first few and then now and then.
constexpr int kForgetAfter = 90, kSearchAtOnce = 5;
constexpr double kTrackedVisible = 0.12;
/// A marker of which less is seen may be a little beside: other guesses there are read as well, and
/// one whose border correlates less, pixel by pixel, is. (Of 108 the one that was had .16, of the
/// others none less than .34.)
constexpr double kSurelyVisible = 0.5, kShiftedCorrelation = 0.25;
/// Correlation of a guess's border, pixel by pixel, that makes it worth reading as it is. (Of 3,530
/// guesses in pictures without a marker none had more than 0.27.)
constexpr double kPlainGuess = 0.3;
/// Share of the border that must look right after a guess was fitted coarsely.
constexpr double kGuessedVisible = 0.15;

double SideOf(const std::array<Vec2, 4>& corners) {
  double longest = 0.0;
  for (int i = 0; i < 4; ++i) longest = std::max(longest, Norm(corners[i] - corners[(i + 1) % 4]));
  return longest;
}

double Apart(const std::array<Vec2, 4>& a, const std::array<Vec2, 4>& b) {
  double farthest = 0.0;
  for (int i = 0; i < 4; ++i) farthest = std::max(farthest, Norm(a[i] - b[i]));
  return farthest;
}

bool Inside(const std::array<Vec2, 4>& quad, Vec2 point) {
  const auto right_of = [&](int i) {
    const Vec2 along = quad[(i + 1) % 4] - quad[i], to = point - quad[i];
    return along.x * to.y - along.y * to.x > 0.0;
  };
  const bool first = right_of(0);
  return right_of(2) == first && right_of(1) == first && right_of(3) == first;
}

Vec2 CentreOf(const std::array<Vec2, 4>& quad) {
  return (quad[0] + quad[1] + quad[2] + quad[3]) * 0.25;
}

}  // namespace

Result<std::unique_ptr<SgDetector>> SgDetector::Create(const CameraModel& camera,
                                                       const SgOptions& options,
                                                       bool consecutive_frames) {
  std::unique_ptr<SgDetector> detector(new SgDetector(camera, options, consecutive_frames));
  PLEINAIR_RETURN_IF_ERROR(detector->reader_.SetNumbersInUse(options.numbers_in_use));
  return detector;
}

SgDetector::SgDetector(const CameraModel& camera, const SgOptions& options, bool consecutive_frames)
    : lens_(camera),
      options_(options),
      consecutive_frames_(consecutive_frames),
      reader_(lens_),
      lattice_(lens_) {}

std::vector<LostMarker> SgDetector::Lost() const {
  std::vector<LostMarker> lost;
  for (const Known& known : known_) {
    if (known.frames_unseen > 0) lost.push_back({"sg", known.number, known.frames_unseen});
  }
  return lost;
}

std::vector<Candidate> SgDetector::Detect(ImageView<const std::uint8_t> grey) {
  grey_ = grey;
  found_.clear();
  warnings_.clear();
  reader_.SetPicture(grey);
  reduced_.SetPicture(grey);
  if (!grey.empty()) {
    const bool fast = options_.strategy != SgStrategy::kSurfGolay;
    const bool search = options_.strategy != SgStrategy::kFast;
    if (!consecutive_frames_) {
      if (fast) FindFast();
      if (search) SearchPicture();
    } else {
      Track();
      const auto missing = [&](bool at_once) {
        return std::any_of(known_.begin(), known_.end(), [&](const Known& known) {
          return (!at_once || known.frames_unseen < kSearchAtOnce) &&
                 std::none_of(found_.begin(), found_.end(), [&](const Found& found) {
                   return found.reading.number == known.number;
                 });
        });
      };
      if (fast && (known_.empty() || missing(false) || frame_ % kFastEvery == 0)) FindFast();
      if (search && missing(true)) {
        FindBySurf(BorderSearch::Sizes::kLarge);
        if (missing(true)) FindBySurf(BorderSearch::Sizes::kAll);
        if (missing(true)) FindByCells();
      } else if (search && frame_ % (missing(false) ? kMissingSearchEvery : kSearchEvery) == 0) {
        SearchPicture();
      }
      Remember();
    }
  }
  ++frame_;
  std::vector<Candidate> candidates;
  for (const Found& found : found_) {
    const SgReading& reading = found.reading;
    Candidate candidate;
    candidate.detection.family = "sg";
    candidate.detection.id = reading.number;
    candidate.detection.corners_px = reading.corners_px;
    candidate.detection.visible_fraction = reading.visible_fraction;
    candidate.detection.path = found.path;
    candidate.detection.visibility_side = reading.blocks_along;
    candidate.detection.visibility = reading.visible;
    candidate.corner_covariance_px2 = reading.corner_covariance_px2;
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

bool SgDetector::Taken(const Mat3& modules_from_ideal, double visible) const {
  const std::array<Vec2, 4> corners = SquareCornersIdeal(modules_from_ideal);
  const Vec2 centre = CentreOf(corners);
  return std::any_of(found_.begin(), found_.end(), [&](const Found& found) {
    const std::array<Vec2, 4>& other = found.corners_ideal;
    if (!Inside(other, centre) && !Inside(corners, CentreOf(other))) return false;
    return found.reading.visible_fraction >= visible ||
           Apart(other, corners) < kSamePlace * SideOf(corners);
  });
}

std::array<Vec2, 4> SgDetector::CornersPx(const Mat3& modules_from_ideal) const {
  std::array<Vec2, 4> corners = SquareCornersIdeal(modules_from_ideal);
  for (Vec2& corner : corners) corner = lens_.PixelOfIdeal(corner);
  return corners;
}

bool SgDetector::Add(const SgReading& reading, DetectionPath path) {
  // Two prints cannot lie in one place: the one of which more is seen is there.
  const std::array<Vec2, 4> corners = SquareCornersIdeal(reading.modules_from_ideal);
  for (Found& found : found_) {
    const std::array<Vec2, 4>& other = found.corners_ideal;
    if (!Inside(other, CentreOf(corners)) && !Inside(corners, CentreOf(other))) continue;
    if (reading.margin * reading.visible_fraction >
        found.reading.margin * found.reading.visible_fraction) {
      found = {reading, path, corners};
      return true;
    }
    return false;
  }
  found_.push_back({reading, path, corners});
  return true;
}

std::array<ProbedOrientation, 2> SgDetector::Probe(std::array<Vec2, 4> corners_px) {
  double side = SideOf(corners_px), scale = 1.0;
  int level = 0;
  while (side > kProbeSide_px && level + 1 < ReducedPictures::kLevels) {
    side *= 0.5;
    scale *= 2.0;
    ++level;
  }
  for (Vec2& corner : corners_px) {
    corner = {(corner.x + 0.5) / scale - 0.5, (corner.y + 0.5) / scale - 0.5};
  }
  return probe_.Look(reduced_.Level(level), corners_px);
}

bool SgDetector::RightWayRound(const SgReading& reading) {
  // Rim and margin look the same from all sides, and a turned content reads as some other word: the
  // border's shapes must fit better this way round than any other.
  const ProbedOrientation best = Probe(reading.corners_px)[0];
  if (best.first_corner != 0 || best.mirrored) return false;
  // Edges of covers pass for the print's rim, but not for its border's shapes.
  return reading.visible_fraction >= kSurelyVisible || best.correlation >= kShiftedCorrelation;
}

double SgDetector::UprightCorrelation(const BlockFitState& state) {
  const ProbedOrientation seen = Probe(CornersPx(state.modules_from_ideal))[0];
  return !seen.mirrored && seen.first_corner == 0 ? seen.correlation : 0.0;
}

std::optional<SgReading> SgDetector::ReadAsGuessed(const BlockFitState& guess) {
  std::optional<SgReading> reading = reader_.ReadAsGuessed(guess);
  if (!reading) return reading;
  const double correlation = Probe(reading->corners_px)[0].correlation;
  if (!IsProved(reading->proof_bits, reading->visible_fraction, correlation)) reading.reset();
  return reading;
}

void SgDetector::TryQuad(const Quad& quad) {
  const auto orientations = Probe(quad.corners_px);
  for (std::size_t i = 0; i < orientations.size(); ++i) {
    const ProbedOrientation& orientation = orientations[i];
    if (orientation.correlation < kProbedCorrelation ||
        orientation.correlation < orientations[0].correlation - kRivalCorrelation) {
      return;
    }
    std::array<Vec2, 4> corners;
    for (int k = 0; k < 4; ++k) {
      const int at = orientation.mirrored ? (orientation.first_corner + 4 - k) % 4
                                          : (orientation.first_corner + k) % 4;
      const Vec2 corner = quad.corners_px[at];
      corners[k] = lens_.Ideal(corner.x, corner.y);
    }
    BlockFitState state;
    state.modules_from_ideal = ModulesFromSquareCorners(corners);
    if (!orientation.mirrored && Taken(state.modules_from_ideal)) return;
    std::optional<SgReading> reading = reader_.ReadPlain(state);
    if (!reading) {
      if (reader_.FitBorder(kQuadSteps, SgReader::Detail::kCoarse, &state) < kFittedCorrelation)
        continue;
      reading = reader_.Read(state);
    }
    if (!reading) continue;
    if (orientation.mirrored) {
      warnings_.push_back("a marker that looks like number " + std::to_string(reading->number) +
                          " is printed mirrored; print it again without mirroring");
    } else {
      Add(*reading, DetectionPath::kFast);
    }
    return;
  }
}

void SgDetector::FindFast() {
  quads_.Detect(grey_, &seen_quads_);
  for (const Quad& quad : seen_quads_) TryQuad(quad);
}

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
    for (const Found& found : found_) taken_.push_back(found.reading.corners_px);
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
    return Apart(SquareCornersIdeal(tried_before), corners) < kSamePlace * SideOf(corners);
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

void SgDetector::Track() {
  for (const Known& known : known_) {
    std::array<Vec2, 4> corners = known.corners_ideal;
    if (known.has_velocity && known.frames_unseen == 0) {
      for (int i = 0; i < 4; ++i) corners[i] = corners[i] + known.velocity[i];
    }
    BlockFitState state;
    state.modules_from_ideal = ModulesFromSquareCorners(corners);
    state.blur_px = known.blur_px;
    const std::optional<SgReading> reading = reader_.Follow(known.number, state);
    if (reading && reading->visible_fraction >= kTrackedVisible) {
      Add(*reading, DetectionPath::kTracked);
    }
  }
}

void SgDetector::Remember() {
  for (Known& known : known_) ++known.frames_unseen;
  for (const Found& found : found_) {
    const SgReading& reading = found.reading;
    const std::array<Vec2, 4> corners = SquareCornersIdeal(reading.modules_from_ideal);
    // The nearest of its number: a number may hang in two places.
    Known* same = nullptr;
    for (Known& known : known_) {
      if (known.number != reading.number || known.frames_unseen == 0) continue;
      if (same == nullptr ||
          Apart(known.corners_ideal, corners) < Apart(same->corners_ideal, corners)) {
        same = &known;
      }
    }
    if (same == nullptr) {
      known_.push_back({reading.number, corners, {}, false, reading.blur_px, 0});
      continue;
    }
    same->has_velocity = same->frames_unseen == 1;
    for (int i = 0; i < 4; ++i) same->velocity[i] = corners[i] - same->corners_ideal[i];
    same->corners_ideal = corners;
    same->blur_px = reading.blur_px;
    same->frames_unseen = 0;
  }
  std::erase_if(known_, [](const Known& known) { return known.frames_unseen > kForgetAfter; });
}

}  // namespace pleinair::tracker
