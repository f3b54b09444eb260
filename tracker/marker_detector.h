#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/units.h"
#include "tracker/marker_pattern.h"
#include "tracker/observation.h"

namespace pleinair::tracker {

/// A square in a marker's plane around its centre, with sides along the marker's axes.
struct PoseSquare {
  Metres edge{0.0};
  std::array<Vec2, 4> corners_px;  ///< Clockwise from top-left, on the upright marker.
  std::array<double, 64> corner_covariance_px2{};
};

/// A detected marker, with its id if it could be decoded; corners accurate to about half a pixel.
struct Candidate {
  MarkerDetection detection;
  /// Bit pattern of the marker with this id; null if the detector has measured the corners.
  std::shared_ptr<const MarkerPattern> pattern;
  /// Covariance of the corners if the detector has measured them itself (x before y, corner after
  /// corner; px²). The pattern is then not needed.
  std::optional<std::array<double, 64>> corner_covariance_px2;
  /// Square used for the pose if the marker itself is not a square of the tracker's marker size.
  std::optional<PoseSquare> pose_square;
};

/// Interface of marker detectors. One thread at a time.
class MarkerDetector {
 public:
  virtual ~MarkerDetector() = default;

  /// Markers in one sRGB-encoded grey image of any size, in no particular order. Deterministic.
  virtual std::vector<Candidate> Detect(ImageView<const std::uint8_t> grey) = 0;

  /// Markers of previous frames that were not detected in the last image; for tracking detectors.
  virtual std::vector<LostMarker> Lost() const { return {}; }
  /// Warnings for the user about the last image.
  virtual std::vector<std::string> Warnings() const { return {}; }
};

}  // namespace pleinair::tracker
