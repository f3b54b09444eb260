#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/units.h"
#include "base/utc_time.h"
#include "base/vector.h"

namespace pleinair::devices {

/// The sky in a word, as a person on the spot would say it.
enum class Cloudiness { kClear, kHazy, kPartlyCloudy, kOvercast };

/// Where and when the recording was made.
struct PlaceTime {
  double latitude_deg = 0.0;   ///< North positive.
  double longitude_deg = 0.0;  ///< East positive.
  double height_m = 0.0;       ///< Above sea level.
  UtcTime start;               ///< UTC of the first frame.
};

/// The printed marker that anchors the scene.
struct MarkerDescription {
  std::string family = "tag36h11";
  std::optional<int> id;       ///< Unset: the one marker of the family that is seen most.
  double size_m = 0.0;         ///< Edge of the outer black square, metres.
  Radians heading;             ///< Azimuth, clockwise from true north, of the marker's +y axis.
  /// The paper's "up" in marker coordinates; (0,0,1) for a marker that lies on level ground.
  /// For a marker on a wall, +y is up and `heading` is the azimuth of -z (into the wall).
  bool upright = false;
  double albedo_black = 0.04;  ///< Diffuse reflectance of printed black.
  double albedo_white = 0.80;  ///< Diffuse reflectance of the paper.
  /// Edge of the white board around the black square, metres (1.25 × size where not given).
  double board_size_m = 0.0;
};

enum class Shading { kFromFile, kFlat, kSmooth };

/// A model file placed in marker coordinates.
struct ModelReference {
  std::filesystem::path file;
  Shading shading = Shading::kFromFile;
  Vec3 translation_m;            ///< Of the model's origin, marker coordinates.
  Vec3 rotation_deg;             ///< About x, then y, then z, in degrees (a file's edge).
  double scale = 1.0;            ///< Model units to metres.
};

/// What a person knows of the place: everything the compositor may use. Holds no ground truth.
struct SceneDescription {
  std::filesystem::path file;  ///< Where it was read from, for messages.
  PlaceTime place_time;
  MarkerDescription marker;
  std::vector<ModelReference> phantoms;  ///< Stand-ins for real surfaces.
  std::vector<ModelReference> objects;   ///< Virtual objects.
  Cloudiness cloudiness = Cloudiness::kClear;
  std::optional<double> turbidity;              ///< Overrides the default of the cloudiness.
  std::optional<LinearRgb> exposure_gain;       ///< Overrides the gain measured on the marker.
};

/// Reads `scene.json` (as shared recordings have it; truth blocks are ignored) or `scene.toml`
/// (written by hand; docs/formats.md). Unknown TOML keys are refused with their line.
/// Errors: file missing or cut short, values not finite or out of range, time without offset,
/// models that are not there.
Result<SceneDescription> ReadSceneDescription(const std::filesystem::path& file);

}  // namespace pleinair::devices
