#include "app/accuracy/own_detector.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "accuracy/random.h"
#include "session/marker_refiner.h"
#include "session/scene_marker.h"
#include "tracker/pose/planar_pose.h"

namespace pleinair::app {
namespace {

using Clock = std::chrono::steady_clock;

double Milliseconds(Clock::duration taken) {
  return std::chrono::duration<double, std::milli>(taken).count();
}

class OwnDetector final : public accuracy::Detector {
 public:
  OwnDetector(const CameraModel& camera, const OwnDetectorOptions& options)
      : camera_(camera), options_(options) {}

  accuracy::PatternByNumber Patterns() const override {
    return [family = options_.tracker.families.at(0)](int number) {
      return session::PatternOf({family, number});
    };
  }

  Result<void> Start(bool film) override {
    if (film) {
      PLEINAIR_ASSIGN_OR_RETURN(film_, Create(true));
    } else if (!still_) {
      PLEINAIR_ASSIGN_OR_RETURN(still_, Create(false));
    }
    tracker_ = film ? film_.get() : still_.get();
    refiner_ = std::make_unique<session::MarkerRefiner>(camera_, options_.tracker.marker_size_m);
    return {};
  }

  Result<Detections> Detect(ImageView<const std::uint8_t> grey) override {
    Detections seen;
    const auto start = Clock::now();
    PLEINAIR_ASSIGN_OR_RETURN(std::vector<tracker::MarkerObservation> observations,
                              tracker_->Track(grey));
    const auto detected = Clock::now();
    seen.stages_ms.emplace_back("detect", Milliseconds(detected - start));
    if (options_.measure_prints) {
      observations = refiner_->Measure(grey, std::move(observations));
      seen.stages_ms.emplace_back("measure", Milliseconds(Clock::now() - detected));
    }
    seen.lost = static_cast<int>(tracker_->Lost().size());
    for (tracker::MarkerObservation& observation : observations) {
      if (!observation.detection.id) continue;
      if (options_.spoil_corners_px > 0.0) Spoil(&observation);
      seen.markers.push_back({.number = *observation.detection.id,
                              .corners_px = observation.detection.corners_px,
                              .pose = observation.pose,
                              .pose_has_covariance = true,
                              .visible_fraction = observation.detection.visible_fraction,
                              .path = tracker::TrajectoryName(observation.detection.path),
                              .family = observation.detection.family});
    }
    return seen;
  }

 private:
  Result<std::unique_ptr<tracker::Tracker>> Create(bool film) const {
    tracker::TrackerOptions options = options_.tracker;
    options.consecutive_frames = film;
    return tracker::Tracker::Create(camera_, options);
  }

  void Spoil(tracker::MarkerObservation* observation) const {
    auto& corners = observation->detection.corners_px;
    // The direction depends only on the image, so that the order of frames does not matter.
    accuracy::RandomStream random(
        0, fmt::format("spoil/{}/{}/{}", *observation->detection.id, corners[0].x, corners[0].y));
    for (Vec2& corner : corners) {
      const double direction = random.Uniform(0, 2 * M_PI);
      corner = corner + Vec2{std::cos(direction), std::sin(direction)} * options_.spoil_corners_px;
    }
    const auto pose = tracker::EstimatePlanarPose(
        camera_, corners, tracker::IsotropicCornerCovariance(options_.spoil_corners_px),
        Metres(options_.tracker.marker_size_m));
    if (pose) observation->pose = *pose;
  }

  const CameraModel camera_;
  const OwnDetectorOptions options_;
  std::unique_ptr<tracker::Tracker> still_, film_;
  tracker::Tracker* tracker_ = nullptr;
  std::unique_ptr<session::MarkerRefiner> refiner_;
};

}  // namespace

std::unique_ptr<accuracy::Detector> MakeOwnDetector(const CameraModel& camera,
                                                    const OwnDetectorOptions& options) {
  return std::make_unique<OwnDetector>(camera, options);
}

}  // namespace pleinair::app
