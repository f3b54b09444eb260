#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/frames.h"
#include "base/units.h"

namespace pleinair::accuracy {

/// Edge of the marker's square in every built-in scene.
inline constexpr Metres kMarkerEdge{0.14};
/// Markers have the numbers 0…49, which every compared system supports.
inline constexpr int kNumbers = 50;
/// Content of a marker of any kind: the central square of half the edge. The rest is the border.
inline constexpr double kContentShare = 0.5;

/// An occluder on a marker.
struct OccluderSpec {
  std::string pattern{};  ///< A name from BorderPatterns() or ContentPatterns().
  double share = 0.0;     ///< Of the border, or of the content for content patterns.
  std::string key{};      ///< Occluders with the same key have the same shape.
};

struct MarkerSpec {
  int number = 0;
  Transform<Camera, Marker> camera_from_marker{};
  double side_px = 0.0;   ///< Length of the edge if it were frontal at its distance.
  double tilt_deg = 0.0;  ///< From the line of sight.
  std::optional<OccluderSpec> occluder{};
};

/// A variation of the light across the first marker.
struct LightPattern {
  double angle = 0.0;  ///< Direction in the image, rad.
  Vec2 offset{};       ///< Of its centre, in edges.
  double value = 1.0;  ///< Ratio for a gradient or shadow; per cent of the marker for a glare.
};

struct LensSpec {
  double psf_px = 0.55;     ///< Standard deviation of the lens's Gaussian beside the pixel's box.
  double vignette = 0.25;   ///< Loss of light in the corners, 0…1.
  double defocus_px = 0.0;  ///< Radius of the disc.
};

/// The streak that a moving camera draws of a point.
struct MotionBlur {
  double length_px = 0.0;
  double angle = 0.0;  ///< Direction across the picture, rad.
};

struct SensorNoise {
  double shot = 2e-4;   ///< Variance per unit of light.
  double read = 0.002;  ///< Standard deviation in the dark.
};

/// Light, lens and sensor. Light is linear, 1 saturates.
struct PhotoSpec {
  double light = 1.0;     ///< On the prints.
  double exposure = 1.0;  ///< Of the whole picture.
  LensSpec lens{};
  MotionBlur motion{};
  SensorNoise noise{};
  std::optional<LightPattern> gradient{}, shadow{}, glare{};
  int jpeg_quality = 0;  ///< JPEG quality, 1…100; 0: lossless.
};

/// Content of a frame, independent of the kind of marker.
struct FrameSpec {
  std::string name{};  ///< Unique in a run: "distance_200_003".
  std::string sweep{}, pattern{};
  double level = 0.0;
  int repeat = 0;
  std::vector<MarkerSpec> markers{};
  PhotoSpec photo{};
  std::string background{};  ///< Frames with the same key have the same background.
};

/// Input of a detector without interruption: a single image, or the frames of a video.
struct FrameRun {
  bool film = false;
  std::vector<FrameSpec> frames;
};

}  // namespace pleinair::accuracy
