#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/vector.h"

namespace pleinair::scene {

struct SceneContent;

/// The features of a map file that are draped.
struct MapSource {
  std::filesystem::path file;
  std::string layer;  ///< Empty: every layer.
  std::string where;  ///< An attribute filter in the SQL of OGR, "status = 'new'"; empty: none.
  /// Coordinate reference system in place of the file's, or kMarkerCrs; empty: that of the file.
  std::string crs;
};
/// In place of a coordinate reference system: the coordinates are metres of the marker.
inline constexpr const char* kMarkerCrs = "marker";

/// How ink meets the light of a surface.
enum class InkBlend {
  kStain,  ///< Colors the image of the surface: its texture and shadows stay.
  kPaint,  ///< Is lit as a surface of its own.
  kGlow,   ///< Is the color as it is.
};

/// What is drawn of ink that real surfaces hide.
enum class HiddenInk { kHide, kGhost };

/// The look of draped lines and areas.
struct InkDescription {
  double line_width = 0.15;
  bool width_in_px = false;  ///< Else in metres.
  LinearRgb color{0.6308, 0.0144, 0.0052};
  std::string color_field;        ///< An attribute with a color; empty: `color` counts.
  std::optional<LinearRgb> fill;  ///< Of areas; unset: their outline alone.
  double opacity = 1.0;
  /// Lengths of dash and gap along the draped line, metres; unset: without gaps.
  std::optional<std::array<double, 2>> dash_m;
  InkBlend blend = InkBlend::kStain;
  HiddenInk hidden = HiddenInk::kHide;
};

/// How the heights of a layer are found.
enum class DrapeSearch {
  kAuto,    ///< Exactly, on the screen only where surfaces change with each image.
  kExact,   ///< On the triangles of the surfaces.
  kScreen,  ///< On the surfaces as the camera sees them, in each image.
};

/// A map file on the phantoms of the scene.
struct DrapeDescription {
  std::string where;  ///< "scene.toml:12", for messages.
  MapSource source;
  InkDescription ink;
  std::string on = "top";  ///< kOnTop, kOnLowest or the name of a phantom.
  double offset_m = 0.0;   ///< Above the surface, along the vertical.
  /// An attribute with metres that are added to `offset_m`, or kOwnHeights; empty: none.
  std::string height_field;
  DrapeSearch search = DrapeSearch::kAuto;
};
inline constexpr const char* kOnTop = "top";
inline constexpr const char* kOnLowest = "lowest";
/// In place of an attribute: the lines have the heights of the file and are not draped.
inline constexpr const char* kOwnHeights = "z";

inline constexpr std::size_t kMaxDrapes = 64;

/// "#d02010" as a color, and back to the nearest such text. Nothing: it is none.
std::optional<LinearRgb> ParseHexColor(const std::string& text);
std::string HexColor(const LinearRgb& color);

/// Words of scenes.
const char* NameOf(InkBlend blend);
const char* NameOf(HiddenInk hidden);
const char* NameOf(DrapeSearch search);

/// The phantoms that a drape may name, in order: by name, of described surfaces ("ground", "box
/// 1"), or the name of the model's file without its ending.
std::vector<std::string> NamesOfPhantoms(const SceneContent& scene);

/// Makes the paths of drapes relative to `folder`. Error (input): `on` is no rule and no phantom.
Result<void> CompleteDrapes(const std::filesystem::path& folder, SceneContent* scene);

}  // namespace pleinair::scene
