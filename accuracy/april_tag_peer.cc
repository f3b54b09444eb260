#include <algorithm>
#include <chrono>
#include <cstring>

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
}

#include "accuracy/detector.h"
#include "tracker/april_tag_detector.h"
#include "tracker/planar_pose.h"

namespace pleinair::accuracy {
namespace {

constexpr const char* kFamily = "tag36h11";

struct FreeDetector {
  void operator()(apriltag_detector_t* detector) const { apriltag_detector_destroy(detector); }
};
struct FreeFamily {
  void operator()(apriltag_family_t* family) const { tag36h11_destroy(family); }
};
struct FreePicture {
  void operator()(image_u8_t* picture) const { image_u8_destroy(picture); }
};

class AprilTagPeer final : public Detector {
 public:
  explicit AprilTagPeer(const CameraModel& camera)
      : camera_(camera),
        family_(tag36h11_create()),
        detector_(apriltag_detector_create()),
        picture_(image_u8_create(camera.width, camera.height)) {
    apriltag_detector_add_family(detector_.get(), family_.get());
    detector_->nthreads = 1;
  }

  PrintsByNumber Prints() const override {
    return [](int number) { return tracker::AprilTagPattern(kFamily, number); };
  }

  Result<void> Start(bool /*film*/) override { return {}; }

  Result<Seen> Detect(ImageView<const std::uint8_t> grey) override {
    for (int y = 0; y < grey.height(); ++y) {
      std::memcpy(picture_->buf + y * picture_->stride, grey.row(y), grey.width());
    }
    Seen seen;
    const auto start = std::chrono::steady_clock::now();
    zarray_t* found = apriltag_detector_detect(detector_.get(), picture_.get());
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    seen.stages_ms.emplace_back("detect", taken.count());
    for (int i = 0; i < zarray_size(found); ++i) {
      apriltag_detection_t* tag = nullptr;
      zarray_get(found, i, &tag);
      Detected detected{.number = tag->id};
      // Counter-clockwise from the bottom-left; the library's pixels have their corner at 0.
      for (int k = 0; k < 4; ++k) {
        detected.corners_px[k] = {tag->p[3 - k][0] - 0.5, tag->p[3 - k][1] - 0.5};
      }
      detected.pose = tracker::EstimatePlanarPose(
          camera_, detected.corners_px, tracker::IsotropicCornerCovariance(1.0), kMarkerEdge);
      seen.markers.push_back(std::move(detected));
    }
    apriltag_detections_destroy(found);
    return seen;
  }

 private:
  const CameraModel camera_;
  std::unique_ptr<apriltag_family_t, FreeFamily> family_;
  std::unique_ptr<apriltag_detector_t, FreeDetector> detector_;
  std::unique_ptr<image_u8_t, FreePicture> picture_;
};

}  // namespace

std::unique_ptr<Detector> MakeAprilTagPeer(const CameraModel& camera) {
  return std::make_unique<AprilTagPeer>(camera);
}

}  // namespace pleinair::accuracy
