#include "tracker/tracker.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "base/units.h"
#include "tracker/april_tag_detector.h"
#include "tracker/marker_detector.h"
#include "tracker/picture_target/picture_detector.h"
#include "tracker/pose/planar_pose.h"
#include "tracker/refinement/marker_alignment.h"
#include "tracker/surf_golay/sg_detector.h"

namespace pleinair::tracker {
namespace {

/// Standard deviation of AprilTag's corners, used if the marker's own pixels give none better. On
/// an sRGB grey image its edges lie a third of a pixel inside the black square
/// (tests/tracker/refinement/marker_alignment_test.cc).
constexpr double kRawCornerSigma_px = 0.4;

class DetectingTracker final : public Tracker {
 public:
  DetectingTracker(const CameraModel& camera, const TrackerOptions& options,
                   std::vector<std::unique_ptr<MarkerDetector>> detectors)
      : camera_(camera),
        marker_size_(options.marker_size_m),
        consecutive_frames_(options.consecutive_frames),
        detectors_(std::move(detectors)) {}

  Result<UnmeasuredMarkers> Find(ImageView<const std::uint8_t> grey) override {
    if (grey.width() != camera_.width || grey.height() != camera_.height) {
      return InputError("",
                        "the image is " + SizeText(grey.width(), grey.height()) +
                            " but its camera " + SizeText(camera_.width, camera_.height),
                        "use the calibration of this camera at this resolution");
    }
    if (grey.channels() != 1) {
      return InputError("", "the image has " + std::to_string(grey.channels()) + " channels",
                        "the tracker wants grey");
    }
    UnmeasuredMarkers found;
    for (const auto& detector : detectors_) {
      for (Candidate& candidate : detector->Detect(grey)) {
        found.candidates.push_back(std::move(candidate));
      }
    }
    return found;
  }

  void Align(ImageView<const std::uint8_t> grey, UnmeasuredMarkers* found) const override {
    found->alignments.clear();
    for (const Candidate& candidate : found->candidates) {
      found->alignments.push_back(
          candidate.corner_covariance_px2
              ? std::nullopt
              : AlignMarker(camera_, *candidate.pattern, grey, candidate.detection.corners_px));
    }
  }

  std::vector<MarkerObservation> Conclude(ImageView<const std::uint8_t> grey,
                                          UnmeasuredMarkers found) override {
    std::vector<MarkerObservation> observations;
    for (std::size_t i = 0; i < found.candidates.size(); ++i) {
      std::optional<MarkerObservation> observation =
          PoseOf(grey, std::move(found.candidates[i]), found.alignments.at(i));
      if (observation) observations.push_back(std::move(*observation));
    }
    std::stable_sort(observations.begin(), observations.end(),
                     [](const MarkerObservation& a, const MarkerObservation& b) {
                       const auto key = [](const MarkerObservation& s) {
                         const MarkerDetection& d = s.detection;
                         return std::make_tuple(std::cref(d.family), d.id, d.corners_px[0].x,
                                                d.corners_px[0].y);
                       };
                       return key(a) < key(b);
                     });
    if (consecutive_frames_) before_ = observations;
    return observations;
  }

  std::vector<LostMarker> Lost() const override {
    std::vector<LostMarker> lost;
    for (const auto& detector : detectors_) {
      for (LostMarker& marker : detector->Lost()) lost.push_back(std::move(marker));
    }
    return lost;
  }

  std::vector<std::string> Warnings() const override {
    std::vector<std::string> warnings;
    for (const auto& detector : detectors_) {
      for (std::string& warning : detector->Warnings()) warnings.push_back(std::move(warning));
    }
    return warnings;
  }

 private:
  static std::string SizeText(int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  }

  std::optional<MarkerObservation> PoseOf(ImageView<const std::uint8_t> grey, Candidate candidate,
                                          const std::optional<MarkerAlignment>& alignment) const {
    MarkerObservation observation{std::move(candidate.detection), {}};
    CornerCovariance covariance = IsotropicCornerCovariance(kRawCornerSigma_px);
    if (candidate.corner_covariance_px2) {
      covariance = *candidate.corner_covariance_px2;
    } else if (!alignment) {
      const std::array<bool, 4> observed = CornersSeen(grey, observation.detection.corners_px);
      const bool is_whole = observed[0] && observed[1] && observed[2] && observed[3];
      if (!is_whole) return std::nullopt;
    } else {
      observation.detection.corners_px = alignment->corners_px;
      observation.detection.visible_fraction = alignment->visible_fraction;
      covariance = alignment->corner_covariance_px2;
    }
    const MarkerObservation* before = Before(observation.detection);
    std::array<Vec2, 4> corners_px = observation.detection.corners_px;
    Metres size = marker_size_;
    if (candidate.pose_square) {
      corners_px = candidate.pose_square->corners_px;
      covariance = candidate.pose_square->corner_covariance_px2;
      size = candidate.pose_square->edge;
    }
    const std::optional<PoseEstimate> pose = EstimatePlanarPose(
        camera_, corners_px, covariance, size,
        before != nullptr ? &before->pose.best.camera_from_marker.rotation : nullptr);
    if (!pose) return std::nullopt;
    observation.pose = *pose;
    return observation;
  }

  /// The nearest observation of the same marker in the previous image; null if there is none.
  const MarkerObservation* Before(const MarkerDetection& detection) const {
    const MarkerObservation* nearest = nullptr;
    for (const MarkerObservation& observation : before_) {
      const MarkerDetection& other = observation.detection;
      if (other.family != detection.family || other.id != detection.id) continue;
      const auto distance = [&](const MarkerObservation& s) {
        return Norm(s.detection.corners_px[0] - detection.corners_px[0]);
      };
      if (nearest == nullptr || distance(observation) < distance(*nearest)) nearest = &observation;
    }
    return nearest;
  }

  const CameraModel camera_;
  const Metres marker_size_;
  const bool consecutive_frames_;
  const std::vector<std::unique_ptr<MarkerDetector>> detectors_;
  std::vector<MarkerObservation> before_;
};

}  // namespace

Result<std::vector<MarkerObservation>> Tracker::Track(ImageView<const std::uint8_t> grey) {
  PLEINAIR_ASSIGN_OR_RETURN(UnmeasuredMarkers found, Find(grey));
  Align(grey, &found);
  return Conclude(grey, std::move(found));
}

Result<std::unique_ptr<Tracker>> Tracker::Create(const CameraModel& camera,
                                                 const TrackerOptions& options) {
  if (!options.families.empty() &&
      (!(options.marker_size_m > 0.0) || !std::isfinite(options.marker_size_m))) {
    return InputError("", "the marker's size must be positive",
                      "give the edge of its outer black square");
  }
  if (!options.families.empty() &&
      (options.marker_size_m < kMinMarker_m || options.marker_size_m > kMaxMarker_m)) {
    return InputError("", "the marker would be smaller than 0.1 mm or larger than 1 km",
                      "give the edge of its outer black square in its unit");
  }
  const double bent = std::accumulate(camera.distortion.begin(), camera.distortion.end(), 0.0);
  if (camera.width <= 0 || camera.height <= 0 || !(camera.fx > 0.0) || !(camera.fy > 0.0) ||
      !std::isfinite(camera.fx + camera.fy + camera.cx + camera.cy + bent)) {
    return InputError("", "the camera has no usable size, focal length or distortion",
                      "calibrate it");
  }
  if (options.families.empty() && options.targets.empty()) {
    return InputError("", "no marker family to look for", "name one, for example tag36h11");
  }
  std::vector<std::unique_ptr<MarkerDetector>> detectors;
  std::vector<std::string> tag_families;
  for (const std::string& family : options.families) {
    if (family != "sg") tag_families.push_back(family);
  }
  if (tag_families.size() < options.families.size()) {
    PLEINAIR_ASSIGN_OR_RETURN(auto sg,
                              SgDetector::Create(camera, options.sg, options.consecutive_frames));
    detectors.push_back(std::move(sg));
  }
  if (!tag_families.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(auto april_tags, CreateAprilTagDetector(tag_families));
    detectors.push_back(std::move(april_tags));
  }
  if (!options.targets.empty()) {
    detectors.push_back(
        std::make_unique<PictureDetector>(camera, options.targets, options.consecutive_frames));
  }
  return std::unique_ptr<Tracker>(
      std::make_unique<DetectingTracker>(camera, options, std::move(detectors)));
}

}  // namespace pleinair::tracker
