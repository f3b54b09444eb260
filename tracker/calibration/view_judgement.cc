#include "tracker/calibration/view_judgement.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/units.h"

namespace pleinair::tracker {
namespace {

// Refused beyond these: what lies there cannot be told from the noise of real corners, or only from
// the model's being exact. Photographs taken with some care lie far on the other side.
constexpr double kLeastTilt_deg = 8.0;
constexpr double kLeastDepthRatio = 1.12;
constexpr double kLeastShare = 0.25;
constexpr double kLeastHalf = 0.12;
constexpr double kMostFocalDeviation = 0.01;   // Relative.
constexpr double kMostCentreDeviation = 0.02;  // Of the picture's longer side.
constexpr double kMostRmsShare = 0.005;        // Of the picture's longer side: 3 px of 640.
// Said below these.
constexpr double kGoodTilt_deg = 20.0;
constexpr double kGoodShare = 0.7;
constexpr double kGoodHalf = 0.5;
constexpr double kGoodDistanceRatio = 1.3;
constexpr std::size_t kGoodViews = 10;

std::string Number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

void Measure(const LensFit& fit, const std::vector<PlaneView>& views, ViewJudgement* judgement) {
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
  double nearest_middle = nearest, farthest_middle = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Transform<Camera, Marker>& pose = fit.camera_from_board[i];
    const auto normal = [&](std::size_t view) {
      const Mat3& r = fit.camera_from_board[view].rotation;
      return Vec3{r(0, 2), r(1, 2), r(2, 2)};
    };
    const auto degrees = [](double cosine) {
      return std::acos(std::clamp(std::fabs(cosine), 0.0, 1.0)) / kRadiansPerDegree;
    };
    judgement->largest_tilt_deg = std::max(judgement->largest_tilt_deg, degrees(normal(i).z));
    for (std::size_t other = 0; other < i; ++other) {
      judgement->widest_apart_deg =
          std::max(judgement->widest_apart_deg, degrees(Dot(normal(i), normal(other))));
    }
    for (const Vec2 at : views[i].on_board_m) {
      const double depth = (pose * Point<Marker>{{at.x, at.y, 0.0}}).xyz.z;
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
    nearest_middle = std::min(nearest_middle, pose.translation_m.z);
    farthest_middle = std::max(farthest_middle, pose.translation_m.z);
  }
  judgement->depth_ratio = farthest / nearest;
  judgement->distance_ratio = farthest_middle / nearest_middle;
}

void JudgePlanes(ViewJudgement* judgement) {
  if (judgement->largest_tilt_deg < kLeastTilt_deg) {
    judgement->reasons.push_back(
        "the camera looks straight at the board in every view (tilted by at most " +
        Number("%.1f", judgement->largest_tilt_deg) +
        " degrees), which leaves the focal length open: tilt the board by 20 to 45 degrees, in "
        "several directions");
  } else if (judgement->widest_apart_deg < kLeastTilt_deg) {
    judgement->reasons.push_back("the board stands the same way in every view (to " +
                                 Number("%.1f", judgement->widest_apart_deg) +
                                 " degrees): tilt it in several directions");
  } else if (judgement->largest_tilt_deg < kGoodTilt_deg) {
    judgement->advice.push_back(
        "tilt the board more: " + Number("%.0f", judgement->largest_tilt_deg) +
        " degrees are the most, 20 to 45 are good");
  }
  if (judgement->depth_ratio < kLeastDepthRatio) {
    judgement->reasons.push_back(
        "everything seen lies at one distance (to " +
        Number("%.0f", 100.0 * (judgement->depth_ratio - 1.0)) +
        " %), and a longer lens farther off would show the same: come nearer in some views");
  } else if (judgement->distance_ratio < kGoodDistanceRatio) {
    judgement->advice.emplace_back("take some views from nearer and some from farther");
  }
}

void JudgeCoverage(const ViewCoverage& coverage, ViewJudgement* judgement) {
  constexpr const char* kHalves[] = {"left", "right", "upper", "lower"};
  const std::array<double, 4> halves = coverage.Halves();
  std::string bare, thin;
  for (std::size_t i = 0; i < halves.size(); ++i) {
    std::string* list = halves[i] < kLeastHalf ? &bare : halves[i] < kGoodHalf ? &thin : nullptr;
    if (list != nullptr) *list += (list->empty() ? "" : ", ") + std::string(kHalves[i]);
  }
  const std::string share = Number("%.0f", 100.0 * coverage.Share()) + " % of the picture";
  if (coverage.Share() < kLeastShare || !bare.empty()) {
    judgement->reasons.push_back("the board covers only " + share +
                                 (bare.empty() ? "" : ", next to nothing of its half: " + bare) +
                                 "; the lens's distortion elsewhere would be a guess: take the "
                                 "board to every edge and corner of the picture");
  } else if (coverage.Share() < kGoodShare || !thin.empty()) {
    judgement->advice.push_back("the board covers " + share +
                                (thin.empty() ? "" : ", little of its half: " + thin) +
                                ": take it to every edge and corner");
  }
}

void JudgeNumbers(const LensFit& fit, const std::vector<PlaneView>& views,
                  const LensUncertainty& uncertainty, ViewJudgement* judgement) {
  const CameraModel& camera = fit.camera;
  const double side = std::max(camera.width, camera.height);
  const double focal = std::max(uncertainty.fx / camera.fx, uncertainty.fy / camera.fy);
  const double centre = std::max(uncertainty.cx, uncertainty.cy);
  if (!uncertainty.determined || !std::isfinite(focal)) {
    judgement->reasons.emplace_back("different lenses explain these views equally well");
  } else if (focal > kMostFocalDeviation || centre > kMostCentreDeviation * side) {
    judgement->reasons.push_back("the focal length is known to " + Number("%.2g", 100.0 * focal) +
                                 " % and the centre to " + Number("%.1f", centre) +
                                 " px only: take more views, larger, with more tilt");
  }
  double squares = 0.0, points = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (const Vec2 each : Residuals(camera, fit.camera_from_board[i], views[i])) {
      squares += each.x * each.x + each.y * each.y;
      points += 1.0;
    }
  }
  const double rms = std::sqrt(squares / std::max(points, 1.0));
  if (rms > kMostRmsShare * side) {
    judgement->reasons.push_back(
        "no lens explains what is seen (corners are off by " + Number("%.1f", rms) +
        " px): the board is not as described or not flat, or the lens was zoomed or focused anew "
        "between the views");
  }
}

}  // namespace

ViewJudgement JudgeViews(const LensFit& fit, const std::vector<PlaneView>& views,
                         const ViewCoverage& coverage, const LensUncertainty& uncertainty) {
  ViewJudgement judgement;
  Measure(fit, views, &judgement);
  JudgePlanes(&judgement);
  JudgeCoverage(coverage, &judgement);
  JudgeNumbers(fit, views, uncertainty, &judgement);
  if (views.size() < kGoodViews) {
    judgement.advice.push_back("take more views: " + std::to_string(views.size()) +
                               " are here, 10 to 20 are good");
  }
  return judgement;
}

}  // namespace pleinair::tracker
