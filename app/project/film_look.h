#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/image_size.h"
#include "devices/films/film_tags.h"
#include "session/marker_tracks.h"
#include "tracker/observation.h"

namespace pleinair::app {

/// A lens, and where it is known from.
struct KnownLens {
  CameraModel camera;
  std::string from;  ///< For a comment: "camera.json", "the focal length in the tags of walk.mov".
  std::string note{};  ///< For the user: how the calibration was scaled or turned; else empty.
  bool is_by_trajectory = false;
};

/// The lens assumed for images of this size. The focal length is that of the tags. Without it, it
/// is that of a usual phone: 26 mm on 35 mm film (FocalFrom35mm()). The centre is that of the
/// image; there is no distortion. `file` is the name in `from`. A film is often a crop of what the
/// tags describe: the error is 5 to 20 %.
KnownLens AssumedLens(ImageSize size, const devices::FilmTags& tags, const std::string& file);

/// The markers of one frame, with the edge of each marker as the unit of length.
struct LookedAtFrame {
  std::int64_t index = 0;
  std::vector<tracker::MarkerObservation> markers;
};

/// Markers detected in some frames of a film, or in a photograph.
struct FilmLook {
  std::filesystem::path file;
  bool is_photo = false;
  devices::FilmTags tags;
  KnownLens lens;
  std::int64_t frames = 0;
  std::vector<LookedAtFrame> looked_at;  ///< Spread evenly over all frames.
};

/// Families of the markers to look for: the wanted one, or "sg" and "tag36h11".
std::vector<std::string> FamiliesToLookFor(const std::optional<std::string>& wanted);

/// How to look.
struct LookOptions {
  std::optional<KnownLens> lens;        ///< In place of AssumedLens(); FitCamera() fits it.
  std::optional<std::string> family{};  ///< In place of "sg" and "tag36h11".
  /// True if the marker may be in view for a second only: eight times as many frames are looked at.
  bool is_marker_rare = false;
};

/// Opens a film or a photograph and reads its tags, without a search for markers. Errors: those of
/// OpenVideo() and InspectImage().
Result<FilmLook> ReadTags(const std::filesystem::path& file);

/// Detects markers in at most 12 frames of a film, or in a photograph. Large frames are
/// fewer: together they have some 25 million pixels. Errors: those of OpenVideo() and
/// DecodeImageFile(); those of FitCamera(); an unknown family of markers. Error (system):
/// interrupted.
Result<FilmLook> LookAt(const std::filesystem::path& file, const LookOptions& options);

/// The marker of a scene, as the frames show it.
struct ChosenMarker {
  session::MarkerName name;
  int frames = 0;               ///< Looked-at frames that show it.
  std::int64_t best_frame = 0;  ///< Where it is largest and least covered.
  double best_edge_px = 0.0;    ///< Mean edge there, in pixels.
  std::vector<session::MarkerName> others;
  bool is_stated = false;     ///< The user named it.
  std::size_t looked_at = 0;  ///< Frames in which markers were searched for.
};

/// Chooses the marker that most of the frames show, or `wanted`. Nothing: no frame shows it.
std::optional<ChosenMarker> ChooseMarker(const FilmLook& look,
                                         const std::optional<session::MarkerName>& wanted);

/// Mean edge of a marker in the image, in pixels.
double EdgeOf(const tracker::MarkerDetection& marker);

}  // namespace pleinair::app
