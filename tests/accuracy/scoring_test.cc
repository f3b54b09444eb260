#include "accuracy/scoring.h"

#include <gtest/gtest.h>

#include <cmath>

#include "accuracy/marker_pose.h"
#include "accuracy/random.h"
#include "accuracy/statistics.h"
#include "accuracy/summary.h"
#include "accuracy/sweeps.h"
#include "accuracy/trajectory_error.h"

namespace pleinair::accuracy {
namespace {

MarkerTruth TruthAt(Vec2 centre_px, int number) {
  MarkerTruth truth{.number = number};
  const CameraModel camera = SweepCamera("640x480");
  truth.camera_from_marker = PoseAtPixel(camera, centre_px, 100, kMarkerEdge, FromDegrees(20),
                                         FromDegrees(30), FromDegrees(10));
  truth.corners_px = SquareCorners(camera, truth.camera_from_marker, kMarkerEdge);
  return truth;
}

Detected Shifted(const MarkerTruth& truth, Vec2 by_px) {
  Detected detected{.number = truth.number, .corners_px = truth.corners_px};
  for (Vec2& corner : detected.corners_px) corner = corner + by_px;
  return detected;
}

TEST(Score, TellsHitsMisplacedMissedAndFalse) {
  const MarkerTruth a = TruthAt({150, 120}, 3), b = TruthAt({450, 120}, 4),
                    c = TruthAt({300, 350}, 5);
  FrameRecord record;
  Detected other = Shifted(a, {0, 0});
  other.number = 9;
  // The edge is about 100 px, the tolerance 3 px. The nearer of two detections counts; the other is
  // false.
  Score({a, b, c}, {Shifted(a, {2.5, 0}), Shifted(a, {0.1, 0}), Shifted(b, {0, 4}), other},
        &record);
  ASSERT_EQ(record.markers.size(), 3U);
  EXPECT_EQ(record.markers[0].outcome, Outcome::kHit);
  EXPECT_NEAR(record.markers[0].CornerRms(), 0.1, 1e-9);
  EXPECT_EQ(record.markers[1].outcome, Outcome::kMisplaced);
  EXPECT_EQ(record.markers[2].outcome, Outcome::kMissed);
  EXPECT_EQ(record.false_numbers, 2);
}

TEST(Nees, IsThatOfErrorsDrawnFromTheCovariance) {
  const MarkerTruth truth = TruthAt({300, 200}, 1);
  RandomStream random(2, "nees");
  tracker::PoseEstimate estimate;
  const double rotation_sd = 0.004, translation_sd = 0.002;
  for (int i = 0; i < 6; ++i) {
    estimate.covariance[7 * i] =
        i < 3 ? rotation_sd * rotation_sd : translation_sd * translation_sd;
  }
  double sum = 0.0;
  constexpr int kDraws = 2000;
  for (int i = 0; i < kDraws; ++i) {
    Vec3 turn{random.Normal(), random.Normal(), random.Normal()};
    const double angle = Norm(turn) * rotation_sd;
    auto& pose = estimate.best.camera_from_marker;
    pose.rotation = RotationAbout(Normalized(turn), angle) * truth.camera_from_marker.rotation;
    pose.translation_m = truth.camera_from_marker.translation_m +
                         Vec3{random.Normal(), random.Normal(), random.Normal()} * translation_sd;
    sum += *Nees(estimate, truth.camera_from_marker);
  }
  EXPECT_TRUE(MeanChiSquareBand(6, kDraws, 0.999).Contains(sum / kDraws)) << sum / kDraws;
  estimate.covariance[0] = 0.0;
  EXPECT_FALSE(Nees(estimate, truth.camera_from_marker).has_value());
}

TEST(AngleBetween, IsExactForSmallAndLargeTurns) {
  for (const double angle : {1e-9, 1e-4, 1.0, 3.1}) {
    EXPECT_NEAR(AngleBetween(Mat3{}, RotationAbout({0, 0, 1}, angle)), angle, 1e-8 * angle);
  }
}

/// A camera that moves around the marker.
Trajectory Circle(int frames, const Transform<Marker, Marker>& moved, double drift_m = 0.0) {
  Trajectory path;
  for (int i = 0; i < frames; ++i) {
    const double angle = 0.1 * i;
    Transform<Marker, Camera> pose{RotationAbout({0, 0, 1}, angle),
                                   {2 * std::cos(angle), 2 * std::sin(angle), 1.0 + 0.02 * i}};
    pose.translation_m = pose.translation_m + Vec3{drift_m * i, 0, 0};
    path.push_back({i, moved * pose});
  }
  return path;
}

// Sturm et al. 2012, section IV: both errors for trajectories with known errors.
TEST(TrajectoryError, IsThatOfPathsWhoseErrorsAreKnown) {
  const Transform<Marker, Marker> none;
  const Trajectory truth = Circle(60, none);
  // A rigidly moved trajectory: alignment removes the absolute error, and the relative error is
  // zero.
  const Transform<Marker, Marker> moved{RotationAbout({0, 1, 0}, 0.2), {0.3, 0.0, 0.4}};
  auto error = CompareTrajectories(Circle(60, moved), truth);
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->poses, 60);
  EXPECT_EQ(error->steps, 59);
  EXPECT_NEAR(error->ate_rmse_m, 0.0, 1e-12);
  EXPECT_GT(error->ate_unaligned_rmse_m, 0.3);
  EXPECT_NEAR(error->rpe_translation_rmse_m, 0.0, 1e-12);
  // A camera that drifts by 1 mm per step has a relative error of 1 mm.
  error = CompareTrajectories(Circle(60, none, 0.001), truth);
  EXPECT_NEAR(error->rpe_translation_rmse_m, 0.001, 1e-9);
  EXPECT_NEAR(error->rpe_rotation_rmse_deg, 0.0, 1e-9);
  // Frames without a pose count in neither error: a gap is not a step.
  Trajectory with_gap = truth;
  with_gap.erase(with_gap.begin() + 10, with_gap.begin() + 20);
  error = CompareTrajectories(with_gap, truth);
  EXPECT_EQ(error->poses, 50);
  EXPECT_EQ(error->steps, 48);
  EXPECT_FALSE(CompareTrajectories({}, truth).has_value());
}

// Calculated by hand: a camera at the corners of a square, with alternating errors of ±1 cm in
// height. No rigid motion reduces them (the errors' moments vanish). Each step has an error of 2
// cm.
TEST(TrajectoryError, IsWhatOneWorksOutByHand) {
  const std::array<Vec3, 4> corners{Vec3{1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {-1, 1, 0}};
  Trajectory truth, found;
  for (int i = 0; i < 4; ++i) {
    const Vec3 error{0, 0, i % 2 == 0 ? 0.01 : -0.01};
    truth.push_back({i, {Mat3{}, corners[i]}});
    found.push_back({i, {Mat3{}, corners[i] + error}});
  }
  const auto error = CompareTrajectories(found, truth);
  ASSERT_TRUE(error.has_value());
  EXPECT_NEAR(error->ate_rmse_m, 0.01, 1e-12);
  EXPECT_NEAR(error->ate_unaligned_rmse_m, 0.01, 1e-12);
  EXPECT_NEAR(error->rpe_translation_rmse_m, 0.02, 1e-12);
  EXPECT_NEAR(error->rpe_rotation_rmse_deg, 0.0, 1e-12);
}

// Results of the TUM RGB-D benchmark's evaluate_ate and evaluate_rpe for these trajectories. They
// were reimplemented in NumPy after Sturm et al. 2012 (Horn's alignment by singular values).
TEST(TrajectoryError, IsThatOfTheBenchmarksTools) {
  Trajectory truth, found;
  for (int i = 0; i < 12; ++i) {
    const double s = 0.3 * i;
    const Mat3 turn = RotationAbout({0, 0, 1}, 0.5 * s) * RotationAbout({1, 0, 0}, 0.2 * s);
    truth.push_back({i, {turn, {2 * std::cos(s), 1.5 * std::sin(s), 0.1 * s * s}}});
    found.push_back({i,
                     {RotationAbout({0, 1, 0}, 0.3 + 0.01 * std::sin(3 * s)) * turn,
                      {2.02 * std::cos(s) + 0.4, 1.5 * std::sin(s + 0.01), 0.1 * s * s - 0.2}}});
  }
  const auto error = CompareTrajectories(found, truth);
  ASSERT_TRUE(error.has_value());
  EXPECT_NEAR(error->ate_rmse_m, 0.015500045105943624, 1e-12);
  EXPECT_NEAR(error->rpe_translation_rmse_m, 0.1288946600290839, 1e-12);
  EXPECT_NEAR(error->rpe_rotation_rmse_deg, 0.3606704038956915, 1e-9);
}

TEST(Films, CountHowOftenAMarkerIsLostToldAndFoundAgain) {
  RunRecords run;
  // Missed at first, then tracks of 3, 1 and 2 frames. The detector reports the first loss.
  const std::string seen = ".###..#..##";
  for (std::size_t i = 0; i < seen.size(); ++i) {
    FrameRecord frame{.frame = static_cast<std::int64_t>(i), .sweep = "sequence"};
    frame.repeat = static_cast<int>(i);
    frame.detector = "ours";
    frame.lost = i == 4 || i == 5 ? 1 : 0;
    MarkerRecord& marker = frame.markers.emplace_back();
    marker.true_camera_from_marker.translation_m = {0, 0, 1};
    if (seen[i] == '#') {
      marker.outcome = Outcome::kHit;
      marker.pose.emplace().camera_from_marker = marker.true_camera_from_marker;
    }
    run.frames.push_back(frame);
  }
  const RunSummary summary = Summarize(run, 640, 480);
  ASSERT_EQ(summary.films.size(), 1U);
  const FilmSummary& film = summary.films[0];
  EXPECT_EQ(film.found, 6);
  EXPECT_EQ(film.tracks.count, 3);
  EXPECT_EQ(film.tracks.longest, 3);
  EXPECT_EQ(film.median_track, 2.0);
  EXPECT_EQ(film.losses.count, 2);
  EXPECT_EQ(film.losses.reported, 1);
  EXPECT_EQ(film.losses.recovered, 2);
  EXPECT_EQ(film.gaps.count, 3);
  EXPECT_EQ(film.gaps.longest, 2);
}

TEST(Light, HasTheMeansOfRecordingsAndOfAllWithIntervals) {
  RunRecords run;
  const auto add = [&](const char* recording, double object_de) {
    ImageRecord picture{.recording = recording};
    picture.scores[2] = object_de;
    run.pictures.push_back(picture);
  };
  add("a", 1.0);
  add("a", 1.4);
  add("b", 2.0);
  const std::vector<LightSummary> light = Summarize(run, 640, 480).light;
  ASSERT_EQ(light.size(), 3U);
  EXPECT_EQ(light[0].recording, "a");
  EXPECT_EQ(light[0].figures[2].count, 2);
  EXPECT_NEAR(light[0].figures[2].mean, 1.2, 1e-12);
  EXPECT_NEAR(light[0].figures[2].interval->high, 1.2 + 12.706 * 0.2, 1e-3);
  EXPECT_EQ(light[0].figures[0].count, 0);
  EXPECT_FALSE(light[1].figures[2].interval.has_value());
  EXPECT_EQ(light[2].recording, "");
  EXPECT_EQ(light[2].pictures, 3);
  EXPECT_EQ(light[2].figures[2].count, 2);
  EXPECT_NEAR(light[2].figures[2].mean, 1.6, 1e-12);
}

}  // namespace
}  // namespace pleinair::accuracy
