#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagStandard41h12.h>
}

#include "accuracy/detector.h"
#include "tracker/april_tag_detector.h"
#include "tracker/pose/planar_pose.h"

namespace pleinair::accuracy {
namespace {

struct Family {
  const char* name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};
constexpr std::array<Family, 4> kFamilies{{
    {"tag36h11", tag36h11_create, tag36h11_destroy},
    {"tag25h9", tag25h9_create, tag25h9_destroy},
    {"tag16h5", tag16h5_create, tag16h5_destroy},
    {"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy},
}};

struct FreeDetector {
  void operator()(apriltag_detector_t* detector) const { apriltag_detector_destroy(detector); }
};
struct FreeImage {
  void operator()(image_u8_t* image) const { image_u8_destroy(image); }
};

class AprilTagPeer final : public Detector {
 public:
  AprilTagPeer(const CameraModel& camera, const Family& family, Metres edge)
      : camera_(camera),
        edge_(edge),
        name_(family.name),
        family_(family.create(), family.destroy),
        detector_(apriltag_detector_create()),
        image_(image_u8_create(camera.width, camera.height)) {
    apriltag_detector_add_family(detector_.get(), family_.get());
    detector_->nthreads = 1;
  }

  PatternByNumber Patterns() const override {
    return [name = name_](int number) { return tracker::AprilTagPattern(name, number); };
  }

  Result<void> Start(bool /*film*/) override { return {}; }

  Result<Detections> Detect(ImageView<const std::uint8_t> grey) override {
    for (int y = 0; y < grey.height(); ++y) {
      std::memcpy(image_->buf + y * image_->stride, grey.row(y), grey.width());
    }
    Detections seen;
    const auto start = std::chrono::steady_clock::now();
    zarray_t* found = apriltag_detector_detect(detector_.get(), image_.get());
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    seen.stages_ms.emplace_back("detect", taken.count());
    for (int i = 0; i < zarray_size(found); ++i) {
      apriltag_detection_t* tag = nullptr;
      zarray_get(found, i, &tag);
      Detected detected{.number = tag->id};
      // Counter-clockwise from the bottom-left. In the library's pixels integers are corners.
      for (int k = 0; k < 4; ++k) {
        detected.corners_px[k] = {tag->p[3 - k][0] - 0.5, tag->p[3 - k][1] - 0.5};
      }
      detected.pose = tracker::EstimatePlanarPose(camera_, detected.corners_px,
                                                  tracker::IsotropicCornerCovariance(1.0), edge_);
      seen.markers.push_back(std::move(detected));
    }
    apriltag_detections_destroy(found);
    return seen;
  }

 private:
  const CameraModel camera_;
  const Metres edge_;
  const char* const name_;
  std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> family_;
  std::unique_ptr<apriltag_detector_t, FreeDetector> detector_;
  std::unique_ptr<image_u8_t, FreeImage> image_;
};

}  // namespace

std::unique_ptr<Detector> MakeAprilTagPeer(const CameraModel& camera, std::string_view family,
                                           Metres edge) {
  for (const Family& known : kFamilies) {
    if (known.name == family) return std::make_unique<AprilTagPeer>(camera, known, edge);
  }
  return nullptr;
}

}  // namespace pleinair::accuracy
