#include "devices/calibration/response_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scene/scene_description.h"
#include "tests/temporary_folder.h"

namespace pleinair::devices {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ResponseFile : public ::testing::Test {
 protected:
  Result<CameraResponse> Read(const std::string& text) {
    return ReadCameraResponse(folder_.Write("response.json", text));
  }
  std::string Refusal(const std::string& text) {
    const auto response = Read(text);
    return response ? "taken" : response.error().Message();
  }
  tests::TemporaryFolder folder_;
};

TEST_F(ResponseFile, GivesAPowerOfTheCode) {
  const auto response = Read(R"({"response": "gamma", "gamma": 2.2})");
  ASSERT_TRUE(response) << response.error().Message();
  EXPECT_FALSE(response->IsSrgb());
  for (const int code : {0, 20, 100, 200, 255}) {
    EXPECT_NEAR(response->Linear(1)[code], std::pow(code / 255.0, 2.2), 1e-5) << code;
    EXPECT_EQ(response->Encoded8(response->Linear(1)[code], 1), code);
  }
}

TEST_F(ResponseFile, GivesACurveOfItsOwnToEachChannel) {
  const auto response = Read(R"({"response": "samples", "encoded": [0, 0.25, 0.5, 0.75, 1],
      "red": [0, 0.0625, 0.25, 0.5625, 1], "light": [0, 0.25, 0.5, 0.75, 1]})");
  ASSERT_TRUE(response) << response.error().Message();
  EXPECT_NEAR(response->Linear(0)[128], std::pow(128 / 255.0, 2), 0.004);
  EXPECT_NEAR(response->Linear(2)[128], 128 / 255.0, 1e-4);
  for (int code = 1; code < 256; ++code) {
    for (int c = 0; c < 3; ++c) {
      ASSERT_GT(response->Linear(c)[code], response->Linear(c)[code - 1]);
      ASSERT_EQ(response->Encoded8(response->Linear(c)[code], c), code);
    }
  }
}

TEST_F(ResponseFile, IsReadAsItWasWritten) {
  // A curve with black below a raised floor, where light hardly rises, and one of each channel.
  std::vector<double> encoded;
  std::array<std::vector<double>, 3> light;
  for (int i = 0; i <= 64; ++i) {
    const double at = i / 64.0, lifted = std::max(0.0, (at - 0.06) / 0.94);
    encoded.push_back(at);
    for (int c = 0; c < 3; ++c) {
      light[c].push_back(i == 64 ? 1.0 : 2e-6 * i + (1 - 2e-4) * std::pow(lifted, 1.8 + 0.2 * c));
    }
  }
  const auto response = CameraResponse::FromSamples(encoded, light);
  ASSERT_TRUE(response);
  const auto read = Read(CameraResponseText(*response));
  ASSERT_TRUE(read) << read.error().Message();
  for (int c = 0; c < 3; ++c) {
    for (int code = 0; code < 256; ++code) {
      EXPECT_NEAR(read->Linear(c)[code], response->Linear(c)[code], 1e-3) << code;
    }
  }
  const auto srgb = Read(CameraResponseText({}));
  ASSERT_TRUE(srgb);
  EXPECT_TRUE(srgb->IsSrgb());
}

TEST_F(ResponseFile, IsSrgbWhereItSaysSo) {
  const auto response = Read(R"({"response": "srgb"})");
  ASSERT_TRUE(response);
  EXPECT_TRUE(response->IsSrgb());
}

TEST_F(ResponseFile, RefusesWhatIsNoResponse) {
  EXPECT_THAT(Refusal("{}"), AllOf(HasSubstr("response.json"), HasSubstr("missing")));
  EXPECT_THAT(Refusal(R"({"response": "log"})"), HasSubstr("samples"));
  EXPECT_THAT(Refusal(R"({"response": "gamma"})"), HasSubstr("gamma"));
  EXPECT_THAT(Refusal(R"({"response": "gamma", "gamma": 90})"), HasSubstr("0.2 to 5"));
  EXPECT_THAT(Refusal(R"({"response": "samples", "encoded": [0, 1]})"), HasSubstr("red"));
  EXPECT_THAT(Refusal(R"({"response": "samples", "encoded": [0, 1], "light": [0, 0.5, 1]})"),
              HasSubstr("3 values for 2"));
  EXPECT_THAT(Refusal(R"({"response": "samples", "encoded": [0, 0.5, 1], "light": [0, 0.6, 0.5]})"),
              HasSubstr("rise"));
  EXPECT_THAT(Refusal(R"({"response": "samples", "encoded": [0, 0.5, 1], "light": [0, 0.7, 0.6]})"),
              HasSubstr("rise"));
  EXPECT_THAT(Refusal(R"({"response": "gamma", "gama": 2.2})"), HasSubstr("\"gama\" is not known"));
  EXPECT_THAT(Refusal(R"({"response": "gamma", "gamma": 2.2, "light": [0, 1]})"),
              HasSubstr("\"light\" is not known"));
  EXPECT_THAT(Refusal(R"({"response": "srgb", "gamma": 2.2})"), HasSubstr("known are response"));
  EXPECT_FALSE(ReadCameraResponse("nowhere/response.json"));
}

TEST_F(ResponseFile, IsNamedByTheSceneRelativeToIt) {
  folder_.Write("lens/curve.json", R"({"response": "gamma", "gamma": 1.8})");
  const std::string scene =
      "camera_response = \"lens/curve.json\"\ntime = 2025-06-01T12:00:00Z\n"
      "[place]\nlatitude_deg = 50\nlongitude_deg = 14\n"
      "[marker]\nsize_mm = 100\nheading_deg = 0\n";
  const auto read = scene::ReadSceneDescription(folder_.Write("scene.toml", scene));
  ASSERT_TRUE(read) << read.error().Message();
  EXPECT_TRUE(ReadCameraResponse(read->camera.response));
  std::string missing = scene;
  missing.replace(missing.find("curve"), 5, "other");
  const auto refused = scene::ReadSceneDescription(folder_.Write("scene.toml", missing));
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().Message(), HasSubstr("other.json"));
}

}  // namespace
}  // namespace pleinair::devices
