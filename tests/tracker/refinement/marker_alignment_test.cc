#include "tracker/refinement/marker_alignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/tracker/marker_rendering.h"
#include "tracker/april_tag_detector.h"

namespace pleinair::tracker {
namespace {

CameraModel Pinhole() {
  return {.width = 176, .height = 144, .fx = 260, .fy = 262, .cx = 90.3, .cy = 70.1};
}

CameraModel Barrel() {
  CameraModel camera = Pinhole();
  camera.distortion = {-0.25, 0.08, 0.002, -0.0015, 0.01, 0, 0, 0};
  return camera;
}

CameraModel Fisheye() {
  CameraModel camera = Pinhole();
  camera.fx = camera.fy = 130;
  camera.distortion_model = DistortionModel::kEquidistant;
  camera.distortion = {-0.02, 0.004, 0, 0, 0, 0, 0, 0};
  return camera;
}

/// Errors over a set of poses: along the outward diagonal (a size bias), and in x and y.
struct Errors {
  int found = 0, aligned = 0;
  double raw_rms_px = 0.0, rms_px = 0.0;
  Vec2 bias_px;
  double outward_px = 0.0;
};

struct Sweep {
  int poses = 20;
  double min_side_px = 40, max_side_px = 75, max_tilt_deg = 60, jitter_px = 15;
  RenderingOptions rendering;
};

/// Detection, then alignment where the detector succeeds, at random poses.
Errors Measure(const CameraModel& camera, const Sweep& sweep) {
  std::mt19937 random(20140707);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto detector = CreateAprilTagDetector({"tag36h11"});
  Errors errors;
  int count = 0;
  for (int i = 0; i < sweep.poses; ++i) {
    RenderedMarker marker;
    marker.pattern = AprilTagPattern("tag36h11", i);
    const Vec2 centre{camera.width / 2.0 + sweep.jitter_px * (2 * unit(random) - 1),
                      camera.height / 2.0 + sweep.jitter_px * (2 * unit(random) - 1)};
    const double side_px =
        sweep.min_side_px + (sweep.max_side_px - sweep.min_side_px) * unit(random);
    marker.camera_from_marker = PoseAtPixel(
        camera, centre, side_px, marker.size, FromDegrees(sweep.max_tilt_deg * unit(random)),
        FromDegrees(360 * unit(random)), FromDegrees(360 * unit(random)));
    RenderingOptions rendering = sweep.rendering;
    rendering.seed = static_cast<std::uint32_t>(i + 1);
    const GreyImage image = RenderMarkers(camera, {marker}, rendering);
    const std::vector<Candidate> found = (*detector)->Detect(image.view());
    if (found.size() != 1) continue;
    ++errors.found;
    const std::array<Vec2, 4> truth = TrueCorners(camera, marker);
    const std::array<Vec2, 4>& raw = found[0].detection.corners_px;
    const auto alignment = AlignMarker(camera, *found[0].pattern, image.view(), raw);
    errors.aligned += alignment.has_value();
    const std::array<Vec2, 4>& corners = alignment ? alignment->corners_px : raw;
    const Vec2 middle = (truth[0] + truth[1] + truth[2] + truth[3]) * 0.25;
    for (int corner = 0; corner < 4; ++corner, ++count) {
      const Vec2 error = corners[corner] - truth[corner];
      const Vec2 outward = (truth[corner] - middle) * (1.0 / Norm(truth[corner] - middle));
      errors.rms_px += error.x * error.x + error.y * error.y;
      errors.raw_rms_px += std::pow(Norm(raw[corner] - truth[corner]), 2);
      errors.bias_px = errors.bias_px + error;
      errors.outward_px += error.x * outward.x + error.y * outward.y;
    }
  }
  errors.rms_px = std::sqrt(errors.rms_px / count);
  errors.raw_rms_px = std::sqrt(errors.raw_rms_px / count);
  errors.bias_px = errors.bias_px * (1.0 / count);
  errors.outward_px /= count;
  // Values for docs/measurements/tracker.md; --gtest_output=xml records them.
  testing::Test::RecordProperty("found", std::to_string(errors.found));
  testing::Test::RecordProperty("detector_rms_px", std::to_string(errors.raw_rms_px));
  testing::Test::RecordProperty("aligned_rms_px", std::to_string(errors.rms_px));
  testing::Test::RecordProperty("aligned_outward_px", std::to_string(errors.outward_px));
  return errors;
}

class MarkerAlignmentThroughLens : public testing::TestWithParam<CameraModel> {};

TEST_P(MarkerAlignmentThroughLens, HasNoBiasInCleanPictures) {
  const Errors errors = Measure(GetParam(), {});
  EXPECT_EQ(errors.found, 20);
  EXPECT_EQ(errors.aligned, 20);
  EXPECT_GT(errors.raw_rms_px,
            0.2);  // The effect of the sRGB curve on a detector that uses grey values.
  EXPECT_LT(errors.rms_px, 0.02);
  EXPECT_NEAR(errors.bias_px.x, 0.0, 0.005);
  EXPECT_NEAR(errors.bias_px.y, 0.0, 0.005);
  EXPECT_NEAR(errors.outward_px, 0.0, 0.01);
}

TEST_P(MarkerAlignmentThroughLens, HasNoBiasInBlurredNoisyPictures) {
  Sweep sweep;
  sweep.rendering.blur_px = 0.8;
  sweep.rendering.noise_codes = 3.0;
  const Errors errors = Measure(GetParam(), sweep);
  EXPECT_EQ(errors.found, 20);
  EXPECT_EQ(errors.aligned, 20);
  EXPECT_LT(errors.rms_px, 0.05);
  EXPECT_NEAR(errors.bias_px.x, 0.0, 0.01);
  EXPECT_NEAR(errors.bias_px.y, 0.0, 0.01);
  EXPECT_NEAR(errors.outward_px, 0.0, 0.015);
}

std::string LensName(const testing::TestParamInfo<CameraModel>& lens) {
  constexpr std::array<const char*, 3> kNames{"Pinhole", "Barrel", "Fisheye"};
  return kNames[lens.index];
}

INSTANTIATE_TEST_SUITE_P(Lenses, MarkerAlignmentThroughLens,
                         testing::Values(Pinhole(), Barrel(), Fisheye()), LensName);

TEST(MarkerAlignment, IsBetterThanTheDetectorAcrossAHardShadow) {
  Sweep sweep;
  // A shadow edge, 1 px soft, through the image centre: a third of the light remains behind it.
  sweep.rendering.light = [](Vec2 pixel) {
    const double distance = (pixel.x - 88) * 0.8 + (pixel.y - 70) * 0.6;
    return 0.33 + 0.67 * std::clamp(distance + 0.5, 0.0, 1.0);
  };
  const Errors errors = Measure(Pinhole(), sweep);
  EXPECT_GT(errors.found, 5);
  EXPECT_LT(errors.rms_px, 0.5 * errors.raw_rms_px);
}

TEST(MarkerAlignment, IsBetterThanTheDetectorUnderAGradient) {
  Sweep sweep;
  sweep.rendering.light = [](Vec2 pixel) { return std::exp(-pixel.x / 60.0) * 1.2; };
  const Errors errors = Measure(Pinhole(), sweep);
  EXPECT_GT(errors.found, 15);
  EXPECT_LT(errors.rms_px, 0.03);
}

TEST(MarkerAlignment, IsBetterThanTheDetectorOnTwelvePixels) {
  Sweep sweep{
      .poses = 40, .min_side_px = 12, .max_side_px = 16, .max_tilt_deg = 25, .rendering = {}};
  sweep.rendering.noise_codes = 1.0;
  const Errors errors = Measure(Pinhole(), sweep);
  EXPECT_GT(errors.found, 30);
  EXPECT_LT(errors.rms_px, 0.5 * errors.raw_rms_px);
}

TEST(MarkerAlignment, IsBetterThanTheDetectorWhenTheWhiteIsClipped) {
  Sweep sweep;
  sweep.rendering.light = [](Vec2) { return 2.0; };
  const Errors errors = Measure(Pinhole(), sweep);
  EXPECT_GT(errors.found, 15);
  EXPECT_LT(errors.rms_px, 0.5 * errors.raw_rms_px);
}

TEST(MarkerAlignment, TellsTheBlur) {
  const CameraModel camera = Pinhole();
  RenderedMarker marker;
  marker.pattern = AprilTagPattern("tag36h11", 5);
  marker.camera_from_marker = PoseAtPixel(camera, {88, 71}, 70, marker.size, FromDegrees(30),
                                          FromDegrees(70), FromDegrees(12));
  for (const double blur_px : {0.7, 1.0, 2.0}) {
    const GreyImage image = RenderMarkers(camera, {marker}, {.blur_px = blur_px, .light = {}});
    const auto alignment =
        AlignMarker(camera, *marker.pattern, image.view(), TrueCorners(camera, marker));
    ASSERT_TRUE(alignment.has_value());
    EXPECT_NEAR(alignment->blur_px, blur_px, 0.05);
  }
}

TEST(MarkerAlignment, RefusesWhatIsNotThere) {
  const CameraModel camera = Pinhole();
  const auto pattern = AprilTagPattern("tag36h11", 0);
  const std::array<Vec2, 4> corners{{{50, 40}, {110, 42}, {108, 100}, {52, 98}}};
  GreyImage image(camera.width, camera.height);
  EXPECT_FALSE(AlignMarker(camera, *pattern, image.view(), corners).has_value()) << "blank";
  std::mt19937 random(1);
  for (int i = 0; i < camera.width * camera.height; ++i) {
    image.data()[i] = static_cast<std::uint8_t>(random() >> 24);
  }
  EXPECT_FALSE(AlignMarker(camera, *pattern, image.view(), corners).has_value()) << "noise";
  const std::array<Vec2, 4> point{{{50, 40}, {50, 40}, {50, 40}, {50, 40}}};
  EXPECT_FALSE(AlignMarker(camera, *pattern, image.view(), point).has_value()) << "no area";
  const std::array<Vec2, 4> outside{{{-90, -90}, {-40, -90}, {-40, -40}, {-90, -40}}};
  EXPECT_FALSE(AlignMarker(camera, *pattern, image.view(), outside).has_value()) << "outside";
}

}  // namespace
}  // namespace pleinair::tracker
