#include <array>
#include <chrono>
#include <opencv2/aruco.hpp>

#include "accuracy/detector.h"
#include "tracker/april_tag_detector.h"
#include "tracker/pose/planar_pose.h"

namespace pleinair::accuracy {
namespace {

struct Family {
  const char* name;
  cv::aruco::PREDEFINED_DICTIONARY_NAME dictionary;
  int bits;   ///< Bits of the code along a side; a black ring surrounds them.
  int turns;  ///< Quarter turns clockwise from its first corner to the marker's top-left one.
};
constexpr std::array<Family, 4> kFamilies{{
    {"4X4_50", cv::aruco::DICT_4X4_50, 4, 0},
    {"tag36h11", cv::aruco::DICT_APRILTAG_36h11, 6, 2},
    {"tag25h9", cv::aruco::DICT_APRILTAG_25h9, 5, 2},
    {"tag16h5", cv::aruco::DICT_APRILTAG_16h5, 4, 2},
}};
constexpr int kQuiet = 1;  // Modules of quiet zone on each side.

class ArucoPeer final : public Detector {
 public:
  ArucoPeer(const CameraModel& camera, const Family& family, Metres edge)
      : camera_(camera),
        edge_(edge),
        family_(family),
        dictionary_(cv::aruco::getPredefinedDictionary(family.dictionary)),
        parameters_(cv::aruco::DetectorParameters::create()) {
    cv::setNumThreads(1);  // Like the other detectors.
    parameters_->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
  }

  PatternByNumber Patterns() const override {
    if (family_.turns != 0) {
      return [name = family_.name](int number) { return tracker::AprilTagPattern(name, number); };
    }
    return [dictionary = dictionary_,
            edge = family_.bits + 2](int number) -> std::shared_ptr<const tracker::MarkerPattern> {
      cv::Mat drawn;
      cv::aruco::drawMarker(dictionary, number, edge, drawn);
      auto pattern = std::make_shared<tracker::MarkerPattern>();
      pattern->modules = edge + 2 * kQuiet;
      pattern->edge_modules = edge;
      pattern->white.assign(static_cast<std::size_t>(pattern->modules) * pattern->modules, 1);
      for (int row = 0; row < edge; ++row) {
        for (int column = 0; column < edge; ++column) {
          pattern->white[(row + kQuiet) * pattern->modules + column + kQuiet] =
              drawn.at<std::uint8_t>(row, column) > 127;
        }
      }
      return pattern;
    };
  }

  Result<void> Start(bool /*film*/) override { return {}; }

  Result<Detections> Detect(ImageView<const std::uint8_t> grey) override {
    const cv::Mat image(grey.height(), grey.width(), CV_8U, const_cast<std::uint8_t*>(grey.data()),
                        grey.stride());
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> numbers;
    Detections seen;
    const auto start = std::chrono::steady_clock::now();
    cv::aruco::detectMarkers(image, dictionary_, corners, numbers, parameters_);
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    seen.stages_ms.emplace_back("detect", taken.count());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      Detected detected{.number = numbers[i]};
      for (int k = 0; k < 4; ++k) {
        const cv::Point2f corner = corners[i][(k + family_.turns) % 4];
        detected.corners_px[k] = {corner.x, corner.y};
      }
      detected.pose = tracker::EstimatePlanarPose(camera_, detected.corners_px,
                                                  tracker::IsotropicCornerCovariance(1.0), edge_);
      seen.markers.push_back(std::move(detected));
    }
    return seen;
  }

 private:
  const CameraModel camera_;
  const Metres edge_;
  const Family family_;
  cv::Ptr<cv::aruco::Dictionary> dictionary_;
  cv::Ptr<cv::aruco::DetectorParameters> parameters_;
};

}  // namespace

std::unique_ptr<Detector> MakeArucoPeer(const CameraModel& camera, std::string_view family,
                                        Metres edge) {
  for (const Family& known : kFamilies) {
    if (known.name == family) return std::make_unique<ArucoPeer>(camera, known, edge);
  }
  return nullptr;
}

}  // namespace pleinair::accuracy
