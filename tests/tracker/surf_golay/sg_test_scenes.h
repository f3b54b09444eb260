#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "tests/tracker/marker_rendering.h"
#include "tracker/tracker.h"

namespace pleinair::tracker {

/// A pinhole camera with its axis through the image centre.
CameraModel SgCamera(int width = 320, int height = 240, double focal_px = 400.0);

/// Marker `number`, whose edge would be `side_px` long without tilt (see PoseAtPixel).
RenderedMarker SgMarkerAt(const CameraModel& camera, int number, Vec2 centre_px, double side_px,
                          double tilt_deg = 0.0, double axis_deg = 0.0, double roll_deg = 0.0);

struct SgTrackerOptions {
  SgStrategy strategy = SgStrategy::kHybrid;
  std::vector<int> numbers_in_use{};
  bool consecutive_frames = false;
};

/// A tracker for S-G markers of the size that SgMarkerAt uses.
std::unique_ptr<Tracker> MakeSgTracker(const CameraModel& camera,
                                       const SgTrackerOptions& options = {});

/// The tracker's observations in an image; the test fails on an error.
std::vector<MarkerObservation> Track(Tracker* tracker, const GreyImage& image);

/// RMS distance of a detection's corners from the truth, px.
double CornerRms(const MarkerObservation& observation, const std::array<Vec2, 4>& truth);

/// Angle between two rotations.
double RotationApart_deg(const Mat3& a, const Mat3& b);

/// "[17 surf-golay at 81,70 60 %]": summary of observations for test messages.
std::string Summary(const std::vector<MarkerObservation>& observations);

/// True if a cell of the code is white in the marker of that number.
bool IsWhite(int number, int cell);

/// Converts a point of the marker (half edges, y up) to modules of the black square from its
/// top-left.
Vec2 ModulesOf(Vec2 at);

}  // namespace pleinair::tracker
