#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/units.h"
#include "base/up_axis.h"
#include "base/utc_time.h"
#include "base/vector.h"
#include "scene/camera_description.h"
#include "scene/described_surface.h"
#include "scene/drape_description.h"
#include "scene/leaf_description.h"
#include "scene/trajectory_description.h"
#include "sky/clouds/cloud_layer.h"

namespace pleinair::scene {

/// Cloudiness as an observer on site describes it.
enum class Cloudiness { kClear, kHazy, kPartlyCloudy, kOvercast };

/// Layers of clouds. The sky between them is clear, whatever the word for it.
struct CloudDescription {
  std::vector<clouds::CloudLayer> layers;
  std::optional<Cloudiness> ignored_word;  ///< Stated beside layers.
};

/// Place and start time of the recording.
struct PlaceTime {
  double latitude_deg = 0.0;     ///< North positive, -90…90.
  double longitude_deg = 0.0;    ///< East positive, -180…180.
  double height_m = 0.0;         ///< Above sea level, or above the ellipsoid of WGS 84.
  UtcTime start;                 ///< UTC of the first frame.
  bool above_ellipsoid = false;  ///< What height_m is measured from; else from the sea.
};

/// The reference marker of the scene, or the image target used in its place.
struct MarkerDescription {
  std::optional<std::string> family;  ///< "sg", "tag36h11", …; unset: not specified.
  /// A file made by `pleinair target`. Then family, number and size below are unset.
  std::optional<std::filesystem::path> target;
  std::optional<int> id;       ///< Unset: the marker that is detected in most frames.
  std::optional<int> version;  ///< Layout version, for families that have versions ("sg").
  /// Edge of the outer black square in metres, never that of the paper. 0 with a target.
  double size_m = 0.0;
  /// Azimuth, clockwise from true north, of the marker's +y axis; for an `upright` marker that of
  /// its -z axis (into the wall).
  Radians heading;
  /// False: on level ground, up is +z. True: on a vertical wall, up is +y.
  bool upright = false;
  double albedo_black = 0.04;  ///< Diffuse reflectance of printed black.
  double albedo_white = 0.80;  ///< Diffuse reflectance of the paper.
  double board_size_m = 0.0;   ///< Edge of the white margin around the black square, metres.
  Vec3 offset_m;               ///< Of its origin from [place]: east, north, up.
  double position_sd_m = 0.0;  ///< Of that origin; reported, not used.
};

/// Where the centre of a marker is in the coordinates of the reference marker.
struct AnchorPlace {
  Vec3 translation_m;
  Vec3 rotation_deg;  ///< About the marker's x, then y, then z axis.
};

/// A further marker that does not move against the reference marker.
struct AnchorDescription {
  std::string family;
  int id = 0;
  double size_m = 0.0;               ///< Edge of the outer black square.
  std::optional<AnchorPlace> place;  ///< Unset: found in the film.
};

/// Vertex normals of a model: from its file, per face, or averaged per vertex.
enum class Shading { kFromFile, kFlat, kSmooth };

/// The point of a model that is placed: the origin of its file, or the centre of its bounding box
/// at its lowest height.
enum class ModelOrigin { kFile, kBottomCentre };

/// What a model is made of.
struct ModelSource {
  std::filesystem::path file;
  std::optional<DescribedSurface> surface;  ///< In place of the file.
  std::string name;                         ///< Of a phantom, for drapes; empty: not stated.
};

/// A model placed in marker coordinates: x_marker = R scale x_model + translation. x_model is
/// in metres, relative to `origin`, and upright on the marker.
struct ModelReference : ModelSource {
  Shading shading = Shading::kFromFile;
  /// Axis of the file that points up. Unset: y for glTF; OBJ has the axes of the marker.
  std::optional<UpAxis> up;
  /// Metres of one unit of the file (scene/length_units.h). Unset: the file is in metres.
  std::optional<double> unit_m;
  ModelOrigin origin = ModelOrigin::kFile;
  std::string animation;  ///< Name or number in a glTF file; empty: its pose without one.
  /// Moment of the animation at the scene's time, from which an object plays it. A phantom keeps
  /// it.
  double animation_start_s = 0.0;
  bool loop = false;   ///< Begins again at the end; else the last shape remains.
  Vec3 translation_m;  ///< Of the model's origin, marker coordinates.
  Vec3 rotation_deg;   ///< About the marker's x, then y, then z axis.
  double scale = 1.0;  ///< Enlarges the model about its origin.
};

/// What a scene contains.
struct SceneContent {
  std::vector<ModelReference> phantoms;  ///< Proxy geometry of real surfaces, see
                                         ///< docs/conventions.md.
  std::vector<ModelReference> objects;   ///< Virtual objects.
  std::vector<LeafDescription> leaves;   ///< In place of materials of the objects.
  std::vector<DrapeDescription> drapes;  ///< Maps on the phantoms.

  /// True if there is something to draw into pictures.
  bool DrawsAnything() const { return !objects.empty() || !drapes.empty(); }
};

/// The user's description of the scene: everything that the compositor may use. Holds no ground
/// truth.
struct SceneDescription : SceneContent {
  std::filesystem::path file;  ///< The file it was read from, for messages.
  PlaceTime place_time;
  MarkerDescription marker;
  std::vector<AnchorDescription> anchors;
  std::optional<TrajectoryDescription> trajectory;
  Cloudiness cloudiness = Cloudiness::kClear;
  CloudDescription clouds;
  std::optional<double> turbidity;  ///< Overrides the default of the cloudiness.
  CameraDescription camera;
};

/// Reads the scene from one of three kinds of file, distinguished by content
/// (docs/guide/reference/recordings.md): a scene.json of a rendered recording (its ground truth is
/// not read), a recording.json, or a hand-written scene.toml. Unknown TOML keys are errors with
/// their line. Errors: file missing or truncated; place, time or marker missing; values not finite
/// or out of range; a time without offset; missing model or target files.
Result<SceneDescription> ReadSceneDescription(const std::filesystem::path& file);

}  // namespace pleinair::scene
