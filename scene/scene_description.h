#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/units.h"
#include "base/utc_time.h"
#include "base/vector.h"

namespace pleinair::scene {

/// The sky in a word, as a person on the spot would say it.
enum class Cloudiness { kClear, kHazy, kPartlyCloudy, kOvercast };

/// Where and when the recording was made.
struct PlaceTime {
  double latitude_deg = 0.0;   ///< North positive, -90…90.
  double longitude_deg = 0.0;  ///< East positive, -180…180.
  double height_m = 0.0;       ///< Above sea level.
  UtcTime start;               ///< UTC of the first frame.
};

/// The printed marker that anchors the scene, or the image that takes its place.
struct MarkerDescription {
  std::optional<std::string> family;  ///< "sg", "tag36h11", …; unset: nobody said.
  /// A file that `pleinair target` made; then it has no family, number or size of its own.
  std::optional<std::filesystem::path> target;
  std::optional<int> id;       ///< Unset: the one marker that is seen most.
  std::optional<int> version;  ///< Of the print, where the family has versions ("sg").
  /// Edge of the outer black square, metres; never the paper's. 0 with a target.
  double size_m = 0.0;
  /// Azimuth, clockwise from true north, of the marker's +y axis; of its -z axis (into the wall)
  /// where the marker is `upright`.
  Radians heading;
  /// False: it lies on level ground, up is +z. True: it hangs on a plumb wall, up is +y.
  bool upright = false;
  double albedo_black = 0.04;  ///< Diffuse reflectance of printed black.
  double albedo_white = 0.80;  ///< Diffuse reflectance of the paper.
  double board_size_m = 0.0;   ///< Edge of the white board around the black square, metres.
};

/// Normals of a model: as its file has them, one a face, or one a vertex.
enum class Shading { kFromFile, kFlat, kSmooth };

/// A model file placed in marker coordinates: x_marker = R scale x_model + translation.
struct ModelReference {
  std::filesystem::path file;
  Shading shading = Shading::kFromFile;
  Vec3 translation_m;  ///< Of the model's origin, marker coordinates.
  Vec3 rotation_deg;   ///< About the marker's x, then y, then z axis, in degrees.
  double scale = 1.0;  ///< Model units to metres.
};

/// What a person knows of the place: everything the compositor may use. Holds no ground truth.
struct SceneDescription {
  std::filesystem::path file;  ///< Where it was read from, for messages.
  PlaceTime place_time;
  MarkerDescription marker;
  std::vector<ModelReference> phantoms;  ///< Stand-ins for real surfaces.
  std::vector<ModelReference> objects;   ///< Virtual objects.
  Cloudiness cloudiness = Cloudiness::kClear;
  std::optional<double> turbidity;          ///< Overrides the default of the cloudiness.
  std::optional<LinearRgb> exposure_scale;  ///< Overrides the gain measured on the marker.
  std::filesystem::path
      camera_response;  ///< File (devices/calibration/response_file.h); empty: sRGB.
};

/// Reads a scene.json of a rendered recording (its ground truth is not looked at), what a
/// recording.json says of the scene, or a scene.toml written by hand
/// (docs/guide/reference/recordings.md). Told apart by content. Unknown TOML keys are refused with
/// their line. Errors: file missing or cut short, place, time or marker missing, values not finite
/// or out of range, a time without offset, models or a target that are not there.
Result<SceneDescription> ReadSceneDescription(const std::filesystem::path& file);

}  // namespace pleinair::scene
