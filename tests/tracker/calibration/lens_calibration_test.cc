#include "tracker/calibration/lens_calibration.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <random>

#include "tests/tracker/calibration/board_rendering.h"
#include "tracker/calibration/aruco_dictionaries.h"
#include "tracker/calibration/board_finder.h"
#include "tracker/calibration/lens_residual.h"

namespace pleinair::tracker {
namespace {

using testing::AllOf;
using testing::HasSubstr;

CalibrationBoard Charuco() { return {BoardKind::kCharuco, 8, 6, 0.03, 0.0, 0, "5x5_50"}; }

/// RMS distance in pixels between two lenses' projections of the same directions. Images do not
/// determine the camera's rotation, so the best rotation is removed first.
double MapApart_px(const CameraModel& a, const CameraModel& b) {
  std::vector<Vec3> rays;
  std::vector<Vec2> pixels;
  for (int y = 0; y < a.height; y += 16) {
    for (int x = 0; x < a.width; x += 16) {
      pixels.push_back({1.0 * x, 1.0 * y});
      const Vec2 ray = UndistortPixel(a, pixels.back());
      rays.push_back({ray.x, ray.y, 1.0});
    }
  }
  cv::Matx31d turn(0.0, 0.0, 0.0);
  const auto apart = [&](const cv::Matx31d& by) {
    cv::Mat_<double> differences(static_cast<int>(2 * rays.size()), 1);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Vec3 turned = rays[i] + Cross({by(0), by(1), by(2)}, rays[i]);
      const Vec2 difference = ProjectToPixel(b, Point<Camera>{turned}) - pixels[i];
      differences(static_cast<int>(2 * i)) = difference.x;
      differences(static_cast<int>(2 * i + 1)) = difference.y;
    }
    return differences;
  };
  for (int step = 0; step < 3; ++step) {
    const cv::Mat_<double> at = apart(turn);
    cv::Mat_<double> jacobian(at.rows, 3);
    for (int i = 0; i < 3; ++i) {
      cv::Matx31d moved = turn;
      moved(i) += 1e-6;
      jacobian.col(i) = (apart(moved) - at) / 1e-6;
    }
    cv::Mat_<double> by;
    cv::solve(jacobian, at, by, cv::DECOMP_QR);
    turn -= cv::Matx31d(by(0), by(1), by(2));
  }
  const cv::Mat_<double> left = apart(turn);
  return std::sqrt(left.dot(left) / static_cast<double>(rays.size()));
}

/// Board views detected in rendered images, as in `pleinair calibrate`.
std::vector<PlaneView> RenderedViews(const CameraModel& camera, const CalibrationBoard& board,
                                     const std::vector<Transform<Camera, Marker>>& poses,
                                     bool legacy = false) {
  CalibrationBoard unknown = board;
  unknown.dictionary.clear();  // The dictionary is to be detected.
  auto finder = BoardFinder::Create(unknown);
  EXPECT_TRUE(finder);
  std::vector<PlaneView> views;
  std::vector<GreyImage> pictures;
  std::vector<BoardView> found;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    RenderingOptions options;
    options.blur_px = 0.6;
    options.noise_codes = 2.0;
    options.seed = static_cast<std::uint32_t>(i + 1);
    pictures.push_back(RenderBoard(camera, board, poses[i], options, legacy));
    auto view = (*finder)->Find(pictures.back().view());
    if (!view) continue;
    view->name = "view " + std::to_string(i);
    if ((*finder)->refines()) (*finder)->Refine(camera, pictures.back().view(), &*view);
    views.push_back(OnPlane(*view, BoardPoints(board)));
  }
  if (board.kind == BoardKind::kCharuco) {
    EXPECT_EQ((*finder)->board().dictionary, board.dictionary);
  }
  return views;
}

/// Views as noisy corners, without images.
std::vector<PlaneView> DrawnViews(const CameraModel& camera,
                                  const std::vector<Transform<Camera, Marker>>& poses,
                                  double noise_px) {
  const std::vector<Vec2> points = BoardPoints({BoardKind::kChessboard, 9, 6, 0.03, 0.0, 0, ""});
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, noise_px);
  std::vector<PlaneView> views;
  for (const auto& pose : poses) {
    PlaneView view{"view " + std::to_string(views.size()), {}, {}};
    for (const Vec2 at : points) {
      const Vec2 pixel = ProjectToPixel(camera, pose * Point<Marker>{{at.x, at.y, 0.0}});
      if (pixel.x < 0 || pixel.y < 0 || pixel.x >= camera.width || pixel.y >= camera.height)
        continue;
      view.on_board_m.push_back(at);
      view.observed_px.push_back(pixel + Vec2{noise(random), noise(random)});
    }
    if (view.observed_px.size() >= 6) views.push_back(std::move(view));
  }
  return views;
}

void ExpectTheTrueLens(const std::vector<PlaneView>& views, std::size_t min_views) {
  const CameraModel truth = BoardCamera();
  EXPECT_GE(views.size(), min_views);
  const auto found = CalibrateLens(views, truth.width, truth.height);
  ASSERT_TRUE(found) << found.error().Message();
  const CameraModel& camera = found->fit.camera;
  std::cout << NameOf(found->fit.kind) << ", views " << found->views.size() << ", rms "
            << found->rms_px << " px, left out " << found->validation.rms_px << " px, fx "
            << camera.fx << " ± " << found->uncertainty.fx << ", fy " << camera.fy << ", centre "
            << camera.cx << " " << camera.cy << " ± " << found->uncertainty.cx << ", map "
            << MapApart_px(truth, camera) << " px\n";
  EXPECT_NEAR(camera.fx / truth.fx, 1.0, 0.002);
  EXPECT_NEAR(camera.fy / truth.fy, 1.0, 0.002);
  EXPECT_LT(MapApart_px(truth, camera), 0.1);
  EXPECT_LT(std::fabs(camera.fx - truth.fx), 5.0 * found->uncertainty.fx);
  EXPECT_LT(std::fabs(camera.cx - truth.cx), 5.0 * found->uncertainty.cx);
  EXPECT_LT(found->rms_px, 0.15);
}

/// Rendering dominates the run time.
std::vector<Transform<Camera, Marker>> EverySecond(
    const std::vector<Transform<Camera, Marker>>& poses) {
  std::vector<Transform<Camera, Marker>> half;
  for (std::size_t i = 1; i < poses.size(); i += 2) half.push_back(poses[i]);
  return half;
}

TEST(LensCalibration, FindsTheLensFromRenderedChessboards) {
  const CalibrationBoard board{BoardKind::kChessboard, 9, 6, 0.03, 0.0, 0, ""};
  ExpectTheTrueLens(RenderedViews(BoardCamera(), board, BoardPoses(BoardCamera(), 0.3, 40.0)), 9);
}

TEST(LensCalibration, FindsTheLensFromRenderedCharucoBoardsWhoseDictionaryNobodySaid) {
  ExpectTheTrueLens(RenderedViews(BoardCamera(), Charuco(), BoardPoses(BoardCamera(), 0.24, 40.0)),
                    11);
}

TEST(LensCalibration, FindsTheLensFromRenderedBoardsOfOurMarkers) {
  const CalibrationBoard board{BoardKind::kMarkers, 4, 3, 0.05, 0.01, 8, ""};
  ExpectTheTrueLens(
      RenderedViews(BoardCamera(), board, EverySecond(BoardPoses(BoardCamera(), 0.26, 35.0))), 6);
}

TEST(LensCalibration, KnowsBoardsFromBeforeOpenCv46ByLooking) {
  // The two layouts differ for an even number of rows such as six. The images must determine the
  // layout.
  const auto poses = BoardPoses(BoardCamera(), 0.24, 40.0);
  const auto views = RenderedViews(BoardCamera(), Charuco(), {poses[0], poses[1]}, true);
  ASSERT_EQ(views.size(), 2U);
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_LT(Rms(Residuals(BoardCamera(), poses[i], views[i])), 0.15);
    EXPECT_EQ(views[i].observed_px.size(), 35U);
  }
}

/// The error of a calibration from these poses.
std::string Refusal(const std::vector<Transform<Camera, Marker>>& poses) {
  const CameraModel camera = BoardCamera();
  const auto found = CalibrateLens(DrawnViews(camera, poses, 0.05), camera.width, camera.height);
  return found ? "" : found.error().Message();
}

Transform<Camera, Marker> Seen(double x, double y, double side_px, double tilt_deg,
                               double axis_deg) {
  return PoseAtPixel(BoardCamera(), {x * 640.0, y * 480.0}, side_px, Metres(0.3),
                     Radians(tilt_deg * kRadiansPerDegree), Radians(axis_deg * kRadiansPerDegree),
                     Radians(0.0));
}

TEST(LensCalibration, IsSureOfGoodViews) {
  EXPECT_EQ(Refusal(BoardPoses(BoardCamera(), 0.3, 40.0)), "");
}

TEST(LensCalibration, RefusesViewsFromStraightAhead) {
  std::vector<Transform<Camera, Marker>> poses;
  for (int i = 0; i < 12; ++i) {
    // Parallel to the image plane at every position.
    Transform<Camera, Marker> pose = Seen(0.5, 0.5, 300.0, 0.0, 0.0);
    pose.rotation = {{1, 0, 0, 0, -1, 0, 0, 0, -1}};
    pose.translation_m = {0.12 * (i % 4 - 1.5), 0.09 * (i / 4 - 1.0), 0.5 + 0.05 * (i % 3)};
    poses.push_back(pose);
  }
  EXPECT_THAT(Refusal(poses),
              AllOf(HasSubstr("looks straight at the board"), HasSubstr("tilt the board")));
}

TEST(LensCalibration, RefusesABoardThatNeverTurns) {
  std::vector<Transform<Camera, Marker>> poses;
  for (int i = 0; i < 12; ++i) {
    Transform<Camera, Marker> pose = Seen(0.5, 0.5, 300.0, 35.0, 20.0);
    pose.translation_m = {0.12 * (i % 4 - 1.5), 0.09 * (i / 4 - 1.0), 0.5 + 0.05 * (i % 3)};
    poses.push_back(pose);
  }
  EXPECT_THAT(Refusal(poses), HasSubstr("stands the same way in every view"));
}

TEST(LensCalibration, RefusesPointsThatAllLieAtOneDistance) {
  std::vector<Transform<Camera, Marker>> poses;
  for (int i = 0; i < 12; ++i) {
    Transform<Camera, Marker> pose = Seen(0.5, 0.5, 300.0, i % 2 == 0 ? 4.5 : -4.5, 0.0);
    pose.translation_m = {0.3 * (i % 4 - 1.5), 0.22 * (i / 4 - 1.0), 1.3};
    poses.push_back(pose);
  }
  EXPECT_THAT(Refusal(poses), HasSubstr("are at one distance"));
}

TEST(LensCalibration, JudgesByTheCovarianceWhetherDistancesAndTiltsDetermineTheFocalLength) {
  // Twelve positions, at 44, 55 and 66 cm or all at 55 cm.
  const auto places = [](double tilt_deg, bool three_distances, bool one_axis) {
    std::vector<Transform<Camera, Marker>> poses;
    for (int i = 0; i < 12; ++i) {
      const double sign = i % 2 == 0 ? 1.0 : -1.0;
      Transform<Camera, Marker> pose =
          Seen(0.5, 0.5, 300.0, one_axis ? sign * tilt_deg : tilt_deg, one_axis ? 0.0 : 210.0 * i);
      const double far = three_distances ? 0.8 + 0.2 * (i / 2 % 3) : 1.0;
      pose.translation_m = {0.1 * (i % 4 - 1.5), 0.08 * (i / 4 - 1.0), 0.55 * far};
      poses.push_back(pose);
    }
    return poses;
  };
  for (const bool three_distances : {false, true}) {
    // Distances alone do not help: for fronto-parallel planes a longer lens farther away gives the
    // same images.
    for (const double tilt_deg : {0.0, 5.0}) {
      EXPECT_THAT(Refusal(places(tilt_deg, three_distances, false)),
                  HasSubstr("looks straight at the board"))
          << tilt_deg;
    }
    // Tilts suffice, at any distance.
    EXPECT_EQ(Refusal(places(15.0, three_distances, false)), "");
    // With tilts about one axis only, one of the two focal lengths is undetermined.
    EXPECT_THAT(Refusal(places(20.0, three_distances, true)),
                HasSubstr("tilt the board about both axes"));
  }
}

TEST(LensCalibration, RefusesViewsOfOneCornerOfThePicture) {
  std::vector<Transform<Camera, Marker>> poses;
  for (int i = 0; i < 12; ++i) {
    poses.push_back(
        Seen(0.2 + 0.02 * (i % 3), 0.25 + 0.02 * (i % 2), 160.0 + 10.0 * i, 35.0, 30.0 * i));
  }
  EXPECT_THAT(Refusal(poses),
              AllOf(HasSubstr("covers only"), HasSubstr("right"), HasSubstr("every edge")));
}

TEST(LensCalibration, RefusesTooFewViews) {
  auto poses = BoardPoses(BoardCamera(), 0.3, 40.0);
  poses.resize(3);
  EXPECT_THAT(Refusal(poses), HasSubstr("only 3 of 3 views"));
}

TEST(LensCalibration, RefusesBoardsThatAreNotAsDescribed) {
  const CameraModel camera = BoardCamera();
  auto views = DrawnViews(camera, BoardPoses(camera, 0.3, 40.0), 0.05);
  // Distorted squares: the board was scaled in one direction and bent.
  for (PlaneView& view : views) {
    for (Vec2& at : view.on_board_m) at.x *= 1.0 + 2.0 * at.x;
  }
  const auto found = CalibrateLens(views, camera.width, camera.height);
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().Message(), HasSubstr("not as described or not flat"));
}

TEST(LensCalibration, LeavesOutWhatContradictsTheRest) {
  const CameraModel camera = BoardCamera();
  auto views = DrawnViews(camera, BoardPoses(camera, 0.3, 40.0), 0.1);
  views[3].observed_px[7].x += 9.0;  // One outlier corner,
  for (Vec2& observed : views[5].observed_px)
    observed = observed * 0.8 + Vec2{40.0 + 0.0004 * observed.x * observed.y, 20.0};
  const auto found = CalibrateLens(views, camera.width, camera.height);
  ASSERT_TRUE(found) << found.error().Message();
  EXPECT_NEAR(found->fit.camera.fx / camera.fx, 1.0, 0.002);
  ASSERT_EQ(found->dropped.size(), 1U);  // … and one view that no pose explains.
  EXPECT_EQ(found->dropped[0].name, "view 5");
  EXPECT_GE(found->points_left_out, 1);
  EXPECT_LE(found->points_left_out, 3);
}

TEST(LensCalibration, KnowsAFisheyeFromOtherLenses) {
  CameraModel fisheye = BoardCamera();
  fisheye.fx = fisheye.fy = 260.0;
  fisheye.distortion_model = DistortionModel::kEquidistant;
  fisheye.distortion = {0.03, -0.01, 0.004, -0.001};
  const auto views = DrawnViews(fisheye, BoardPoses(fisheye, 0.3, 40.0), 0.05);
  const auto found = CalibrateLens(views, fisheye.width, fisheye.height);
  ASSERT_TRUE(found) << found.error().Message();
  EXPECT_EQ(found->fit.kind, LensKind::kEquidistant);
  EXPECT_NEAR(found->fit.camera.fx / fisheye.fx, 1.0, 0.002);
  EXPECT_LT(MapApart_px(fisheye, found->fit.camera), 0.3);
}

// With few corners a view, models differ by chance by more than a hundredth.
TEST(LensCalibration, TakesNoOrdinaryLensForAFisheye) {
  const CameraModel camera = BoardCamera();
  int calibrated = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::vector<PlaneView> views = DrawnViews(camera, BoardPoses(camera, 0.3, 40.0), 0.0);
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 0.4);
    for (PlaneView& view : views) {
      PlaneView few{view.name, {}, {}};
      for (std::size_t i = 0; i < view.observed_px.size(); i += 7) {
        few.on_board_m.push_back(view.on_board_m[i]);
        few.observed_px.push_back(view.observed_px[i] + Vec2{noise(random), noise(random)});
      }
      view = few;
    }
    const auto found = CalibrateLens(views, camera.width, camera.height);
    if (!found) continue;
    ++calibrated;
    EXPECT_NE(found->fit.kind, LensKind::kEquidistant) << seed;
  }
  EXPECT_GT(calibrated, 6);
}

TEST(LensUncertainty, IsTheSpreadOfFitsToRepeatedNoise) {
  const CameraModel camera = BoardCamera();
  const auto poses = BoardPoses(camera, 0.3, 40.0);
  const auto exact = DrawnViews(camera, poses, 0.0);
  const auto start = FitLens(exact, camera.width, camera.height, LensKind::kRadtan5, 0.0);
  ASSERT_TRUE(start);
  constexpr int kRuns = 40;
  constexpr double kNoise_px = 0.2;
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, kNoise_px);
  double squares = 0.0, stated = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    auto views = exact;
    for (PlaneView& view : views) {
      for (Vec2& observed : view.observed_px)
        observed = observed + Vec2{noise(random), noise(random)};
    }
    const auto fit = FitLensFrom(views, *start, LensKind::kRadtan5, 0.0);
    ASSERT_TRUE(fit);
    squares += std::pow(fit->camera.fx - camera.fx, 2);
    const LensUncertainty uncertainty = Uncertainty(*fit, views, 0.0);
    EXPECT_NEAR(uncertainty.noise_px, kNoise_px, 0.02);
    stated += uncertainty.fx / kRuns;
  }
  // The standard deviation of 40 draws has an error of 11 %; the tolerance is three times that.
  EXPECT_NEAR(std::sqrt(squares / kRuns) / stated, 1.0, 0.35);
}

}  // namespace
}  // namespace pleinair::tracker
