#include "tracker/picture_target/picture_detector.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "tracker/pose/homography.h"
#include "tracker/pose/planar_pose.h"

namespace pleinair::tracker {
namespace {

constexpr double kHalf = 0.5 * kTargetSide;
/// Maximum number of failed hypotheses of one target in a frame; the others are skipped.
constexpr int kMaxFailures = 4;
/// First frames in which a lost target is searched for each time, and the interval of frames after
/// them.
constexpr int kSearchAtOnce = 5, kSearchEvery = 3;
/// Maximum reprojection error of the corners under any pose, in shares of a side; in pixels where
/// that is more.
constexpr double kMaxMisfit = 0.02, kMinMisfit_px = 0.5;
/// Mirror images are searched for in single images, and at this interval of consecutive frames.
constexpr int kMirroredSearchInterval = 30;

std::array<Vec2, 4> UndistortedCorners(const Mat3& target_from_undistorted) {
  const Mat3 inverse = Adjugate(target_from_undistorted);
  std::array<Vec2, 4> corners;
  for (int i = 0; i < 4; ++i) {
    corners[i] =
        Apply(inverse, {kHalf + kHalf * kSquareCorners[i].x, kHalf - kHalf * kSquareCorners[i].y});
  }
  return corners;
}

Mat3 TargetFromCorners(const std::array<Vec2, 4>& corners_undistorted) {
  constexpr Mat3 kTargetFromUnit{{kHalf, 0, kHalf, 0, -kHalf, kHalf, 0, 0, 1}};
  return kTargetFromUnit * Adjugate(HomographyToQuad(corners_undistorted));
}

}  // namespace

PictureDetector::PictureDetector(const CameraModel& camera,
                                 std::vector<std::shared_ptr<const PictureTarget>> targets,
                                 bool consecutive_frames)
    : lens_(camera),
      targets_(std::move(targets)),
      consecutive_frames_(consecutive_frames),
      reader_(lens_),
      search_(lens_, targets_),
      known_(targets_.size()) {
  for (const auto& target : targets_) pyramids_.emplace_back(target->picture.view());
}

std::vector<LostMarker> PictureDetector::Lost() const {
  std::vector<LostMarker> lost;
  for (std::size_t t = 0; t < targets_.size(); ++t) {
    if (!known_[t].ever_found || known_[t].found) continue;
    lost.push_back(
        {kPictureFamily, static_cast<int>(t), known_[t].frames_unseen, targets_[t]->name});
  }
  return lost;
}

bool PictureDetector::SearchIsDue() const {
  if (!consecutive_frames_ || frame_ % kSearchEvery == 0) return true;
  return std::any_of(known_.begin(), known_.end(), [](const Known& known) {
    return known.ever_found && !known.found && known.frames_unseen < kSearchAtOnce;
  });
}

std::vector<Candidate> PictureDetector::Detect(ImageView<const std::uint8_t> grey) {
  std::vector<Candidate> candidates;
  warnings_.clear();
  reader_.SetImage(grey);
  for (std::size_t t = 0; t < targets_.size(); ++t) {
    known_[t].found = false;
    if (consecutive_frames_ && known_[t].ever_found) Track(t, &candidates);
  }
  wanted_.clear();
  for (const Known& known : known_) wanted_.push_back(!known.found);
  const bool missing = std::find(wanted_.begin(), wanted_.end(), true) != wanted_.end();
  if (missing && SearchIsDue() && !grey.empty()) {
    search_.Find(grey, wanted_, &guesses_);
    Search(&candidates);
    if (!consecutive_frames_ || frame_ % kMirroredSearchInterval == 0) SearchMirrored();
  }
  for (Known& known : known_) {
    if (!known.found) ++known.frames_unseen;
  }
  ++frame_;
  return candidates;
}

void PictureDetector::Track(std::size_t target, std::vector<Candidate>* candidates) {
  const Known& known = known_[target];
  std::array<Vec2, 4> corners = known.corners_undistorted;
  if (known.has_velocity && known.frames_unseen == 0) {
    for (int i = 0; i < 4; ++i) corners[i] = corners[i] + known.velocity[i];
  }
  const std::optional<TargetReading> reading =
      reader_.Read(pyramids_[target], {TargetFromCorners(corners), known.blur_px});
  if (!reading) return;
  std::optional<Candidate> candidate = CandidateOf(target, *reading);
  if (!candidate) return;
  candidate->detection.path = DetectionPath::kTracked;
  candidates->push_back(std::move(*candidate));
  Remember(target, *reading);
}

void PictureDetector::Search(std::vector<Candidate>* candidates) {
  std::vector<int> failures(targets_.size(), 0);
  for (const TargetGuess& guess : guesses_) {
    if (known_[guess.target].found || failures[guess.target] >= kMaxFailures) continue;
    const std::optional<TargetReading> reading =
        reader_.Read(pyramids_[guess.target], {guess.target_from_undistorted});
    std::optional<Candidate> candidate;
    if (reading) candidate = CandidateOf(guess.target, *reading);
    if (!candidate) {
      ++failures[guess.target];
      continue;
    }
    candidate->detection.path = DetectionPath::kSurfGolay;
    candidates->push_back(std::move(*candidate));
    Remember(guess.target, *reading);
  }
}

void PictureDetector::SearchMirrored() {
  for (std::size_t t = 0; t < targets_.size(); ++t) wanted_[t] = !known_[t].found;
  if (std::find(wanted_.begin(), wanted_.end(), true) == wanted_.end()) return;
  search_.FindMirrored(wanted_, &guesses_);
  std::vector<int> failures(targets_.size(), 0);
  for (const TargetGuess& guess : guesses_) {
    if (failures[guess.target] < 0 || failures[guess.target] >= kMaxFailures) continue;
    if (!reader_.Read(pyramids_[guess.target], {guess.target_from_undistorted})) {
      ++failures[guess.target];
      continue;
    }
    failures[guess.target] = -1;
    warnings_.push_back("a picture that looks like \"" + targets_[guess.target]->name +
                        "\" is mirrored; print it again without mirroring, or turn off the "
                        "camera's mirroring");
  }
}

void PictureDetector::Remember(std::size_t target, const TargetReading& reading) {
  Known& known = known_[target];
  const std::array<Vec2, 4> corners = UndistortedCorners(reading.target_from_undistorted);
  known.has_velocity = known.ever_found && known.frames_unseen == 0;
  for (int i = 0; i < 4; ++i) known.velocity[i] = corners[i] - known.corners_undistorted[i];
  known.corners_undistorted = corners;
  known.blur_px = reading.blur_px;
  known.frames_unseen = 0;
  known.found = known.ever_found = true;
}

std::optional<Candidate> PictureDetector::CandidateOf(std::size_t target,
                                                      const TargetReading& reading) const {
  const PictureTarget& of = *targets_[target];
  Candidate candidate;
  MarkerDetection& detection = candidate.detection;
  detection.family = kPictureFamily;
  detection.id = static_cast<int>(target);
  detection.name = of.name;
  detection.visible_fraction = reading.visible_fraction;
  detection.visibility_side = reading.blocks_along;
  detection.visibility = reading.visible;
  candidate.corner_covariance_px2.emplace();
  reader_.Corners(reading, 1.0, 1.0, &detection.corners_px, &*candidate.corner_covariance_px2);
  // The pose comes from a square in the target's centre.
  PoseSquare square;
  const double edge_m = std::min(of.width_m, of.height_m);
  square.edge = Metres(edge_m);
  reader_.Corners(reading, edge_m / of.width_m, edge_m / of.height_m, &square.corners_px,
                  &square.corner_covariance_px2);
  // A homography's eight motions fit more shapes than a target can show to a camera.
  const std::optional<PoseEstimate> pose = EstimatePlanarPose(
      lens_.camera(), square.corners_px, square.corner_covariance_px2, square.edge);
  if (!pose) return std::nullopt;
  double side_px = 0.0;
  for (int i = 0; i < 4; ++i) {
    side_px += 0.25 * Norm(square.corners_px[i] - square.corners_px[(i + 1) % 4]);
  }
  if (pose->best.reprojection_rms_px > std::max(kMinMisfit_px, kMaxMisfit * side_px)) {
    return std::nullopt;
  }
  candidate.pose_square = square;
  return candidate;
}

}  // namespace pleinair::tracker
