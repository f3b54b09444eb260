#include "tracker/surf_golay/sg_detector.h"

#include <algorithm>
#include <utility>

#include "tracker/surf_golay/decoding_confidence.h"
#include "tracker/surf_golay/marker_square.h"

namespace pleinair::tracker {
namespace {

/// Correlation of a quadrilateral with the border that makes it worth a fit, by single pixels and
/// after one.
constexpr double kProbedCorrelation = 0.35, kRivalCorrelation = 0.12, kFittedCorrelation = 0.45;
constexpr int kQuadSteps = 4;
constexpr double kProbeSide_px = 70.0;
/// Frames between two searches for markers that are new: for quadrilaterals, for borders of which
/// something is covered, and for those while a marker that was there is missing.
constexpr int kFastEvery = 5, kSearchEvery = 30, kMissingSearchEvery = 15;
/// A marker that was not observed for so many frames is forgotten; a search for its border is tried
/// in each of the first few and then now and then.
constexpr int kForgetAfter = 90, kSearchAtOnce = 5;
constexpr double kTrackedVisible = 0.12;
/// Where so little is left of what the frame before showed, the marker may have jumped and be
/// followed to a wrong place, rather than a cover have come.
constexpr double kCoveredAtOnce = 0.85;
/// Correlation of its border, pixel by pixel, below which a marker of which not even so much is
/// observed (kSurelyVisible) is a little beside. (Of 108 the one that was had .16, of the others
/// none less than .34.)
constexpr double kShiftedCorrelation = 0.25;
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
  reader_.SetImage(grey);
  reduced_.SetImage(grey);
  if (!grey.empty()) {
    const bool fast = options_.strategy != SgStrategy::kSurfGolay;
    const bool search = options_.strategy != SgStrategy::kFast;
    if (!consecutive_frames_) {
      if (fast) FindFast();
      if (search) SearchImage();
    } else {
      const std::vector<SgReading> doubtful = Track();
      const auto missing = [&](bool at_once) {
        return std::any_of(known_.begin(), known_.end(), [&](const Known& known) {
          return (!at_once || known.frames_unseen < kSearchAtOnce) &&
                 std::none_of(found_.begin(), found_.end(), [&](const Found& found) {
                   return found.reading.number == known.number;
                 });
        });
      };
      if (fast && (known_.empty() || missing(false) || frame_ % kFastEvery == 0)) FindFast();
      if (!fast && !doubtful.empty()) FindBySurf(BorderSearch::Sizes::kLarge);
      for (const SgReading& reading : doubtful) Add(reading, DetectionPath::kTracked);
      if (search && missing(true)) {
        FindBySurf(BorderSearch::Sizes::kLarge);
        if (missing(true)) FindBySurf(BorderSearch::Sizes::kAll);
        if (missing(true)) FindByCells();
      } else if (search && frame_ % (missing(false) ? kMissingSearchEvery : kSearchEvery) == 0) {
        SearchImage();
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
    const SgCorners& corners =
        reading.corners_through_noise ? *reading.corners_through_noise : reading.corners;
    candidate.detection.corners_px = corners.px;
    candidate.detection.visible_fraction = reading.visible_fraction;
    candidate.detection.path = found.path;
    candidate.detection.visibility_side = reading.blocks_along;
    candidate.detection.visibility = reading.visible;
    candidate.corner_covariance_px2 = corners.covariance_px2;
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

bool SgDetector::Taken(const Mat3& modules_from_undistorted, double visible) const {
  const std::array<Vec2, 4> corners = UndistortedSquareCorners(modules_from_undistorted);
  const Vec2 centre = CentreOf(corners);
  return std::any_of(found_.begin(), found_.end(), [&](const Found& found) {
    const std::array<Vec2, 4>& other = found.corners_undistorted;
    if (!Inside(other, centre) && !Inside(corners, CentreOf(other))) return false;
    return found.reading.visible_fraction >= visible ||
           MaxCornerDistance(other, corners) < kSamePlace * LongestSide(corners);
  });
}

std::array<Vec2, 4> SgDetector::CornersPx(const Mat3& modules_from_undistorted) const {
  std::array<Vec2, 4> corners = UndistortedSquareCorners(modules_from_undistorted);
  for (Vec2& corner : corners) corner = lens_.PixelOfUndistorted(corner);
  return corners;
}

bool SgDetector::ContradictsBorder(const SgReading& reading) const {
  if (reading.visible_fraction >= kSurelyVisible) return false;
  const std::array<Vec2, 4> corners = UndistortedSquareCorners(reading.modules_from_undistorted);
  return std::ranges::any_of(reader_.UnreadBorders(), [&](const Mat3& unread) {
    const std::array<Vec2, 4> open = UndistortedSquareCorners(unread);
    return Inside(open, CentreOf(corners)) &&
           MaxCornerDistance(open, corners) > kOtherPlace * LongestSide(open);
  });
}

bool SgDetector::Add(const SgReading& reading, DetectionPath path) {
  if (ContradictsBorder(reading)) return false;
  // Two prints cannot lie in one place: the one of which more is observed is there.
  const std::array<Vec2, 4> corners = UndistortedSquareCorners(reading.modules_from_undistorted);
  for (Found& found : found_) {
    const std::array<Vec2, 4>& other = found.corners_undistorted;
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

std::array<BorderOrientation, 2> SgDetector::TestOrientation(std::array<Vec2, 4> corners_px) {
  double side = LongestSide(corners_px), scale = 1.0;
  int level = 0;
  while (side > kProbeSide_px && level + 1 < ReducedImages::kLevels) {
    side *= 0.5;
    scale *= 2.0;
    ++level;
  }
  for (Vec2& corner : corners_px) {
    corner = {(corner.x + 0.5) / scale - 0.5, (corner.y + 0.5) / scale - 0.5};
  }
  return orientation_test_.Evaluate(reduced_.Level(level), corners_px);
}

bool SgDetector::RightWayRound(const SgReading& reading) {
  // Rim and margin look the same from all sides, and a turned content reads as some other word: the
  // border's shapes must fit better this way round than any other.
  const BorderOrientation best = TestOrientation(reading.corners.px)[0];
  if (best.first_corner != 0 || best.mirrored) return false;
  // Edges of covers pass for the marker's rim, but not for its border's shapes.
  return reading.visible_fraction >= kSurelyVisible || best.correlation >= kShiftedCorrelation;
}

double SgDetector::UprightCorrelation(const BlockFitState& state) {
  const BorderOrientation observed = TestOrientation(CornersPx(state.modules_from_undistorted))[0];
  return !observed.mirrored && observed.first_corner == 0 ? observed.correlation : 0.0;
}

std::optional<SgReading> SgDetector::DecodeAsGuessed(const BlockFitState& guess) {
  std::optional<SgReading> reading = reader_.DecodeAsGuessed(guess);
  if (!reading) return reading;
  const double correlation = TestOrientation(reading->corners.px)[0].correlation;
  if (!IsConfident(reading->confidence_bits, reading->visible_fraction, correlation))
    reading.reset();
  return reading;
}

void SgDetector::TryQuad(const Quad& quad) {
  const auto orientations = TestOrientation(quad.corners_px);
  for (std::size_t i = 0; i < orientations.size(); ++i) {
    const BorderOrientation& orientation = orientations[i];
    if (orientation.correlation < kProbedCorrelation ||
        orientation.correlation < orientations[0].correlation - kRivalCorrelation) {
      return;
    }
    std::array<Vec2, 4> corners;
    for (int k = 0; k < 4; ++k) {
      const int at = orientation.mirrored ? (orientation.first_corner + 4 - k) % 4
                                          : (orientation.first_corner + k) % 4;
      const Vec2 corner = quad.corners_px[at];
      corners[k] = lens_.Undistort(corner.x, corner.y);
    }
    BlockFitState state;
    state.modules_from_undistorted = ModulesFromSquareCorners(corners);
    if (!orientation.mirrored && Taken(state.modules_from_undistorted)) return;
    std::optional<SgReading> reading = reader_.DecodeFast(state);
    if (!reading) {
      if (reader_.FitBorder(kQuadSteps, SgReader::Detail::kCoarse, &state) < kFittedCorrelation)
        continue;
      reading = reader_.DecodeFull(state);
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
  quads_.Detect(grey_, &observed_quads_);
  for (const Quad& quad : observed_quads_) TryQuad(quad);
}

std::vector<SgReading> SgDetector::Track() {
  std::vector<SgReading> doubtful;
  for (const Known& known : known_) {
    std::array<Vec2, 4> corners = known.corners_undistorted;
    if (known.has_velocity && known.frames_unseen == 0) {
      for (int i = 0; i < 4; ++i) corners[i] = corners[i] + known.velocity[i];
    }
    BlockFitState state;
    state.modules_from_undistorted = ModulesFromSquareCorners(corners);
    state.blur_px = known.blur_px;
    const std::optional<SgReading> reading = reader_.Track(known.number, state);
    if (!reading || reading->visible_fraction < kTrackedVisible) continue;
    const bool covered_at_once =
        reading->visible_fraction < kCoveredAtOnce * known.visible_fraction;
    const bool searched_anyway =
        reading->visible_fraction < kSurelyVisible && frame_ % kFastEvery == 0;
    if (covered_at_once || searched_anyway) {
      doubtful.push_back(*reading);
    } else {
      Add(*reading, DetectionPath::kTracked);
    }
  }
  return doubtful;
}

void SgDetector::Remember() {
  for (Known& known : known_) ++known.frames_unseen;
  for (const Found& found : found_) {
    const SgReading& reading = found.reading;
    const std::array<Vec2, 4> corners = UndistortedSquareCorners(reading.modules_from_undistorted);
    // The nearest of its number: a number may hang in two places.
    Known* same = nullptr;
    for (Known& known : known_) {
      if (known.number != reading.number || known.frames_unseen == 0) continue;
      if (same == nullptr || MaxCornerDistance(known.corners_undistorted, corners) <
                                 MaxCornerDistance(same->corners_undistorted, corners)) {
        same = &known;
      }
    }
    if (same == nullptr) {
      known_.push_back(
          {reading.number, corners, {}, false, reading.blur_px, 0, reading.visible_fraction});
      continue;
    }
    same->has_velocity = same->frames_unseen == 1;
    for (int i = 0; i < 4; ++i) same->velocity[i] = corners[i] - same->corners_undistorted[i];
    same->corners_undistorted = corners;
    same->blur_px = reading.blur_px;
    same->visible_fraction = reading.visible_fraction;
    same->frames_unseen = 0;
  }
  std::erase_if(known_, [](const Known& known) { return known.frames_unseen > kForgetAfter; });
}

}  // namespace pleinair::tracker
