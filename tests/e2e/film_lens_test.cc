#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "devices/calibration/calibration.h"
#include "tests/devices/films/made_film.h"
#include "tests/e2e/run_program.h"
#include "tests/tracker/marker_rendering.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Images of an S-G marker from several sides, as somebody who walks around it takes them.
std::vector<cv::Mat> MarkerPictures(const CameraModel& camera, int count) {
  std::vector<cv::Mat> pictures;
  for (int i = 0; i < count; ++i) {
    const double t = 2.0 * std::numbers::pi * i / count;
    tracker::RenderedMarker marker;
    marker.pattern = std::make_shared<const tracker::MarkerPattern>(tracker::SgMarkerPattern(17));
    marker.size = Metres(0.2);
    const Vec2 center{camera.width * (0.5 + 0.25 * std::sin(t)),
                      camera.height * (0.5 + 0.2 * std::sin(2.0 * t + 1.0))};
    marker.camera_from_marker = tracker::PoseAtPixel(
        camera, center, (0.27 + 0.05 * std::sin(3.0 * t)) * camera.width, marker.size,
        Radians(0.8 + 0.2 * std::sin(2.0 * t)), Radians(3.0 * std::sin(t + 0.5)), Radians(0.0));
    tracker::RenderingOptions options;
    options.blur_px = 0.5;
    options.noise_codes = 1.5;
    options.seed = static_cast<std::uint32_t>(i);
    GreyImage grey = tracker::RenderMarkers(camera, {marker}, options);
    pictures.push_back(cv::Mat(grey.height(), grey.width(), CV_8UC1, grey.data()).clone());
  }
  return pictures;
}

/// A film that shows each picture for two frames, with the tag of a lens.
void WriteStillFilm(const fs::path& file, const std::vector<cv::Mat>& pictures,
                    const std::string& focal_length_35mm) {
  tests::MadeFilm film;
  film.width = pictures[0].cols;
  film.height = pictures[0].rows;
  film.ticks_per_s = 10;
  film.tags = {{"com.apple.quicktime.camera.focal_length.35mm_equivalent", focal_length_35mm}};
  film.muxer_options = {{"movflags", "use_metadata_tags"}};
  for (int i = 0; i < 2 * static_cast<int>(pictures.size()); ++i) film.ticks.push_back(i);
  tests::WriteFilm(file, film, [&](AVFrame* frame, int i) {
    tests::FillPlanes(frame, 0, 128, 128);
    cv::Mat luma(frame->height, frame->width, CV_8UC1, frame->data[0],
                 static_cast<std::size_t>(frame->linesize[0]));
    pictures[static_cast<std::size_t>(i) / 2].convertTo(luma, CV_8U, 219.0 / 255.0, 16.0);
  });
}

TEST(FilmLens, FindsTheLensFromAFilmOfTheMarkerAlone) {
  CameraModel camera;
  camera.width = 320;
  camera.height = 240;
  camera.fx = camera.fy = 300.0;
  camera.cx = 161.0;
  camera.cy = 118.5;
  camera.distortion = {-0.1, 0.03};
  const TemporaryFolder folder;
  WriteStillFilm(folder / "walk.mov", MarkerPictures(camera, 18), "26");
  const RunResult run = RunPleinair(
      {"calibrate", folder / "walk.mov", "--marker", "sg", "-o", folder / "camera.json", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_GE(json["views"].get<int>(), 15);
  EXPECT_EQ(json["images"], 36);
  EXPECT_NEAR(json["tag_focal_length_35mm"].get<double>(), 26.0, 1e-6);
  const auto& deviations = json["standard_deviations"];
  EXPECT_LT(deviations["fx"].get<double>(), 0.005 * camera.fx);
  EXPECT_LT(std::fabs(json["fx"].get<double>() - camera.fx), 2.0 * deviations["fx"].get<double>());
  EXPECT_NEAR(json["fx"].get<double>() / camera.fx, 1.0, 0.003);
  EXPECT_NEAR(json["distortion"]["k1"].get<double>(), -0.1, 3.0 * deviations["k1"].get<double>());
  const auto written = devices::ReadCalibration(folder / "camera.json");
  ASSERT_TRUE(written) << written.error().Message();
  EXPECT_EQ(written->fx, json["fx"].get<double>());
  EXPECT_EQ(written->fy, written->fx);
  EXPECT_EQ(written->distortion[0], json["distortion"]["k1"].get<double>());

  // Replay does so by itself, and says it.
  WriteFile(folder / "scene.toml",
            "time = \"2025-09-14T11:05:00Z\"\n[place]\nlatitude_deg = 50\nlongitude_deg = 14\n"
            "[marker]\nfamily = \"sg\"\nid = 17\nsize_mm = 200\nheading_deg = 0\n");
  const RunResult replay = RunPleinair({"replay", folder / "walk.mov", "--scene",
                                        folder / "scene.toml", "--no-video", "-o", folder / "out"});
  ASSERT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_EQ(devices::ReadCalibration(folder / "out/camera_from_film.json")->fx, written->fx);
  EXPECT_THAT(ReadFile(folder / "out/report.json"),
              AllOf(HasSubstr("The film itself gives it"), HasSubstr("focal length"),
                    HasSubstr("\"camera_from_film.json\"")));
}

TEST(FilmLens, RefusesAFilmThatDoesNotDetermineTheLens) {
  CameraModel camera;
  camera.width = 320;
  camera.height = 240;
  camera.fx = camera.fy = 300.0;
  camera.cx = 159.5;
  camera.cy = 119.5;
  // The marker straight before the camera, from several distances.
  std::vector<cv::Mat> pictures;
  for (int i = 0; i < 10; ++i) {
    tracker::RenderedMarker marker;
    marker.pattern = std::make_shared<const tracker::MarkerPattern>(tracker::SgMarkerPattern(17));
    marker.size = Metres(0.2);
    marker.camera_from_marker =
        tracker::PoseAtPixel(camera, {159.5, 119.5}, 60.0 + 9.0 * i, marker.size, Radians(0.02),
                             Radians(i), Radians(0.0));
    GreyImage grey = tracker::RenderMarkers(camera, {marker}, {});
    pictures.push_back(cv::Mat(grey.height(), grey.width(), CV_8UC1, grey.data()).clone());
  }
  const TemporaryFolder folder;
  WriteStillFilm(folder / "walk.mov", pictures, "26");
  const auto before = Listing(folder.path());
  const auto refused = [&](std::vector<std::string> arguments, const std::string& reason) {
    arguments.insert(arguments.begin(), {"calibrate", "-o", folder / "camera.json"});
    const RunResult run = RunPleinair(arguments);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_THAT(run.err, AllOf(StartsWith("pleinair: "), HasSubstr(reason)));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  };
  const std::string film = folder / "walk.mov";
  refused({film, "--marker", "sg"}, "obliquely");
  refused({film, "--marker", "tag36h11"}, "shows no marker in 20 images");
  refused({film, "--marker", "square"}, "unknown marker family");
  refused({film, "--marker", "sg", "--charuco", "8x6"}, "not for --marker");
  refused({film, "--marker", "sg", "--report", folder / "lens.html"}, "not for --marker");
  EXPECT_EQ(Listing(folder.path()), before);
}

}  // namespace
}  // namespace pleinair::e2e
