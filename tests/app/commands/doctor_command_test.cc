#include <gtest/gtest.h>

#include <algorithm>

#include "app/commands/doctor_command.h"

namespace pleinair::app {
namespace {

using Verdict = Finding::Verdict;

CameraModel Plausible() {
  CameraModel camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 600.0;
  camera.fy = 601.0;
  camera.cx = 322.0;
  camera.cy = 238.0;
  camera.distortion = {-0.12, 0.03, 0.001, -0.0005, 0.0, 0.0, 0.0, 0.0};
  return camera;
}

Verdict VerdictOf(const CameraModel& camera, const std::string& subject) {
  for (const Finding& finding : ExamineCalibration(camera)) {
    if (finding.subject == subject) return finding.verdict;
  }
  ADD_FAILURE() << "nothing said about " << subject;
  return Verdict::kBad;
}

TEST(Doctor, FindsNothingWrongWithAPlausibleCalibration) {
  for (const Finding& finding : ExamineCalibration(Plausible())) {
    EXPECT_EQ(finding.verdict, Verdict::kGood) << finding.subject << ": " << finding.text;
  }
}

TEST(Doctor, DoubtsARendererThatGivesEdgesFewSamples) {
  EXPECT_EQ(ExamineSamples(4).verdict, Verdict::kGood);
  EXPECT_EQ(ExamineSamples(4).text, "4 samples a pixel");
  EXPECT_EQ(ExamineSamples(1).verdict, Verdict::kDoubtful);
  EXPECT_EQ(ExamineSamples(1).text.substr(0, 23), "1 of 4 samples a pixel,");
}

TEST(Doctor, DoubtsFocalLengthsOfAnotherPictureSize) {
  CameraModel camera = Plausible();
  camera.width = 6400;
  EXPECT_EQ(VerdictOf(camera, "focal length"), Verdict::kDoubtful);
  camera = Plausible();
  camera.fy = 700.0;
  EXPECT_EQ(VerdictOf(camera, "focal length"), Verdict::kDoubtful);
}

TEST(Doctor, RejectsAPrincipalPointOutsideThePicture) {
  CameraModel camera = Plausible();
  camera.cx = 900.0;
  EXPECT_EQ(VerdictOf(camera, "principal point"), Verdict::kBad);
}

TEST(Doctor, RejectsADistortionThatFoldsBackInsideThePicture) {
  CameraModel camera = Plausible();
  // r (1 − 0.9 r²) has its maximum 0.41 at r = 0.61: 243 px, while the corner is 400 px away.
  camera.distortion = {-0.9, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(VerdictOf(camera, "distortion"), Verdict::kBad);
  // A maximum beyond the corners is harmless: 0.86 at r = 1.29, 516 px.
  camera.distortion = {-0.2, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(VerdictOf(camera, "distortion"), Verdict::kGood);
}

TEST(Doctor, AcceptsAFisheye) {
  CameraModel camera = Plausible();
  camera.distortion_model = DistortionModel::kEquidistant;
  camera.fx = camera.fy = 200.0;
  camera.distortion = {-0.01, 0.005, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(VerdictOf(camera, "distortion"), Verdict::kGood);
}

}  // namespace
}  // namespace pleinair::app
