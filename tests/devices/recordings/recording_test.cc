#include "devices/recordings/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "tests/temporary_folder.h"

namespace pleinair::devices {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// A recording of four frames in the format of the courtyard's.
constexpr const char* kRecordingJson = R"({"format": 1, "frames": "frames", "frame_count": 4,
  "timestamps_s": [0, 0.1, 0.2, 0.35],
  "calibration": {"image_width": 640, "image_height": 480, "model": "opencv-radtan",
    "fx": 605, "fy": 605, "cx": 319.5, "cy": 239.5, "distortion_k1_k2_p1_p2_k3": [0, 0, 0, 0, 0]},
  "latitude_deg": 50.0875, "longitude_deg": 14.4213, "utc": "2025-09-14T11:05:00Z",
  "marker": {"size_m": 0.48, "heading_deg": 342}})";

class SmallRecording : public ::testing::Test {
 protected:
  SmallRecording() {
    folder_.Write("recording.json", kRecordingJson);
    for (int i = 0; i < 4; ++i) {
      const std::string name = "000" + std::to_string(i) + ".jpg";
      folder_.Copy(tests::Courtyard() / "frames" / name, "frames/" + name);
    }
  }

  void WriteModels() const {
    for (const char* name : {"phantom.obj", "object.obj"}) {
      folder_.Copy(tests::Courtyard() / name, name);
    }
  }

  std::string Message() const { return tests::MessageOf(OpenRecording(folder_.path())); }

  const tests::TemporaryFolder folder_;
};

int CountFrames(FrameSource& source) {
  int count = 0;
  while (true) {
    const Result<std::optional<Frame>> frame = source.Next();
    if (!frame) {
      ADD_FAILURE() << frame.error().Message();
      return count;
    }
    if (!*frame) return count;
    EXPECT_EQ((*frame)->index, count);
    ++count;
  }
}

TEST_F(SmallRecording, GoesOnAtTheFrameThatItIsToldToSkipTo) {
  const Result<Recording> recording = OpenRecording(folder_.path());
  ASSERT_TRUE(recording) << recording.error().Message();
  FrameSource& frames = *recording->frames;
  std::filesystem::remove(folder_ / "frames/0001.jpg");  // This file is not opened.
  ASSERT_EQ((*frames.Next())->index, 0);
  frames.SkipTo(2);
  const Result<std::optional<Frame>> third = frames.Next();
  ASSERT_TRUE(third) << third.error().Message();
  EXPECT_EQ((*third)->index, 2);
  EXPECT_EQ((*third)->timestamp_ns, 200'000'000);
  frames.SkipTo(1);
  EXPECT_EQ((*frames.Next())->index, 3) << "never back";
  frames.SkipTo(100);
  EXPECT_FALSE(frames.Next()->has_value());
}

TEST(Recording, BundledCourtyardOpensWithAllItKnows) {
  const Result<Recording> recording = OpenRecording(tests::Courtyard());
  ASSERT_TRUE(recording) << recording.error().Message();
  EXPECT_EQ(recording->frame_rate_hz, 15);
  EXPECT_EQ(recording->camera.fx, 605);
  EXPECT_EQ(recording->camera.cy, 239.5);
  EXPECT_FALSE(recording->camera.HasDistortion());
  ASSERT_TRUE(recording->scene);
  EXPECT_EQ(recording->scene->phantoms.size(), 1U);
  EXPECT_EQ(recording->scene->objects.size(), 1U);
  EXPECT_EQ(recording->frames->FrameCount(), 90);
  EXPECT_EQ(CountFrames(*recording->frames), 90);
}

TEST(Recording, SameFramesComeOutTwice) {
  const Result<Recording> a = OpenRecording(tests::Courtyard());
  const Result<Recording> b = OpenRecording(tests::Courtyard());
  ASSERT_TRUE(a && b);
  for (int i = 0; i < 5; ++i) {
    const Frame one = a->frames->Next()->value();
    const Frame other = b->frames->Next()->value();
    EXPECT_TRUE(std::equal(one.rgb.data(), one.rgb.data() + one.rgb.size(), other.rgb.data()));
    EXPECT_TRUE(std::equal(one.grey.data(), one.grey.data() + one.grey.size(), other.grey.data()));
  }
}

// The ground truth of scene.json is for tests and scores only: replacing it has no effect.
TEST(Recording, GroundTruthIsNeverLookedAt) {
  const tests::TemporaryFolder folder;
  std::string scene = tests::Content(tests::Courtyard() / "scene.json");
  for (const char* block :
       {"\"directions_in_marker_frame\"", "\"sun\"", "\"light_truth_display_units\"",
        "\"exposure\"", "\"key_frames\"", "\"poses_marker_to_camera\"", "\"dust_density\"",
        "\"radiance_scale\"", "\"to_sun\"", "\"gain_rgb\""}) {
    scene = tests::Replaced(scene, block, "\"gone\"");
  }
  folder.Write("scene.json", scene);
  folder.Write("recording.json",
               tests::Replaced(tests::Content(tests::Courtyard() / "recording.json"), "\"truth\"",
                               "\"gone\""));
  for (const char* name : {"phantom.obj", "object.obj", "frames/0000.jpg"}) {
    folder.Copy(tests::Courtyard() / name, name);
  }
  for (int i = 1; i < 90; ++i) {
    const std::string number = std::to_string(i);
    std::filesystem::create_symlink(folder / "frames/0000.jpg",
                                    folder / ("frames/" + number + ".jpg"));
  }
  const Result<Recording> recording = OpenRecording(folder.path());
  ASSERT_TRUE(recording) << recording.error().Message();
  const Result<Recording> whole = OpenRecording(tests::Courtyard());
  ASSERT_TRUE(whole);
  EXPECT_EQ(recording->scene->place_time.start, whole->scene->place_time.start);
  EXPECT_EQ(recording->scene->place_time.latitude_deg, whole->scene->place_time.latitude_deg);
  EXPECT_EQ(recording->scene->marker.heading, whole->scene->marker.heading);
  EXPECT_EQ(recording->scene->cloudiness, whole->scene->cloudiness);
  EXPECT_FALSE(recording->scene->turbidity);
  EXPECT_FALSE(recording->scene->camera.exposure_scale);
}

TEST_F(SmallRecording, RecordingJsonAloneIsEnough) {
  Result<Recording> recording = OpenRecording(folder_.path());
  ASSERT_TRUE(recording) << recording.error().Message();
  ASSERT_TRUE(recording->scene);
  EXPECT_TRUE(recording->scene->objects.empty());
  EXPECT_DOUBLE_EQ(recording->frame_rate_hz, 3 / 0.35);
  for (const std::int64_t stamp_ns : {0LL, 100'000'000LL, 200'000'000LL, 350'000'000LL}) {
    EXPECT_EQ(recording->frames->Next()->value().timestamp_ns, stamp_ns);
  }
  WriteModels();
  recording = OpenRecording(folder_.path());
  ASSERT_TRUE(recording) << recording.error().Message();
  ASSERT_EQ(recording->scene->objects.size(), 1U);
  EXPECT_EQ(recording->scene->objects[0].file, folder_ / "object.obj");
  EXPECT_EQ(recording->scene->phantoms.size(), 1U);
}

TEST_F(SmallRecording, SceneJsonAloneIsEnough) {
  std::filesystem::remove(folder_ / "recording.json");
  folder_.Write("scene.json", tests::Replaced(tests::Content(tests::Courtyard() / "scene.json"),
                                              "\"frame_count\": 90", "\"frame_count\": 4"));
  WriteModels();
  Result<Recording> recording = OpenRecording(folder_.path());
  ASSERT_TRUE(recording) << recording.error().Message();
  EXPECT_EQ(recording->frame_rate_hz, 15);
  EXPECT_EQ(recording->scene->objects.size(), 1U);
  EXPECT_EQ(CountFrames(*recording->frames), 4);
}

TEST_F(SmallRecording, WithoutASceneOfItsOwnItStillOpens) {
  folder_.Write("recording.json",
                tests::Replaced(tests::Replaced(kRecordingJson, "\"latitude_deg\"", "\"a\""),
                                "\"longitude_deg\"", "\"b\""));
  EXPECT_THAT(Message(), HasSubstr("where the recording was made"));
  std::string bare = kRecordingJson;
  bare = bare.substr(0, bare.find(",\n  \"latitude_deg\"")) + "}";
  folder_.Write("recording.json", bare);
  const Result<Recording> recording = OpenRecording(folder_.path());
  ASSERT_TRUE(recording) << recording.error().Message();
  EXPECT_FALSE(recording->scene);
}

TEST_F(SmallRecording, HandWrittenSceneLeansOnTheRecordingForPlaceAndMarker) {
  WriteModels();
  folder_.Write("scene.toml", "cloudiness = \"overcast\"\n[[object]]\nfile = \"object.obj\"\n");
  const Result<Recording> recording = OpenRecording(folder_.path());
  ASSERT_TRUE(recording) << recording.error().Message();
  EXPECT_EQ(recording->scene->cloudiness, scene::Cloudiness::kOvercast);
  EXPECT_EQ(recording->scene->marker.size_m, 0.48);
  EXPECT_EQ(recording->scene->objects.size(), 1U);
  ASSERT_EQ(recording->scene->phantoms.size(), 1U);
  EXPECT_TRUE(recording->scene->phantoms[0].surface) << "assumed level ground";

  const std::filesystem::path other = folder_.Write("elsewhere/empty.toml", "turbidity = 4\n");
  const Result<Recording> overridden =
      OpenRecording(folder_.path(), {.calibration = {}, .scene = other});
  ASSERT_TRUE(overridden) << overridden.error().Message();
  EXPECT_EQ(overridden->scene->turbidity, 4);
  EXPECT_TRUE(overridden->scene->objects.empty());
  EXPECT_EQ(overridden->scene->place_time.latitude_deg, 50.0875);
}

TEST_F(SmallRecording, CalibrationOfTheCommandOverridesItsOwn) {
  const std::filesystem::path lens = folder_.Write(
      "lens.yaml", "image_size: [640, 480]\nK: [700, 0, 300, 0, 710, 200, 0, 0, 1]\nD: []\n");
  const Result<Recording> recording =
      OpenRecording(folder_.path(), {.calibration = lens, .scene = {}});
  ASSERT_TRUE(recording) << recording.error().Message();
  EXPECT_EQ(recording->camera.fy, 710);
}

TEST_F(SmallRecording, NumbersNeedNoPaddingAndMayStartAnywhere) {
  for (int i = 0; i < 4; ++i) {
    std::filesystem::rename(folder_ / ("frames/000" + std::to_string(i) + ".jpg"),
                            folder_ / ("frames/shot_" + std::to_string(i + 8) + ".JPG"));
  }
  folder_.Write("frames/notes.txt", "not a frame");
  const Result<Recording> recording = OpenRecording(folder_.path());
  ASSERT_TRUE(recording) << recording.error().Message();
  EXPECT_EQ(CountFrames(*recording->frames), 4);
}

TEST_F(SmallRecording, FrameMissingFromTheNumberingIsNamed) {
  std::filesystem::remove(folder_ / "frames/0002.jpg");
  EXPECT_THAT(Message(), AllOf(HasSubstr("frames"), HasSubstr("lacks frame 2")));
}

TEST_F(SmallRecording, FewerFramesThanPromisedIsAnError) {
  std::filesystem::remove(folder_ / "frames/0003.jpg");
  EXPECT_THAT(Message(), HasSubstr("has 3 frames, but the recording has 4"));
  std::filesystem::remove_all(folder_ / "frames");
  EXPECT_THAT(Message(), HasSubstr("are not there"));
  std::filesystem::create_directories(folder_ / "frames");
  EXPECT_THAT(Message(), HasSubstr("no numbered PNG or JPEG"));
}

TEST_F(SmallRecording, NumberTwiceIsAnError) {
  folder_.Copy(folder_ / "frames/0001.jpg", "frames/1.jpg");
  EXPECT_THAT(Message(), AllOf(HasSubstr("frame 1 twice"), HasSubstr("0001.jpg and 1.jpg")));
}

TEST_F(SmallRecording, FrameCutShortIsNamedBeforeTheFirstIsComposed) {
  const std::string whole = tests::Content(folder_ / "frames/0003.jpg");
  folder_.Write("frames/0003.jpg", whole.substr(0, whole.size() / 2));
  EXPECT_THAT(Message(), AllOf(HasSubstr("0003.jpg"), HasSubstr("cut short")));
  folder_.Write("frames/0003.jpg", "");
  EXPECT_THAT(Message(), AllOf(HasSubstr("0003.jpg"), HasSubstr("is empty")));
}

TEST_F(SmallRecording, FrameOfAnotherSizeIsNamed) {
  cv::imwrite((folder_ / "frames/0001.jpg").string(), cv::Mat(240, 320, CV_8UC3, cv::Scalar()));
  EXPECT_THAT(Message(), AllOf(HasSubstr("0001.jpg"), HasSubstr("320x240"), HasSubstr("640x480")));
}

TEST_F(SmallRecording, FrameThatVanishesWhileReadingEndsTheSource) {
  const Result<Recording> recording = OpenRecording(folder_.path());
  ASSERT_TRUE(recording);
  std::filesystem::remove(folder_ / "frames/0000.jpg");
  EXPECT_THAT(tests::MessageOf(recording->frames->Next()),
              HasSubstr("0000.jpg: there is no such file"));
  EXPECT_FALSE(recording->frames->Next()->has_value());
}

TEST_F(SmallRecording, ASceneThatIsNoFileIsNotPassedOver) {
  std::filesystem::remove(folder_ / "scene.toml");
  std::filesystem::create_directory(folder_ / "scene.toml");
  EXPECT_THAT(Message(), HasSubstr("scene.toml: is a folder, not a file"));
  std::filesystem::remove(folder_ / "scene.toml");
  std::filesystem::create_symlink("gone.toml", folder_ / "scene.toml");
  EXPECT_THAT(Message(), HasSubstr("scene.toml: is a link to nothing"));
  std::filesystem::remove(folder_ / "scene.toml");
  std::filesystem::create_symlink("scene.toml", folder_ / "scene.toml");
  EXPECT_THAT(Message(), HasSubstr("scene.toml: is a link to itself"));
}

TEST_F(SmallRecording, SenselessDescriptionsAreRefused) {
  const auto with = [this](const char* from, const char* to) {
    folder_.Write("recording.json", tests::Replaced(kRecordingJson, from, to));
    return Message();
  };
  EXPECT_THAT(with("0.2, 0.35", "0.35"), HasSubstr("3 entries for 4 frames"));
  EXPECT_THAT(with("0.2, 0.35", "0.35, 0.2"), HasSubstr("does not ascend at frame 3"));
  EXPECT_THAT(with("0.2, 0.35", "0.2, 0.200000001"),
              HasSubstr("has frame 3 9.99999999e-10 s after"));
  EXPECT_THAT(with("0.2, 0.35", "0.2, 1e8"), HasSubstr("outside 1e-5 s to a year"));
  EXPECT_THAT(with("0.2, 0.35", "0.2, 1e10"), HasSubstr("is 1e+10 at frame 3"));
  EXPECT_THAT(with("\"format\": 1", "\"frame_rate_hz\": 1e-308"), HasSubstr("is 1e-308, outside"));
  EXPECT_THAT(with("[0, 0.1, 0.2, 0.35]", "[]"), HasSubstr("does not say the frame rate"));
  EXPECT_THAT(with("\"frame_count\": 4", "\"frame_count\": 0"), HasSubstr("frame_count"));
  EXPECT_THAT(with("\"format\": 1", "\"frame_rate_hz\": 0"),
              HasSubstr("is 0, outside 1e-7 to 1e5"));
  EXPECT_THAT(with("605", "0"), HasSubstr("= 0, outside 6.4 to 64000"));
  EXPECT_THAT(with("\"size_m\": 0.48", "\"size_m\": 0"),
              HasSubstr("recording.json: marker.size_m is 0, outside"));
  EXPECT_THAT(with("11:05:00Z", "11:05:00"), HasSubstr("neither Z nor an offset"));
  EXPECT_THAT(with("342}}", "342}"), HasSubstr("cut short"));
}

TEST_F(SmallRecording, SceneThatNamesAMissingModelIsRefused) {
  folder_.Write("scene.json", tests::Content(tests::Courtyard() / "scene.json"));
  EXPECT_THAT(Message(),
              AllOf(HasSubstr("scene.json"), HasSubstr("phantom.obj"), HasSubstr("is not there")));
}

TEST(Recording, WhatIsNoRecordingSaysWhatOneIs) {
  const tests::TemporaryFolder folder;
  EXPECT_THAT(tests::MessageOf(OpenRecording(folder.path())),
              HasSubstr("neither recording.json nor scene.json nor mav0/cam0/data.csv"));
  EXPECT_THAT(tests::MessageOf(OpenRecording(folder / "none")), HasSubstr("no such recording"));
  EXPECT_THAT(tests::MessageOf(OpenRecording(folder.Write("film.mp4", "x"))),
              HasSubstr("give --calibration"));
  EXPECT_THAT(tests::MessageOf(OpenRecording(folder.Write("log.mcap", "x"))),
              HasSubstr("log.mcap: is an MCAP file, a format that can be written but not read"));
}

}  // namespace
}  // namespace pleinair::devices
