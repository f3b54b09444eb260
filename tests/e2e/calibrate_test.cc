#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "devices/calibration.h"
#include "run_program.h"
#include "tests/tracker/board_rendering.h"

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

/// Pictures 0.png… of the board.
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

  // A film that rests at each view for three frames: each is picked once.
  cv::VideoWriter film((folder / "film.avi").string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                       10.0, pictures[0].size(), false);
  ASSERT_TRUE(film.isOpened());
  film.set(cv::VIDEOWRITER_PROP_QUALITY, 98);
  for (const cv::Mat& picture : pictures) {
    for (int i = 0; i < 3; ++i) film << picture;
  }
  film.release();
  const RunResult from_film =
      RunPleinair({"calibrate", "--charuco", "8x6", folder / "film.avi", "--json"});
  ASSERT_EQ(from_film.exit_code, 0) << from_film.err;
  const auto of_film = nlohmann::json::parse(from_film.out);
  EXPECT_EQ(of_film["views"].size(), 12U);
  EXPECT_EQ(of_film["pictures"], 36);
  EXPECT_NEAR(of_film["fx"].get<double>() / TrueCamera().fx, 1.0, 0.003);
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
      {{"--charuco", "8x6", few}, "the board is seen in 3 of 3 pictures, and fewer than 4"},
      {{"--chessboard", "9x6", few}, "no chessboard with 9x6 inner corners is seen in any of 3"},
      {{"--charuco", "8x6", folder / "empty"}, "holds no picture"},
      {{"--charuco", "8x6", folder / "sizes"}, "has 100x200 pixels"},
      {{"--charuco", "8x6", folder / "bad"}, "0.png"},
      {{"--charuco", "8x6", folder / "none"}, "is not there"},
      {{"--charuco", "8", few}, "is not COLUMNSxROWS"},
      {{"--charuco", "8x6", "--dictionary", "9x9_50", few}, "known are 4x4_50"},
      {{"--charuco", "30x30", "--dictionary", "4x4_50", few}, "has 50 markers"},
      {{"--board", folder / "board.json", few}, "cannot be used"},
      {{"--board", folder / "few/0.png", few}, "is no description of a board"},
      {{few}, "which board is in the pictures is not said"},
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
