#include <chrono>
#include <opencv2/aruco.hpp>

#include "accuracy/detector.h"
#include "tracker/planar_pose.h"

namespace pleinair::accuracy {
namespace {

constexpr int kBits = 4;   // Of the code, along a side,
constexpr int kEdge = 6;   // … with the black rim,
constexpr int kQuiet = 1;  // … and the white margin around that, on each side.

class ArucoPeer final : public Detector {
 public:
  explicit ArucoPeer(const CameraModel& camera)
      : camera_(camera),
        dictionary_(cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50)),
        parameters_(cv::aruco::DetectorParameters::create()) {
    static_assert(kEdge == kBits + 2);
    cv::setNumThreads(1);  // As the others.
    parameters_->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
  }

  PrintsByNumber Prints() const override {
    return [dictionary = dictionary_](int number) {
      cv::Mat drawn;
      cv::aruco::drawMarker(dictionary, number, kEdge, drawn);
      auto pattern = std::make_shared<tracker::PrintPattern>();
      pattern->modules = kEdge + 2 * kQuiet;
      pattern->edge_modules = kEdge;
      pattern->white.assign(static_cast<std::size_t>(pattern->modules) * pattern->modules, 1);
      for (int row = 0; row < kEdge; ++row) {
        for (int column = 0; column < kEdge; ++column) {
          pattern->white[(row + kQuiet) * pattern->modules + column + kQuiet] =
              drawn.at<std::uint8_t>(row, column) > 127;
        }
      }
      return pattern;
    };
  }

  Result<void> Start(bool /*film*/) override { return {}; }

  Result<Seen> Detect(ImageView<const std::uint8_t> grey) override {
    const cv::Mat picture(grey.height(), grey.width(), CV_8U,
                          const_cast<std::uint8_t*>(grey.data()), grey.stride());
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> numbers;
    Seen seen;
    const auto start = std::chrono::steady_clock::now();
    cv::aruco::detectMarkers(picture, dictionary_, corners, numbers, parameters_);
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    seen.stages_ms.emplace_back("detect", taken.count());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      Detected detected{.number = numbers[i]};
      for (int k = 0; k < 4; ++k) detected.corners_px[k] = {corners[i][k].x, corners[i][k].y};
      detected.pose = tracker::EstimatePlanarPose(
          camera_, detected.corners_px, tracker::IsotropicCornerCovariance(1.0), kMarkerEdge);
      seen.markers.push_back(std::move(detected));
    }
    return seen;
  }

 private:
  const CameraModel camera_;
  cv::Ptr<cv::aruco::Dictionary> dictionary_;
  cv::Ptr<cv::aruco::DetectorParameters> parameters_;
};

}  // namespace

std::unique_ptr<Detector> MakeArucoPeer(const CameraModel& camera) {
  return std::make_unique<ArucoPeer>(camera);
}

}  // namespace pleinair::accuracy
