#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "tests/e2e/phone_film.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A red cube of 0.4 m.
void WriteCube(const fs::path& file) {
  WriteFile(file.parent_path() / "cube.mtl", "newmtl red\nKd 0.7 0.05 0.05\n");
  WriteFile(file,
            "mtllib cube.mtl\n"
            "v -0.2 -0.2 0\nv 0.2 -0.2 0\nv 0.2 0.2 0\nv -0.2 0.2 0\n"
            "v -0.2 -0.2 0.4\nv 0.2 -0.2 0.4\nv 0.2 0.2 0.4\nv -0.2 0.2 0.4\n"
            "usemtl red\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
}

/// The EXIF segment of a photograph that looks 100 degrees clockwise from magnetic north.
std::string DirectionSegment() {
  const std::string tiff(
      "II*\0\x08\0\0\0"
      "\x01\0\x25\x88\x04\0\x01\0\0\0\x1a\0\0\0\0\0\0\0"
      "\x02\0\x10\0\x02\0\x02\0\0\0M\0\0\0\x11\0\x05\0\x01\0\0\0\x38\0\0\0\0\0\0\0"
      "\x64\0\0\0\x01\0\0\0",
      64);
  const std::string content = std::string("Exif\0\0", 6) + tiff;
  return std::string("\xff\xe1\0", 3) + static_cast<char>(content.size() + 2) + content;
}

std::vector<std::string> Stated(const fs::path& film, const fs::path& project) {
  return {"new", film, "-o", project, "--yes", "--size-mm", "500", "--heading", "342"};
}

TEST(New, MakesAProjectFromAPhonesFilmThatReplayTakes) {
  const TemporaryFolder folder;
  WritePhoneFilm(folder / "walk.mov");
  WriteCube(folder / "cube.obj");
  std::vector<std::string> arguments = Stated(folder / "walk.mov", folder / "shoot/site");
  arguments.insert(arguments.end(), {"--model", folder / "cube.obj"});
  const RunResult made = RunPleinair(arguments);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.out,
              AllOf(HasSubstr("marker sg_17"), HasSubstr("from the tags of walk.mov"),
                    HasSubstr("size: 500 mm"), HasSubstr("heading: 342 degrees from true"),
                    HasSubstr("sky: clear (assumed")));
  EXPECT_THAT(Listing(folder / "shoot"),
              ElementsAre("site", "site/first.png", "site/recording.json", "site/scene.toml"));
  EXPECT_THAT(ReadFile(folder / "shoot/site/scene.toml"),
              AllOf(HasSubstr("time = \"2025-09-14T13:05:00+02:00\""), HasSubstr("../../cube.obj"),
                    HasSubstr("# up = \"y\""), HasSubstr("# unit = \"mm\"")));
  const cv::Mat first = cv::imread((folder / "shoot/site/first.png").string());
  ASSERT_EQ(first.size(), cv::Size(640, 480));
  int red = 0;
  for (int i = 0; i < first.rows * first.cols; ++i) {
    const auto& pixel = first.at<cv::Vec3b>(i / first.cols, i % first.cols);
    red += pixel[2] > 3 * pixel[1] && pixel[2] > 60 ? 1 : 0;
  }
  EXPECT_GT(red, 500);

  // The project moves together with what it names.
  fs::create_directory(folder / "elsewhere");
  for (const char* name : {"walk.mov", "cube.obj", "cube.mtl", "shoot"}) {
    fs::rename(folder / name, folder / "elsewhere" / name);
  }
  const RunResult replayed = RunPleinair(
      {"replay", folder / "elsewhere/shoot/site", "--frame", "2", "--json", "-o", folder / "out"});
  ASSERT_EQ(replayed.exit_code, 0) << replayed.err;
  EXPECT_EQ(nlohmann::json::parse(replayed.out)["frames_with_pose"], 1);

  // A second project replaces the first only where that is asked for.
  arguments[1] = folder / "elsewhere/walk.mov";
  arguments[3] = folder / "elsewhere/shoot/site";
  arguments.back() = folder / "elsewhere/cube.obj";
  ExpectRefused(RunPleinair(arguments), "is a project already");
  arguments.emplace_back("--force");
  arguments[8] = "340";
  const RunResult replaced = RunPleinair(arguments);
  EXPECT_EQ(replaced.exit_code, 0) << replaced.err;
  EXPECT_THAT(ReadFile(folder / "elsewhere/shoot/site/scene.toml"), HasSubstr("340"));
}

TEST(New, TakesTheHeadingFromTheCompassOfAPhotograph) {
  const TemporaryFolder folder;
  WritePhoneFilm(folder / "walk.mov");
  std::string jpeg = ReadFile(BundledRecording() / "frames/0001.jpg");
  jpeg.insert(2, DirectionSegment());
  WriteFile(folder / "still.jpg", jpeg);
  const RunResult made = RunPleinair({"new", folder / "walk.mov", folder / "still.jpg", "-o",
                                      folder / "site", "-y", "--size-mm", "500", "--json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto json = nlohmann::json::parse(made.out);
  EXPECT_EQ(json["heading_is_magnetic"], true);
  EXPECT_THAT(ReadFile(folder / "site/scene.toml"),
              AllOf(HasSubstr("heading_magnetic_deg = "), HasSubstr("still.jpg")));
}

TEST(New, ScalesACalibrationOfAnotherSize) {
  const TemporaryFolder folder;
  WritePhoneFilm(folder / "walk.mov");
  const auto make = [&](int height) {
    WriteFile(folder / "camera.json",
              R"({"image_width": 1280, "image_height": )" + std::to_string(height) +
                  R"(, "model": "opencv-radtan", "fx": 1210, "fy": 1210, "cx": 639.5,
                      "cy": 479.5, "distortion_k1_k2_p1_p2_k3": [0, 0, 0, 0, 0]})");
    std::vector<std::string> arguments = Stated(folder / "walk.mov", folder / "site");
    arguments.insert(arguments.end(), {"--calibration", folder / "camera.json", "--json"});
    return RunPleinair(arguments);
  };
  ExpectRefused(make(720), "another shape");
  const RunResult made = make(960);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(nlohmann::json::parse(made.out)["warnings"].dump(), HasSubstr("scaled to 640x480"));
  EXPECT_THAT(ReadFile(folder / "site/scene.toml"), HasSubstr("scaled to 640x480"));
  const auto recording = nlohmann::json::parse(ReadFile(folder / "site/recording.json"));
  EXPECT_EQ(recording["calibration"]["image_width"], 640);
  EXPECT_NEAR(recording["calibration"]["fx"].get<double>(), 605.0, 1e-9);
}

TEST(New, NamesTheTrajectoryWhoseLensCounts) {
  const TemporaryFolder folder;
  WritePhoneFilm(folder / "walk.mov");
  std::filesystem::create_directories(folder / "scan");
  const auto make = [&](int height) {
    WriteFile(folder / "scan/metadata", R"({"fps": 30, "w": 640, "h": )" + std::to_string(height) +
                                            R"(, "K": [605, 0, 0, 0, 605, 0, 319.5, 239.5, 1],
                      "poses": [[0, 0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0.1, 0, 0]]})");
    std::vector<std::string> arguments = Stated(folder / "walk.mov", folder / "site");
    arguments.insert(arguments.end(), {"--trajectory", (folder / "scan").string() + "/"});
    return RunPleinair(arguments);
  };
  const RunResult other = make(360);
  ExpectRefused(other, "that of the trajectory scan; name the film that belongs to it");
  const RunResult made = make(480);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(ReadFile(folder / "site/scene.toml"),
              HasSubstr("(in recording.json): the trajectory scan\n"));
}

TEST(New, APhotographAloneIsAProject) {
  const TemporaryFolder folder;
  const fs::path photo = folder / "100%.jpg";
  fs::copy_file(BundledRecording() / "frames/0001.jpg", photo);
  std::vector<std::string> arguments = Stated(photo, folder / "site");
  arguments.insert(arguments.end(),
                   {"--time", "2025-09-14T13:05:00[Europe/Prague]", "--at", "50.0875,14.4213"});
  const RunResult made = RunPleinair(arguments);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const RunResult replayed = RunPleinair({"replay", folder / "site", "-o", folder / "out"});
  ASSERT_EQ(replayed.exit_code, 0) << replayed.err;
  EXPECT_TRUE(fs::exists(folder / "out/frames/0000.png"));
}

TEST(New, InterruptedDuringTheSearchItSaysSoAndWritesNothing) {
  const TemporaryFolder folder;
  WritePhoneFilm(folder / "walk.mov");
  const std::string out = folder / "site";
  // After it has opened the film, or after a timeout.
  const RunResult run = RunCommandLine(
      {"sh", "-c",
       PleinairProgram() + " new '" + std::string(folder / "walk.mov") + "' -o '" + out +
           "' --yes --size-mm 500 --heading 342 & n=0; "
           "until ls -l /proc/$!/fd 2>/dev/null | grep -q walk.mov || [ $((n += 1)) -gt 5000 ]; "
           "do :; done; kill -INT $!; wait $!"});
  ExpectRefused(run, "interrupted", 1);
  EXPECT_FALSE(fs::exists(out));
}

TEST(New, RefusesWhatItCannotMakeAndWritesNothing) {
  const TemporaryFolder folder;
  const fs::path film = folder / "walk.mov";
  WritePhoneFilm(film);
  tests::MadeFilm grey;
  grey.ticks = tests::NtscTicks(3);
  tests::WriteFilm(folder / "grey.mov", grey,
                   [](AVFrame* frame, int) { tests::FillPlanes(frame, 128, 128, 128); });
  WriteFile(folder / "words.txt", "no folder");
  WriteFile(folder / "still.HEIC", "no JPEG");
  fs::create_directory(folder / "other");
  WriteFile(folder / "other/scene.toml", "ground = false\n");
  const std::vector<std::string> before = Listing(folder.path());
  const fs::path out = folder / "out/site";
  const auto refuse = [&](std::vector<std::string> arguments, std::vector<std::string> more,
                          const std::string& message) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    SCOPED_TRACE(message);
    ExpectRefused(RunPleinair(arguments), message);
    EXPECT_EQ(Listing(folder.path()), before);
  };
  refuse({"new", film, "-o", out}, {}, "--size-mm, --heading, --time, --at");
  // What is missing is said before the search for a marker.
  refuse({"new", folder / "grey.mov", "-o", out, "--yes"}, {}, "--size-mm, --heading");
  refuse({"new", film, "-o", out, "--yes"}, {}, "--size-mm, --heading");
  refuse(Stated(folder / "grey.mov", out),
         {"--time", "2025-09-14T13:05:00+02:00", "--at", "50.0875,14.4213"}, "shows no marker");
  refuse(Stated(film, out), {folder / "still.HEIC"}, "is a photograph, but no JPEG");
  refuse(Stated(film, out), {"--marker", "sg_3"}, "shows no marker sg_3");
  refuse(Stated(film, out), {"--model", folder / "none.glb"}, "none.glb");
  refuse(Stated(film, out), {"--model", folder / "words.txt"}, "words.txt");
  refuse(Stated(film, out), {"--time", "2025-09-14T13:05:00"}, "offset");
  refuse(Stated(film, folder / "words.txt/site"), {}, "words.txt: is a file");
  refuse(Stated(film, folder / "other"), {"--force"}, "did not write it");
  refuse(Stated(film, out), {folder / "grey.mov"}, "is a second film");
  refuse(Stated(folder / "words.txt", out), {}, "words.txt");
  refuse(Stated(folder / "none.mov", out), {}, "does not exist");
}

}  // namespace
}  // namespace pleinair::e2e
