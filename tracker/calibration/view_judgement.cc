#include "tracker/calibration/view_judgement.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/units.h"

namespace pleinair::tracker {
namespace {

// Views beyond these limits are rejected. Carefully taken photographs are far within them.
constexpr double kMinShare = 0.25;
constexpr double kMinHalf = 0.12;
constexpr double kMaxFocalDeviation = 0.01;   // Relative.
constexpr double kMaxCentreDeviation = 0.02;  // Relative to the image's longer side.
constexpr double kMaxRmsShare = 0.005;        // Relative to the image's longer side: 3 px of 640.
// Common error of the corners of one view: this, or this share of their own noise.
constexpr double kCommonError_px = 0.05;
constexpr double kCommonShare = 0.5;
constexpr double kCornersOfAView = 4.0;
// Thresholds for the explanation when views do not determine the focal length.
constexpr double kLittleTilt_deg = 12.0;
constexpr double kLittleDepthRatio = 1.12;
// Thresholds for the advice.
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
  double nearest_middle = nearest, max_middle_distance = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Transform<Camera, Marker>& pose = fit.camera_from_board[i];
    const auto normal = [&](std::size_t view) {
      const Mat3& r = fit.camera_from_board[view].rotation;
      return Vec3{r(0, 2), r(1, 2), r(2, 2)};
    };
    const auto degrees = [](double cosine) {
      return std::acos(std::clamp(std::fabs(cosine), 0.0, 1.0)) / kRadiansPerDegree;
    };
    judgement->max_tilt_deg = std::max(judgement->max_tilt_deg, degrees(normal(i).z));
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
    max_middle_distance = std::max(max_middle_distance, pose.translation_m.z);
  }
  judgement->depth_ratio = farthest / nearest;
  judgement->distance_ratio = max_middle_distance / nearest_middle;
}

/// Change of the solution for errors of whole views.
void Deviate(const LensFit& fit, const std::vector<PlaneView>& views,
             const LensUncertainty& uncertainty, ViewJudgement* judgement) {
  const CameraModel& camera = fit.camera;
  judgement->focal_deviation = judgement->centre_deviation =
      std::numeric_limits<double>::infinity();
  if (!uncertainty.determined || !(uncertainty.assumed_px > 0.0)) return;
  double corners = 0.0;
  for (const PlaneView& view : views) corners += static_cast<double>(view.observed_px.size());
  const double common_px = std::max(kCommonError_px, kCommonShare * uncertainty.noise_px);
  const double by =
      common_px / uncertainty.assumed_px *
      std::sqrt(std::max(corners / (kCornersOfAView * static_cast<double>(views.size())), 1.0));
  const double focal = std::max(uncertainty.fx / camera.fx, uncertainty.fy / camera.fy);
  const double side = std::max(camera.width, camera.height);
  const double centre = std::max(uncertainty.cx, uncertainty.cy) / side;
  if (std::isfinite(focal)) judgement->focal_deviation = focal * by;
  if (std::isfinite(centre)) judgement->centre_deviation = centre * by;
}

std::string WhatLacks(const ViewJudgement& judgement) {
  std::string lacks = "tilt the board about both axes of the image, and take more views, larger";
  if (judgement.max_tilt_deg < kLittleTilt_deg) {
    lacks = "the camera looks straight at the board in every view (tilted by at most " +
            Number("%.1f", judgement.max_tilt_deg) +
            " degrees): tilt the board by 20 to 45 degrees, in several directions";
  } else if (judgement.widest_apart_deg < kLittleTilt_deg) {
    lacks = "the board stands the same way in every view (to " +
            Number("%.1f", judgement.widest_apart_deg) + " degrees): tilt it in several directions";
  }
  if (judgement.max_tilt_deg < kLittleTilt_deg && judgement.depth_ratio < kLittleDepthRatio) {
    lacks += ", and all views are at one distance (to " +
             Number("%.0f", 100.0 * (judgement.depth_ratio - 1.0)) + " %): come nearer in some";
  }
  return lacks;
}

void JudgePlanes(ViewJudgement* judgement) {
  if (!(judgement->focal_deviation <= kMaxFocalDeviation) ||
      !(judgement->centre_deviation <= kMaxCentreDeviation)) {
    const bool open = !(judgement->focal_deviation < 1.0);
    judgement->reasons.push_back(
        (open ? std::string("the focal length is undetermined")
              : "the focal length is known to " +
                    Number("%.2g", 100.0 * judgement->focal_deviation) + " % and the centre to " +
                    Number("%.2g", 100.0 * judgement->centre_deviation) + " % of the image only") +
        ": " + WhatLacks(*judgement));
    return;
  }
  if (judgement->max_tilt_deg < kGoodTilt_deg) {
    judgement->advice.push_back("tilt the board more: " + Number("%.0f", judgement->max_tilt_deg) +
                                " degrees are the most, 20 to 45 are good");
  }
  if (judgement->distance_ratio < kGoodDistanceRatio) {
    judgement->advice.emplace_back("take some views from nearer and some from farther");
  }
}

void JudgeCoverage(const ViewCoverage& coverage, ViewJudgement* judgement) {
  constexpr const char* kHalves[] = {"left", "right", "upper", "lower"};
  const std::array<double, 4> halves = coverage.Halves();
  std::string bare, thin;
  for (std::size_t i = 0; i < halves.size(); ++i) {
    std::string* list = halves[i] < kMinHalf ? &bare : halves[i] < kGoodHalf ? &thin : nullptr;
    if (list != nullptr) *list += (list->empty() ? "" : ", ") + std::string(kHalves[i]);
  }
  const std::string share = Number("%.0f", 100.0 * coverage.Share()) + " % of the image";
  if (coverage.Share() < kMinShare || !bare.empty()) {
    judgement->reasons.push_back("the board covers only " + share +
                                 (bare.empty() ? "" : ", next to nothing of its half: " + bare) +
                                 "; the lens's distortion elsewhere would be a guess: take the "
                                 "board to every edge and corner of the image");
  } else if (coverage.Share() < kGoodShare || !thin.empty()) {
    judgement->advice.push_back("the board covers " + share +
                                (thin.empty() ? "" : ", little of its half: " + thin) +
                                ": take it to every edge and corner");
  }
}

void JudgeResiduals(const LensFit& fit, const std::vector<PlaneView>& views,
                    ViewJudgement* judgement) {
  const CameraModel& camera = fit.camera;
  const double side = std::max(camera.width, camera.height);
  double squares = 0.0, points = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (const Vec2 each : Residuals(camera, fit.camera_from_board[i], views[i])) {
      squares += each.x * each.x + each.y * each.y;
      points += 1.0;
    }
  }
  const double rms = std::sqrt(squares / std::max(points, 1.0));
  if (rms > kMaxRmsShare * side) {
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
  Deviate(fit, views, uncertainty, &judgement);
  JudgePlanes(&judgement);
  JudgeCoverage(coverage, &judgement);
  JudgeResiduals(fit, views, &judgement);
  if (views.size() < kGoodViews) {
    judgement.advice.push_back("take more views: " + std::to_string(views.size()) +
                               " are here, 10 to 20 are good");
  }
  return judgement;
}

}  // namespace pleinair::tracker
