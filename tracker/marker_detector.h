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

/// A square of a marker's plane about its middle, its sides along the marker's axes.
struct PoseSquare {
  Metres edge{0.0};
  std::array<Vec2, 4> corners_px;  ///< Top-left, then clockwise as the marker is read.
  std::array<double, 64> corner_covariance_px2{};
};

/// A marker whose number has been read and whose corners are known to about half a pixel.
struct Candidate {
  MarkerDetection detection;
  std::shared_ptr<const MarkerPattern> pattern;  ///< The marker that carries this number.
  /// Where the detector has measured the corners itself: their covariance (x before y, corner after
  /// corner; px²); the pattern is then not needed.
  std::optional<std::array<double, 64>> corner_covariance_px2;
  /// What the pose is taken from where the marker itself is no square of the tracker's marker size.
  std::optional<PoseSquare> pose_square;
};

/// One way to find markers. One thread at a time.
class MarkerDetector {
 public:
  virtual ~MarkerDetector() = default;

  /// Markers in one sRGB-encoded grey image of any size, in no particular order; the same
  /// image gives the same list.
  virtual std::vector<Candidate> Detect(ImageView<const std::uint8_t> grey) = 0;

  /// Markers of the frames before that the last image did not show, of detectors that follow.
  virtual std::vector<LostMarker> Lost() const { return {}; }
  /// What the user should know about the last image, in words.
  virtual std::vector<std::string> Warnings() const { return {}; }
};

}  // namespace pleinair::tracker
