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
  kHit,        ///< Right number, right corners.
  kMisplaced,  ///< Right number, wrong corners.
  kMissed,
};

/// A detector's pose of a marker that it hit, compared with the ground truth.
struct PoseRecord {
  Transform<Camera, Marker> camera_from_marker{};
  double rotation_error_deg = 0.0;
  double translation_error_m = 0.0;
  /// Normalised estimation error squared: eᵀ C⁻¹ e with the detector's covariance C of its six
  /// errors e (tracker/observation.h), if it reports one.
  std::optional<double> nees{};
  double ambiguity_ratio = 0.0;  ///< 0 if there was no second solution.
  /// Rotation error of the second solution, if there is one.
  std::optional<double> alternative_error_deg{};
};

/// Result for one marker of a frame.
struct MarkerRecord {
  int number = 0;
  Transform<Camera, Marker> true_camera_from_marker{};
  std::array<Vec2, 4> true_corners_px{};
  double border_covered = 0.0, content_covered = 0.0;
  Outcome outcome = Outcome::kMissed;
  std::array<Vec2, 4> corner_error_px{};  ///< Found less true; for hits and misplaced markers.
  double visible_fraction = 1.0;
  std::string path{};                ///< Detection method, if reported.
  std::optional<PoseRecord> pose{};  ///< For hits.

  double CornerRms() const;
  double TrueEdge() const;  ///< Mean length of the square's sides in the image, px.
};

/// Result of one detector for one frame.
struct FrameRecord {
  std::int64_t frame = 0;  ///< Position in the run's list of frames.
  std::string name{};
  std::string sweep{}, pattern{};
  double level = 0.0;
  int repeat = 0;
  std::string detector{};
  /// The ground truth was known up to a global rigid transform, which was fitted.
  bool truth_aligned = false;
  std::vector<MarkerRecord> markers{};
  int false_numbers = 0;  ///< Reported but not in the frame, or reported twice.
  int lost = 0;           ///< Markers that the detector reports as lost.
  std::vector<std::pair<std::string, double>> stages_ms{};
};

/// Sweep name of frames of recordings.
inline constexpr const char* kRecordingSweep = "recording";

/// True for frames of a video, in which markers are tracked from frame to frame.
bool IsFilm(const FrameRecord& record);

/// A larger rotation error is a flip to the other planar pose, or worse.
inline constexpr double kFlip_deg = 15.0;

}  // namespace pleinair::accuracy
