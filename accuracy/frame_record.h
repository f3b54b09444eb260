#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/frames.h"
#include "base/vector.h"

namespace pleinair::accuracy {

enum class Outcome {
  kHit,        ///< Right number, corners where they are.
  kMisplaced,  ///< Right number, corners elsewhere.
  kMissed,
};

/// What a detector says of the pose of a marker that it hit, against the truth.
struct PoseRecord {
  Transform<Camera, Marker> camera_from_marker{};
  double rotation_error_deg = 0.0;
  double translation_error_m = 0.0;
  /// Normalised estimation error squared: eᵀ C⁻¹ e with the detector's covariance C of its six
  /// errors e (tracker/observation.h), where it gives one.
  std::optional<double> nees{};
  double ambiguity_ratio = 0.0;  ///< 0 where there was no second solution.
  /// Rotation error of the second solution, where there is one.
  std::optional<double> alternative_error_deg{};
};

/// One marker that stands in a frame.
struct MarkerRecord {
  int number = 0;
  Transform<Camera, Marker> true_camera_from_marker{};
  std::array<Vec2, 4> true_corners_px{};
  double border_covered = 0.0, content_covered = 0.0;
  Outcome outcome = Outcome::kMissed;
  std::array<Vec2, 4> corner_error_px{};  ///< Found less true; of hits and of misplaced ones.
  double visible_fraction = 1.0;
  std::string path{};                ///< Which way it was found, where the detector says.
  std::optional<PoseRecord> pose{};  ///< Of hits.

  double CornerRms() const;
  double TrueEdge() const;  ///< Mean length of the square's sides in the picture, px.
};

/// One frame under one detector.
struct FrameRecord {
  std::int64_t frame = 0;  ///< Place in the run's list of frames.
  std::string name{};
  std::string sweep{}, pattern{};
  double level = 0.0;
  int repeat = 0;
  std::string detector{};
  /// The truth was known up to a rigid motion of all of it, and that was chosen to fit.
  bool truth_aligned = false;
  std::vector<MarkerRecord> markers{};
  int false_numbers = 0;  ///< Reported and not there, or reported again.
  int lost = 0;           ///< Markers that the detector says it has lost.
  std::vector<std::pair<std::string, double>> stages_ms{};
};

/// The sweep that frames of recordings are said to be of.
inline constexpr const char* kRecordingSweep = "recording";

/// Whether a frame is one of a film: the marker is followed from the frame before.
bool IsFilm(const FrameRecord& record);

/// A rotation error beyond this is a flip to the other planar pose, or worse.
inline constexpr double kFlip_deg = 15.0;

}  // namespace pleinair::accuracy
