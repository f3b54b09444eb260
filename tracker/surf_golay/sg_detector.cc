#include "tracker/surf_golay/sg_detector.h"

#include <algorithm>
#include <utility>

#include "tracker/surf_golay/marker_square.h"

namespace pleinair::tracker {
namespace {

/// Minimum correlation of a quadrilateral with the border: by single pixels; its maximum deficit
/// against the best orientation; and after a fit.
constexpr double kProbedCorrelation = 0.35, kRivalCorrelation = 0.12, kFittedCorrelation = 0.45;
constexpr int kQuadSteps = 4;
/// Frames between two searches for new markers: for quadrilaterals, for occluded borders, and for
/// the latter while a known marker is missing.
constexpr int kFastEvery = 5, kSearchEvery = 30, kMissingSearchEvery = 15;
constexpr double kTrackedVisible = 0.12;
/// Visible share, relative to the frame before, below which a marker is searched for again. It may
/// have jumped and be tracked to a wrong place, rather than be occluded.
constexpr double kCoveredAtOnce = 0.85;

/// Without the number.
Candidate CandidateOf(const SgReading& reading, DetectionPath path) {
  Candidate candidate;
  candidate.detection.family = "sg";
  const SgCorners& corners =
      reading.corners_through_noise ? *reading.corners_through_noise : reading.corners;
  candidate.detection.corners_px = corners.px;
  candidate.detection.visible_fraction = reading.visible_fraction;
  candidate.detection.path = path;
  candidate.detection.visibility_side = reading.blocks_along;
  candidate.detection.visibility = reading.visible;
  candidate.corner_covariance_px2 = corners.covariance_px2;
  return candidate;
}

}  // namespace

Result<std::unique_ptr<SgDetector>> SgDetector::Create(const CameraModel& camera,
                                                       const SgOptions& options,
                                                       bool consecutive_frames) {
  std::unique_ptr<SgDetector> detector(new SgDetector(camera, options, consecutive_frames));
  PLEINAIR_RETURN_IF_ERROR(detector->image_.reader.SetNumbersInUse(options.numbers_in_use));
  return detector;
}

SgDetector::SgDetector(const CameraModel& camera, const SgOptions& options, bool consecutive_frames)
    : lens_(camera),
      options_(options),
      consecutive_frames_(consecutive_frames),
      image_(lens_),
      borders_(lens_, image_),
      cells_(lens_, image_) {}

std::vector<Candidate> SgDetector::Detect(ImageView<const std::uint8_t> grey) {
  warnings_.clear();
  image_.SetImage(grey);
  if (!grey.empty()) {
    const bool fast = options_.strategy != SgStrategy::kSurfGolay;
    const bool search = options_.strategy != SgStrategy::kFast;
    if (!consecutive_frames_) {
      if (fast) FindFast(grey);
      if (search) SearchImage(grey);
    } else {
      const std::vector<SgReading> doubtful = Track();
      const auto missing = [&](bool at_once) {
        return known_.AreMissing(image_.found.markers(), at_once);
      };
      if (fast && (known_.markers().empty() || missing(false) || frame_ % kFastEvery == 0))
        FindFast(grey);
      if (!fast && !doubtful.empty()) borders_.Find(grey, BorderSearch::Sizes::kLarge);
      for (const SgReading& reading : doubtful) image_.Add(reading, DetectionPath::kTracked);
      if (search && missing(true)) {
        borders_.Find(grey, BorderSearch::Sizes::kLarge);
        if (missing(true)) borders_.Find(grey, BorderSearch::Sizes::kAll);
        if (missing(true)) cells_.Find(grey.width());
      } else if (search && frame_ % (missing(false) ? kMissingSearchEvery : kSearchEvery) == 0) {
        SearchImage(grey);
      }
      known_.Remember(image_.found.markers());
    }
  }
  ++frame_;
  std::vector<Candidate> candidates;
  for (const FoundMarker& found : image_.found.markers()) {
    candidates.push_back(CandidateOf(found.reading, found.path));
    candidates.back().detection.id = found.reading.number;
  }
  for (const FoundMarker& unread : image_.UnreadMarkers()) {
    candidates.push_back(CandidateOf(unread.reading, unread.path));
  }
  return candidates;
}

void SgDetector::TryQuad(const Quad& quad) {
  const auto orientations = image_.upright.Orientations(quad.corners_px);
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
    if (!orientation.mirrored && image_.found.IsTaken(state.modules_from_undistorted)) return;
    std::optional<SgReading> reading = image_.reader.DecodeFast(state);
    if (!reading) {
      if (image_.reader.FitBorder(kQuadSteps, SgReader::Detail::kCoarse, &state) <
          kFittedCorrelation)
        continue;
      reading = image_.reader.DecodeFull(state);
    }
    if (!reading) continue;
    if (orientation.mirrored) {
      warnings_.push_back("a marker that looks like number " + std::to_string(reading->number) +
                          " is printed mirrored; print it again without mirroring");
    } else {
      image_.Add(*reading, DetectionPath::kFast);
    }
    return;
  }
}

void SgDetector::FindFast(ImageView<const std::uint8_t> grey) {
  quads_.Detect(grey, &observed_quads_);
  for (const Quad& quad : observed_quads_) TryQuad(quad);
  image_.unread_by_quads = image_.reader.UnreadBorders().size();
}

void SgDetector::SearchImage(ImageView<const std::uint8_t> grey) {
  if (!image_.found.markers().empty()) {
    borders_.Find(grey, BorderSearch::Sizes::kAll);
    return;
  }
  const bool any = borders_.Find(grey, BorderSearch::Sizes::kLarge);
  // Among several markers there may be small ones.
  if (any && image_.found.markers().size() < kMinFoundToSearchOn) return;
  if (!borders_.Find(grey, BorderSearch::Sizes::kAll, any) && !any) cells_.Find(grey.width());
}

std::vector<SgReading> SgDetector::Track() {
  std::vector<SgReading> doubtful;
  for (const KnownMarker& known : known_.markers()) {
    const std::optional<SgReading> reading = image_.reader.Track(known.number, known.Predict());
    if (!reading || reading->visible_fraction < kTrackedVisible) continue;
    const bool covered_at_once =
        reading->visible_fraction < kCoveredAtOnce * known.visible_fraction;
    const bool searched_anyway =
        reading->visible_fraction < kSurelyVisible && frame_ % kFastEvery == 0;
    if (covered_at_once || searched_anyway) {
      doubtful.push_back(*reading);
    } else {
      image_.Add(*reading, DetectionPath::kTracked);
    }
  }
  return doubtful;
}

}  // namespace pleinair::tracker
