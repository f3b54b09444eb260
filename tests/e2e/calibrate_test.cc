#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/srgb.h"
#include "devices/calibration/calibration.h"
#include "tests/devices/films/made_film.h"
#include "tests/e2e/run_program.h"
#include "tests/tracker/calibration/board_rendering.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using tracker::BoardKind;
using tracker::CalibrationBoard;

const CalibrationBoard kBoard{BoardKind::kCharuco, 8, 6, 0.03, 0.0, 0, "4x4_50"};

CameraModel TrueCamera() {
  CameraModel camera;
  camera.width = 400;
  camera.height = 300;
  camera.fx = 380.0;
  camera.fy = 382.0;
  camera.cx = 203.0;
  camera.cy = 147.0;
  camera.distortion = {-0.1, 0.03, 0.0005, -0.0003};
  return camera;
}

/// Images 0.png… of the board.
std::vector<cv::Mat> WriteViews(const fs::path& folder, std::size_t count) {
  fs::create_directories(folder);
  const auto poses = tracker::BoardPoses(TrueCamera(), 0.24, 40.0);
  std::vector<cv::Mat> pictures;
  for (std::size_t i = 0; i < count; ++i) {
    tracker::RenderingOptions options;
    options.blur_px = 0.5;
    options.noise_codes = 1.5;
    options.seed = static_cast<std::uint32_t>(i);
    GreyImage grey = RenderBoard(TrueCamera(), kBoard, poses[i], options);
    pictures.push_back(cv::Mat(grey.height(), grey.width(), CV_8UC1, grey.data()).clone());
    cv::imwrite((folder / (std::to_string(i) + ".png")).string(), pictures.back());
  }
  return pictures;
}

TEST(Calibrate, WritesEveryFormAndAPageFromPicturesAndFromAFilm) {
  const TemporaryFolder folder;
  const auto pictures = WriteViews(folder / "views", 12);
  const RunResult run = RunPleinair({"calibrate",
                                     "--charuco",
                                     "8x6",
                                     folder / "views",
                                     "-o",
                                     folder / "own.json",
                                     "--opencv",
                                     folder / "opencv.yaml",
                                     "--opencv-json",
                                     folder / "opencv.json",
                                     "--ros",
                                     folder / "ros.yaml",
                                     "--kalibr",
                                     folder / "kalibr.yaml",
                                     "--euroc",
                                     folder / "sensor.yaml",
                                     "--report",
                                     folder / "lens.html",
                                     "--coverage",
                                     folder / "coverage.png",
                                     "--model",
                                     "radtan4",
                                     "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["views"].size(), 12U);
  EXPECT_EQ(json["board"], "ChArUco board of 8x6 squares (4x4_50)");
  EXPECT_LT(json["rms_px"], 0.1);
  EXPECT_EQ(json["validation"]["focal_px"].size(), 5U);
  EXPECT_EQ(json["regions"].size(), 24U);
  for (const char* name :
       {"own.json", "opencv.yaml", "opencv.json", "ros.yaml", "kalibr.yaml", "sensor.yaml"}) {
    const auto camera = devices::ReadCalibration(folder / name);
    ASSERT_TRUE(camera) << camera.error().Message();
    EXPECT_EQ(camera->fx, json["fx"].get<double>()) << name;
    EXPECT_EQ(camera->distortion[1], json["distortion"]["k2"].get<double>()) << name;
    EXPECT_NEAR(camera->fx / TrueCamera().fx, 1.0, 0.002);
    EXPECT_NEAR(camera->fy / TrueCamera().fy, 1.0, 0.002);
  }
  const std::string page = ReadFile(folder / "lens.html");
  EXPECT_THAT(page,
              AllOf(HasSubstr("Lens of "), HasSubstr("12 views cover"), HasSubstr("</html>")));
  const cv::Mat coverage = cv::imread((folder / "coverage.png").string());
  EXPECT_EQ(coverage.size(), cv::Size(1200, 900));

  // A video that shows each view for three frames: each view is used once.
  tests::MadeFilm film;
  film.width = pictures[0].cols;
  film.height = pictures[0].rows;
  film.ticks_per_s = 10;
  for (int i = 0; i < 3 * static_cast<int>(pictures.size()); ++i) film.ticks.push_back(i);
  tests::WriteFilm(folder / "film.mp4", film, [&](AVFrame* frame, int i) {
    tests::FillPlanes(frame, 0, 128, 128);
    const cv::Mat& picture = pictures[static_cast<std::size_t>(i) / 3];
    cv::Mat luma(frame->height, frame->width, CV_8UC1, frame->data[0], frame->linesize[0]);
    picture.convertTo(luma, CV_8U, 219.0 / 255.0, 16.0);
  });
  const RunResult from_film =
      RunPleinair({"calibrate", "--charuco", "8x6", folder / "film.mp4", "--json"});
  ASSERT_EQ(from_film.exit_code, 0) << from_film.err;
  const auto of_film = nlohmann::json::parse(from_film.out);
  EXPECT_EQ(of_film["views"].size(), 12U);
  EXPECT_EQ(of_film["pictures"], 36);
  EXPECT_NEAR(of_film["fx"].get<double>() / TrueCamera().fx, 1.0, 0.003);
}

/// A sheet written by `pleinair board`, rendered at 12 px/mm, in linear light at half that
/// resolution.
cv::Mat ReadSheet(const fs::path& file) {
  cv::Mat sheet = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  EXPECT_FALSE(sheet.empty());
  cv::Mat light(1, 256, CV_32F), linear;
  for (int i = 0; i < 256; ++i) light.at<float>(i) = LinearFromSrgb8()[i];
  cv::LUT(sheet, light, linear);
  cv::resize(linear, linear, {}, 0.5, 0.5, cv::INTER_AREA);
  return linear;
}

/// Photographs sheets through one lens: 3 × 3 samples per pixel and half a pixel of blur, in linear
/// light.
class SheetCamera {
 public:
  explicit SheetCamera(const CameraModel& camera) : size_(camera.width, camera.height) {
    for (int row = 0; row < size_.height * kSamples; ++row) {
      for (int column = 0; column < size_.width * kSamples; ++column) {
        const Vec2 ray =
            UndistortPixel(camera, {(column + 0.5) / kSamples - 0.5, (row + 0.5) / kSamples - 0.5});
        rays_.push_back({ray.x, ray.y, 1.0});
      }
    }
  }

  /// `middle_mm`: centre of the board on its page.
  cv::Mat Take(const cv::Mat& sheet, Vec2 middle_mm,
               const Transform<Camera, Marker>& camera_from_board) const {
    constexpr float kPixelsPerMm = 6.0F;
    cv::Mat_<cv::Vec2f> at(size_.height * kSamples, size_.width * kSamples);
    const Transform<Marker, Camera> back = camera_from_board.Inverse();
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const Vec3 along = back.rotation * rays_[i];
      const Vec3 on_board = back.translation_m + along * (-back.translation_m.z / along.z);
      at(static_cast<int>(i)) = {
          static_cast<float>(on_board.x * 1e3 + middle_mm.x) * kPixelsPerMm - 0.5F,
          static_cast<float>(middle_mm.y - on_board.y * 1e3) * kPixelsPerMm - 0.5F};
    }
    cv::Mat seen, picture;
    cv::remap(sheet, seen, at, cv::Mat(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar(0.3));
    cv::GaussianBlur(seen, seen, {}, 0.5 * kSamples);
    cv::resize(seen, picture, size_, 0, 0, cv::INTER_AREA);
    cv::Mat encoded(size_, CV_8U);
    for (int i = 0; i < size_.area(); ++i) {
      encoded.data[i] = Srgb8FromLinear(picture.ptr<float>()[i]);
    }
    return encoded;
  }

 private:
  static constexpr int kSamples = 3;
  cv::Size size_;
  std::vector<Vec3> rays_;
};

TEST(Calibrate, FindsTheLensFromPicturesOfTheBoardsThatBoardPrints) {
  struct Case {
    std::vector<std::string> board;
    double width_mm, height_mm;  // Extent of the squares.
    std::string words;
  };
  const Case cases[] = {
      {{"--chessboard", "9x6", "--square-mm", "20"}, 200, 140, "chessboard with 9x6 inner corners"},
      {{"--charuco", "8x6", "--dictionary", "5x5_100", "--square-mm", "20"},
       160,
       120,
       "ChArUco board of 8x6 squares (5x5_100)"}};
  // Chessboards are found completely or not at all: their squares must not be too small.
  CameraModel camera = TrueCamera();
  camera.width = 640;
  camera.height = 480;
  camera.fx *= 1.6;
  camera.fy *= 1.6;
  camera.cx = 324.0;
  camera.cy = 235.0;
  const SheetCamera photographer(camera);
  for (const Case& each : cases) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{"board", "--page", "A3", "-o", folder / "board.png"};
    arguments.insert(arguments.end(), each.board.begin(), each.board.end());
    const RunResult printed = RunPleinair(arguments);
    ASSERT_EQ(printed.exit_code, 0) << printed.err;
    const cv::Mat sheet = ReadSheet(folder / "board.png");
    ASSERT_EQ(sheet.size(), cv::Size(297 * 6, 420 * 6));
    // At 10 mm from the page's upper edge half a square of white begins.
    const Vec2 middle_mm{
        std::floor(0.5 * (297.0 - each.width_mm - 20.0)) + 10.0 + 0.5 * each.width_mm,
        20.0 + 0.5 * each.height_mm};
    fs::create_directories(folder / "views");
    const auto poses = tracker::BoardPoses(camera, each.width_mm * 1e-3, 40.0);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      cv::imwrite((folder / ("views/" + std::to_string(10 + i) + ".png")),
                  photographer.Take(sheet, middle_mm, poses[i]));
    }
    const RunResult run =
        RunPleinair({"calibrate", "--board", folder / "board.json", folder / "views", "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["board"], each.words);
    EXPECT_GE(json["views"].size(), 8U);
    EXPECT_NEAR(json["fx"].get<double>() / camera.fx, 1.0, 0.002);
    EXPECT_NEAR(json["fy"].get<double>() / camera.fy, 1.0, 0.002);
    EXPECT_LT(json["rms_px"].get<double>(), 0.1);
  }
}

TEST(Calibrate, RefusesInOneLineWithTheReasonAndWritesNothing) {
  const TemporaryFolder folder;
  WriteViews(folder / "few", 3);
  fs::create_directories(folder / "empty");
  fs::create_directories(folder / "sizes");
  fs::copy(folder / "few/0.png", folder / "sizes/0.png");
  cv::imwrite((folder / "sizes/1.png").string(), cv::Mat(200, 100, CV_8UC1, cv::Scalar(90)));
  fs::create_directories(folder / "bad");
  WriteFile(folder / "bad/0.png", "no picture");
  WriteFile(folder / "board.json", R"({"family": "charuco", "columns": 1e9})");
  struct Case {
    std::vector<std::string> arguments;
    std::string reason;
  };
  const std::string few = folder / "few";
  const Case cases[] = {
      {{"--charuco", "8x6", few}, "the board is seen in 3 of 3 images, and fewer than 4"},
      {{"--chessboard", "9x6", few}, "no chessboard with 9x6 inner corners is seen in any of 3"},
      {{"--charuco", "8x6", folder / "empty"}, "holds no image"},
      {{"--charuco", "8x6", folder / "sizes"}, "has 100x200 pixels"},
      {{"--charuco", "8x6", folder / "bad"}, "0.png"},
      {{"--charuco", "8x6", folder / "none"}, "is not there"},
      {{"--charuco", "8", few}, "is not COLUMNSxROWS"},
      {{"--charuco", "8x6", "--dictionary", "9x9_50", few}, "known are 4x4_50"},
      {{"--charuco", "30x30", "--dictionary", "4x4_50", few}, "has 50 markers"},
      {{"--board", folder / "board.json", few}, "cannot be used"},
      {{"--board", folder / "few/0.png", few}, "is not text"},
      {{few}, "the board in the images is not given"},
      {{"--charuco", "8x6", "--chessboard", "9x6", few}, "more than one board"},
      {{"--charuco", "8x6", "v4l2:/dev/none", few}, "can only be calibrated alone"},
      {{"--charuco", "8x6", "v4l2:/dev/none"}, "/dev/none"}};
  const auto before = Listing(folder.path());
  for (const Case& each : cases) {
    std::vector<std::string> arguments{"calibrate", "-o", folder / "camera.json"};
    arguments.insert(arguments.end(), each.arguments.begin(), each.arguments.end());
    const RunResult run = RunPleinair(arguments);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_THAT(run.err, AllOf(StartsWith("pleinair: "), HasSubstr(each.reason)));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_THAT(run.out, IsEmpty());
  }
  EXPECT_EQ(Listing(folder.path()), before);
}

}  // namespace
}  // namespace pleinair::e2e
