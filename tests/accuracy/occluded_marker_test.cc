// Tests that the virtual object stays in place while a hand passes over the marker of the bundled
// recording. The hand is painted into the frames here.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "tests/accuracy/hand_occluder.h"
#include "tests/accuracy/key_frame.h"
#include "tests/e2e/run_program.h"
#include "tests/e2e/tum_file.h"

namespace pleinair::accuracy {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kFrames = 90;
// Relative to the distance, for the camera's position and for every point of the virtual object.
constexpr double kMaxDisplacement = 0.005;
constexpr int kMaxGap = 3;

/// Share of a marker that the hand covers, 0…1.
struct Covered {
  double border = 0.0, content = 0.0;
};

class OccludedMarker : public testing::Test {
 protected:
  OccludedMarker() {
    const fs::path bundled = e2e::BundledRecording();
    recording_ = json::parse(e2e::ReadFile(bundled / "recording.json"));
    truth_ = e2e::ReadTum(bundled / "truth.tum");
    const json& lens = recording_["calibration"];
    camera_.width = lens["image_width"];
    camera_.height = lens["image_height"];
    camera_.fx = lens["fx"];
    camera_.fy = lens["fy"];
    camera_.cx = lens["cx"];
    camera_.cy = lens["cy"];
    half_m_ = recording_["marker"]["size_m"].get<double>() / 2;
  }

  Vec2 PixelOf(int frame, double x_m, double y_m) const {
    const auto camera_from_marker = truth_[frame].marker_from_camera.Inverse();
    return ProjectToPixel(camera_, camera_from_marker * Point<Marker>{{x_m, y_m, 0.0}});
  }

  /// A frame with the painted hand, and the hand's coverage of the image.
  cv::Mat Frame(int frame, cv::Mat* covered) const {
    const std::array<Vec2, 4> corners{
        PixelOf(frame, -half_m_, half_m_), PixelOf(frame, half_m_, half_m_),
        PixelOf(frame, half_m_, -half_m_), PixelOf(frame, -half_m_, -half_m_)};
    double side_px = 0.0;
    for (int i = 0; i < 4; ++i) side_px += Norm(corners[i] - corners[(i + 1) % 4]) / 4;
    cv::Mat picture = cv::imread(e2e::BundledRecording() / fmt::format("frames/{:04}.jpg", frame));
    *covered =
        PaintHand(PassingHand(frame / (kFrames - 1.0), PixelOf(frame, 0, 0), side_px), &picture);
    return picture;
  }

  /// Sampled at the centres of the marker's modules: 40 along each side, of which the code in the
  /// middle has 20.
  Covered CoveredOf(int frame, const cv::Mat& covered) const {
    constexpr int kModules = 40, kFirst = 10, kLast = 29;
    int border = 0, content = 0, border_covered = 0, content_covered = 0;
    for (int row = 0; row < kModules; ++row) {
      for (int column = 0; column < kModules; ++column) {
        const auto place = [&](int module) {
          return half_m_ * ((module + 0.5) / (0.5 * kModules) - 1);
        };
        const Vec2 at = PixelOf(frame, place(column), place(row));
        const bool hidden = covered.at<float>(static_cast<int>(std::lround(at.y)),
                                              static_cast<int>(std::lround(at.x))) > 0.5F;
        const bool code = column >= kFirst && column <= kLast && row >= kFirst && row <= kLast;
        (code ? content : border) += 1;
        if (hidden) (code ? content_covered : border_covered) += 1;
      }
    }
    return {static_cast<double>(border_covered) / border,
            static_cast<double>(content_covered) / content};
  }

  /// Writes some frames with the painted hand and a scene without ground truth. The JPEG quality is
  /// the recording's own.
  void MakeRecording(const fs::path& folder, int first, int last, bool with_object) {
    e2e::MakeShortRecording(folder, 1, with_object);
    json stamps = json::array();
    for (int frame = first; frame <= last; ++frame) {
      cv::Mat covered;
      const cv::Mat picture = Frame(frame, &covered);
      covered_.push_back(CoveredOf(frame, covered));
      hands_.push_back(covered);
      cv::imwrite(folder / fmt::format("frames/{:04}.jpg", frame - first), picture,
                  {cv::IMWRITE_JPEG_QUALITY, 95});
      stamps.push_back(recording_["timestamps_s"][frame]);
    }
    json description = recording_;
    description["frame_count"] = stamps.size();
    description["timestamps_s"] = stamps;
    description.erase("truth");
    e2e::WriteFile(folder / "recording.json", description.dump());
  }

  json recording_;
  std::vector<e2e::TumPose> truth_;
  CameraModel camera_;
  double half_m_ = 0.0;
  std::vector<Covered> covered_;  ///< One per written frame.
  std::vector<cv::Mat> hands_;
};

/// Sample points of the virtual object, in marker coordinates.
std::vector<Point<Marker>> ObjectPoints() {
  std::ifstream in(e2e::BundledRecording() / "object.obj");
  std::vector<Point<Marker>> points;
  int vertices = 0;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("v ") || vertices++ % 20 != 0) continue;
    std::istringstream fields(line.substr(2));
    Point<Marker> point;
    fields >> point.xyz.x >> point.xyz.y >> point.xyz.z;
    points.push_back(point);
  }
  return points;
}

/// Maximum displacement of an object point by the pose error, relative to its distance from the
/// camera.
double LargestDisplacement(const std::vector<Point<Marker>>& points, const e2e::TumPose& found,
                           const e2e::TumPose& truth) {
  const auto camera_from_marker = found.marker_from_camera.Inverse();
  const auto true_camera_from_marker = truth.marker_from_camera.Inverse();
  double largest = 0.0;
  for (const Point<Marker>& point : points) {
    const Vec3 right = (true_camera_from_marker * point).xyz;
    largest = std::max(largest, Norm((camera_from_marker * point).xyz - right) / Norm(right));
  }
  return largest;
}

TEST_F(OccludedMarker, KeepsTheVirtualObjectInPlace) {
  const e2e::TemporaryFolder folder;
  MakeRecording(folder / "site", 0, kFrames - 1, false);
  // Precondition of the test: the hand covers much of the marker for many frames.
  double border = 0.0, content = 0.0;
  for (const Covered& covered : covered_) {
    border = std::max(border, covered.border);
    content = std::max(content, covered.content);
  }
  const auto touched = std::count_if(covered_.begin(), covered_.end(),
                                     [](const Covered& c) { return c.border > 0.1; });
  EXPECT_GT(border, 0.45);
  EXPECT_GT(content, 0.6);
  EXPECT_GE(touched, 45);

  const e2e::RunResult run =
      e2e::RunPleinair({"replay", folder / "site", "-o", folder / "out", "--no-video"});
  ASSERT_EQ(run.exit_code, 0) << run.err;

  const auto found = e2e::ReadTum(folder / "out/poses/sg_17.tum");
  const std::vector<Point<Marker>> points = ObjectPoints();
  ASSERT_GT(points.size(), 50U);
  int gap = 0;
  std::vector<double> position, displacement, hidden_position, hidden_displacement;
  for (int frame = 0; frame < kFrames; ++frame) {
    const e2e::TumPose* pose = e2e::PoseAt(found, truth_[frame].time_s);
    gap = pose == nullptr ? gap + 1 : 0;
    EXPECT_LE(gap, kMaxGap) << "frame " << frame;
    if (pose == nullptr) continue;
    const bool hidden = covered_[frame].border > 0.1;
    position.push_back(e2e::ErrorOf(*pose, truth_[frame]).position_share);
    displacement.push_back(LargestDisplacement(points, *pose, truth_[frame]));
    if (hidden) {
      hidden_position.push_back(position.back());
      hidden_displacement.push_back(displacement.back());
    }
    EXPECT_LT(position.back(), kMaxDisplacement)
        << "frame " << frame << ", border covered " << covered_[frame].border;
    EXPECT_LT(displacement.back(), kMaxDisplacement)
        << "frame " << frame << ", border covered " << covered_[frame].border;
  }
  ASSERT_FALSE(hidden_position.empty());
  fmt::print(
      "\nHand over the marker: {} of {} frames found; {} with more than 10 % of the border "
      "covered,\nat most {:.0f} % of the border and {:.0f} % of the code\n"
      "% of the distance            median    95 %  largest\n",
      displacement.size(), kFrames, touched, 100 * border, 100 * content);
  for (const auto& [what, values] : {std::pair{"camera, while covered", &hidden_position},
                                     {"object, while covered", &hidden_displacement},
                                     {"object, all frames", &displacement}}) {
    fmt::print("{:26}{:9.3f}{:8.3f}{:9.3f}\n", what, 100 * e2e::Percentile(*values, 0.5),
               100 * e2e::Percentile(*values, 0.95), 100 * e2e::Percentile(*values, 1.0));
  }
  std::fflush(stdout);
}

// The exposure estimate also uses the marker, and a hand covers it in all of these frames.
TEST_F(OccludedMarker, LightsTheVirtualObjectAsWithoutTheHand) {
  constexpr int kFirst = 22, kKeyFrame = 36;
  const e2e::TemporaryFolder folder;
  MakeRecording(folder / "site", kFirst, kKeyFrame, true);
  EXPECT_GT(covered_.front().border, 0.1);
  EXPECT_GT(covered_.back().border, 0.3);
  const e2e::RunResult run =
      e2e::RunPleinair({"replay", folder / "site", "-o", folder / "out", "--no-video", "--frames"});
  ASSERT_EQ(run.exit_code, 0) << run.err;

  const cv::Mat picture =
      cv::imread(folder / fmt::format("out/frames/{:04}.png", kKeyFrame - kFirst));
  const KeyFrame key = ReadKeyFrame(kKeyFrame);
  ASSERT_EQ(picture.size(), key.truth.size());
  // The ground-truth image contains neither the hand nor its shadow.
  cv::Mat hand;
  cv::dilate(hands_.back() > 0, hand,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(61, 61)));
  const Score score = Compare(picture, key, hand);
  fmt::print("\nHand over the marker, frame {}: CIEDE2000 {:.2f} object / {:.2f} shadow\n",
             kKeyFrame, score.object, score.shadow);
  std::fflush(stdout);
  // The bounds of the composite without a hand (composite_accuracy_test.cc).
  EXPECT_LE(score.object, 2.0);
  EXPECT_LE(score.shadow, 2.6);
}

TEST_F(OccludedMarker, PutsTheHandBeforeTheVirtualObject) {
  constexpr int kFirst = 28, kLast = 30;
  const e2e::TemporaryFolder folder;
  MakeRecording(folder / "site", kFirst, kLast, true);
  // The object on the marker, behind the hand.
  e2e::WriteFile(folder / "site/scene.toml",
                 e2e::ReadFile(folder / "site/scene.toml") + "translation_m = [-0.68, -0.03, 0]\n");
  std::vector<cv::Mat> pictures;
  for (const bool hands : {false, true}) {
    const std::string out = folder / (hands ? "hands" : "plain");
    std::vector<std::string> command{"replay",     folder / "site", "-o",      out,
                                     "--no-video", "--frames",      "--light", "stated"};
    if (hands) command.emplace_back("--hands");
    const e2e::RunResult run = e2e::RunPleinair(command);
    ASSERT_EQ(run.exit_code, 0) << run.err;

    pictures.push_back(cv::imread(out + "/frames/0002.png"));
  }
  const cv::Mat frame = cv::imread(folder / "site/frames/0002.jpg");
  cv::Mat hand, beside;
  cv::erode(hands_.back() > 0.9F, hand, cv::Mat(), cv::Point(-1, -1), 2);
  cv::dilate(hands_.back() > 0.0F, beside, cv::Mat(), cv::Point(-1, -1), 6);
  int behind = 0, kept = 0, object = 0, same = 0;
  for (int y = 0; y < frame.rows; ++y) {
    for (int x = 0; x < frame.cols; ++x) {
      const auto differs = [&](const cv::Mat& picture) {
        return cv::norm(cv::Vec3i(frame.at<cv::Vec3b>(y, x)) -
                        cv::Vec3i(picture.at<cv::Vec3b>(y, x))) > 25;
      };
      if (!differs(pictures[0])) continue;
      if (hand.at<std::uint8_t>(y, x) != 0) {
        ++behind;
        kept += differs(pictures[1]) ? 0 : 1;
      } else if (beside.at<std::uint8_t>(y, x) == 0) {
        ++object;
        same += cv::norm(pictures[0].at<cv::Vec3b>(y, x), pictures[1].at<cv::Vec3b>(y, x)) < 1;
      }
    }
  }
  fmt::print("\nHand before the object: {} of {} pixels; object elsewhere kept: {} of {}\n", kept,
             behind, same, object);
  std::fflush(stdout);
  EXPECT_GT(behind, 1000);
  EXPECT_GT(kept, 0.7 * behind);
  EXPECT_GT(object, 1500);
  EXPECT_GT(same, 0.97 * object);
}

}  // namespace
}  // namespace pleinair::accuracy
