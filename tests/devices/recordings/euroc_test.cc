#include "devices/recordings/euroc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devices/recordings/recording.h"
#include "tests/temporary_folder.h"

namespace pleinair::devices {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kTable =
    "#timestamp [ns],filename\r\n"
    "1403636579763555584,1403636579763555584.png\r\n"
    "1403636579813555456,1403636579813555456.png\r\n";

constexpr const char* kSensor =
    "sensor_type: camera\nrate_hz: 20\nresolution: [640, 480]\ncamera_model: pinhole\n"
    "intrinsics: [605, 605, 319.5, 239.5]\ndistortion_model: radial-tangential\n"
    "distortion_coefficients: [0, 0, 0, 0]\n";

std::string Refusal(std::string_view bytes) {
  return tests::MessageOf(ParseEurocTable(bytes, "data.csv"));
}

void WriteSequence(const tests::TemporaryFolder& folder, const std::string& camera) {
  folder.Write(camera + "data.csv", kTable);
  folder.Write(camera + "sensor.yaml", kSensor);
  for (const char* name : {"1403636579763555584.png", "1403636579813555456.png"}) {
    folder.Copy(tests::Courtyard() / "key" / "0036_background.png", camera + "data/" + name);
  }
}

TEST(EurocTable, ReadsStampsAndNamesWhateverTheLineEnds) {
  const Result<std::vector<EurocFrame>> frames = ParseEurocTable(kTable, "data.csv");
  ASSERT_TRUE(frames) << frames.error().Message();
  ASSERT_EQ(frames->size(), 2U);
  EXPECT_EQ((*frames)[1].timestamp_ns, 1403636579813555456);
  EXPECT_EQ((*frames)[1].file, "1403636579813555456.png");
  EXPECT_EQ(ParseEurocTable("1, a.png", "data.csv")->at(0).file, "a.png");
}

TEST(EurocTable, NamesTheLineThatIsWrong) {
  EXPECT_THAT(Refusal("# head\n1,a.png\n2\n"), HasSubstr("data.csv:3: is not a time stamp"));
  EXPECT_THAT(Refusal("1.5,a.png\n"), HasSubstr("data.csv:1"));
  EXPECT_THAT(Refusal("99999999999999999999,a.png\n"), HasSubstr("data.csv:1"));
  EXPECT_THAT(Refusal("2,a.png\n2,b.png\n"), HasSubstr("data.csv:2: is not later"));
  EXPECT_THAT(Refusal("# nothing\n"), HasSubstr("lists no frames"));
}

TEST(EurocTable, NamesThatLeaveTheFolderAreRefused) {
  for (const char* name : {"../a.png", "/etc/passwd", "..", "b\\a.png"}) {
    EXPECT_THAT(Refusal(std::string("1,") + name), HasSubstr("does not name a file")) << name;
  }
}

TEST(EurocRecording, OpensFromEveryLevelOfItsFolders) {
  const tests::TemporaryFolder folder;
  WriteSequence(folder, "mav0/cam0/");
  for (const char* level : {"", "mav0", "mav0/cam0"}) {
    Result<Recording> recording = OpenRecording(folder / level);
    ASSERT_TRUE(recording) << recording.error().Message();
    EXPECT_EQ(recording->camera.fx, 605);
    EXPECT_EQ(recording->frame_rate_hz, 20);
    EXPECT_FALSE(recording->scene);
    ASSERT_EQ(recording->frames->FrameCount(), 2);
    EXPECT_EQ(recording->frames->Next()->value().timestamp_ns, 0);
    const Result<std::optional<Frame>> second = recording->frames->Next();
    ASSERT_TRUE(second);
    EXPECT_EQ(second->value().index, 1);
    EXPECT_EQ(second->value().timestamp_ns, 49'999'872);
    EXPECT_EQ(second->value().device_timestamp_ns, 1403636579813555456);
    EXPECT_FALSE(recording->frames->Next()->has_value());
  }
}

TEST(EurocRecording, TakesASceneFromBesideItOrFromTheCommand) {
  const tests::TemporaryFolder folder;
  WriteSequence(folder, "cam0/");
  const std::filesystem::path scene =
      folder.Write("scene.toml",
                   "time = 2025-09-14T11:05:00Z\n[place]\nlatitude_deg = 50\nlongitude_deg = 14\n"
                   "[marker]\nsize_mm = 480\nheading_deg = 342\n");
  const Result<Recording> beside = OpenRecording(folder.path());
  ASSERT_TRUE(beside) << beside.error().Message();
  ASSERT_TRUE(beside->scene);
  EXPECT_DOUBLE_EQ(beside->scene->marker.size_m, 0.48);
  const Result<Recording> named =
      OpenRecording(folder / "cam0", {.calibration = {}, .scene = scene});
  ASSERT_TRUE(named) << named.error().Message();
  EXPECT_TRUE(named->scene);
}

TEST(EurocRecording, FrameThatIsMissingIsNamed) {
  const tests::TemporaryFolder folder;
  WriteSequence(folder, "mav0/cam0/");
  std::filesystem::remove(folder / "mav0/cam0/data/1403636579813555456.png");
  EXPECT_THAT(tests::MessageOf(OpenRecording(folder.path())),
              AllOf(HasSubstr("1403636579813555456.png"), HasSubstr("no such file")));
}

}  // namespace
}  // namespace pleinair::devices
