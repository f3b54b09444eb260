// Which exposure counts.
#include "session/motion/frame_exposure.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/error_message.h"

namespace pleinair::session {
namespace {

scene::SceneDescription SceneWith(std::vector<double> stated_s, std::vector<double> recorded_s) {
  scene::SceneDescription scene;
  if (!stated_s.empty()) scene.camera.lens.emplace().exposure_s = std::move(stated_s);
  if (!recorded_s.empty()) scene.camera.recorded_lens.emplace().exposure_s = std::move(recorded_s);
  return scene;
}

FrameExposure::Exposure Of(const scene::SceneDescription& scene, const MotionBlurOptions& options,
                           std::int64_t frame = 0, std::optional<double> own_s = {}) {
  const auto exposure = FrameExposure::Create(scene, options, true);
  EXPECT_TRUE(exposure);
  return exposure->Of(frame, own_s);
}

MotionBlurOptions InMode(LensFactMode mode) {
  MotionBlurOptions options;
  options.mode = mode;
  return options;
}

MotionBlurOptions WithExposure(double exposure_s) {
  MotionBlurOptions options;
  options.exposure_s = exposure_s;
  return options;
}

TEST(FrameExposure, ComesFromOptionsSceneRecordingAndFramesInThisOrder) {
  const scene::SceneDescription all = SceneWith({0.01}, {0.02, 0.03});
  EXPECT_EQ(Of(all, WithExposure(0.005)).seconds, 0.005);
  EXPECT_EQ(Of(all, {}).seconds, 0.01);
  EXPECT_EQ(Of(all, {}).source, LensFactSource::kStated);
  const scene::SceneDescription recorded = SceneWith({}, {0.02, 0.03});
  EXPECT_EQ(Of(recorded, {}, 1, 0.04).seconds, 0.03);
  EXPECT_EQ(Of(recorded, {}, 7).seconds, 0.03);
  EXPECT_EQ(Of(recorded, {}).source, LensFactSource::kMetadata);
  EXPECT_EQ(Of({}, {}, 0, 0.04).seconds, 0.04);
  EXPECT_EQ(Of({}, {}, 0, 0.04).source, LensFactSource::kMetadata);
  EXPECT_EQ(Of({}, {}).seconds, 0.0);
  EXPECT_EQ(Of(all, InMode(LensFactMode::kOff), 0, 0.04).seconds, 0.0);
  EXPECT_EQ(Of(all, InMode(LensFactMode::kMeasured), 0, 0.04).seconds, 0.0);
}

TEST(FrameExposure, IsMeasuredWhereNothingStatesIt) {
  auto exposure = FrameExposure::Create({}, {}, true);
  ASSERT_TRUE(exposure && exposure->MayBeMeasured());
  compositor::ExposureFit fit;
  fit.reason = "no";
  exposure->UseMeasured(fit);
  EXPECT_EQ(exposure->Of(0, {}).seconds, 0.0);
  fit.reason.clear();
  fit.exposure_s = 0.008;
  exposure->UseMeasured(fit);
  EXPECT_EQ(exposure->Of(0, {}).seconds, 0.008);
  EXPECT_EQ(exposure->Of(0, {}).source, LensFactSource::kMeasured);
  EXPECT_FALSE(FrameExposure::Create(SceneWith({0.01}, {}), {}, true)->MayBeMeasured());
}

TEST(FrameExposure, IsOffForACleanLookUnlessStated) {
  EXPECT_TRUE(FrameExposure::Create(SceneWith({0.01}, {}), {}, false)->IsOff());
  EXPECT_FALSE(
      FrameExposure::Create(SceneWith({0.01}, {}), InMode(LensFactMode::kStated), false)->IsOff());
  EXPECT_NE(tests::MessageOf(FrameExposure::Create({}, InMode(LensFactMode::kStated), true))
                .find("--motion-blur stated: no exposure is stated"),
            std::string::npos);
}

}  // namespace
}  // namespace pleinair::session
