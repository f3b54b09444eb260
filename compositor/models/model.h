#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/image.h"

namespace pleinair::compositor {

/// Normal reflectance of a clear coat with a refractive index of 1.5 (glTF 2.0, appendix B.2).
inline constexpr float kDielectricF0 = 0.04F;

/// The layer of a material that reflects like glass.
struct DielectricCoat {
  float f0 = 0.0F;  ///< Normal reflectance; 0 is purely diffuse.
  /// What the coat leaves of the light that the base color reflects. MTL adds `Ks` to `Kd`; glTF
  /// mixes them (specification 2.0, appendix B.3), here by the coat's normal reflectance.
  float base_share = 1.0F;
};

/// A surface material, metallic–roughness; colors linear Rec.709.
struct Material {
  /// What the alpha of base color and texture means, as in glTF: nothing; where it is below
  /// `alpha_cutoff`, a hole; how much of what lies behind is hidden.
  enum class Alpha { kIgnored, kCutout, kBlended };

  std::string name;
  std::array<float, 3> base_color{0.8F, 0.8F, 0.8F};
  float opacity = 1.0F;  ///< Alpha of the base color.
  Alpha alpha = Alpha::kCutout;
  float alpha_cutoff = 0.5F;
  float metallic = 0.0F;
  float roughness = 1.0F;
  DielectricCoat coat;
  bool double_sided = false;
  int base_color_texture = -1;  ///< Index into Model::textures, -1 for none.
  /// The same; green times roughness, blue times metallic, both linear.
  int metallic_roughness_texture = -1;
  /// What the file says of it that is not drawn, in words: "normal maps".
  std::set<std::string> unsupported_features;
};

/// A surface with holes stands in a model twice: as it is drawn, where alpha tells the holes, and
/// as light and shadows meet it, with the holes cut out (compositor/models/alpha_cutout.h).
enum class MeshRole { kAll, kRenderOnly, kShadowOnly };

/// Three corners a triangle, no sharing of vertices between materials required.
struct Mesh {
  std::string name;
  int material = 0;
  MeshRole role = MeshRole::kAll;
  std::vector<std::array<float, 3>> positions;  ///< Metres, model coordinates.
  std::vector<std::array<float, 3>> normals;    ///< Unit, one a position.
  std::vector<std::array<float, 2>> uvs;        ///< Empty, or one a position; v down.
  std::vector<std::uint32_t> indices;           ///< Three a triangle, counter-clockwise outside.
};

/// A loaded model: indexed triangle meshes with their materials and textures.
struct Model {
  std::filesystem::path file;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Image<std::uint8_t>> textures;  ///< As in the file, 3 or 4 channels.
  /// What the file has besides its materials that is not drawn, in words: "animations".
  std::set<std::string> unsupported_features;
};

/// Among what is left out.
inline constexpr const char* kVertexColors = "colours of vertices";
inline constexpr const char* kPointsAndLines = "points and lines";

/// All that a model's file has and that is not drawn, of materials that are in use, in words and
/// ordered. For the user to know: docs/guide/reference/recordings.md says what is read.
std::set<std::string> UnsupportedFeatures(const Model& model);

enum class NormalsMode { kFromFile, kFlat, kSmooth };

struct ModelOptions {
  NormalsMode normals = NormalsMode::kFromFile;  ///< kFromFile: flat where the file has none.
  /// Whether glass is taken for opaque: of phantoms, which are often made seen through to see what
  /// they stand for.
  bool opaque_glass = false;
};

/// Loads OBJ (with its MTL) or glTF 2.0 (.gltf/.glb), by content.
///
/// Axes: OBJ states none and its coordinates are taken as they are, z up. glTF is y-up with the
/// front towards +z; its axes are turned into ours, x to x, y to z and z to −y, so that what
/// stands upright in a glTF file stands upright here and its front looks towards −y. Unplaced,
/// x points to the marker's right, y to its upper edge and z out of the marker. Both are in metres.
///
/// Limits keep hostile files from
/// exhausting memory: 20 M vertices, textures of 16384 × 16384.
/// Errors: missing or cut short, indices out of range, values not finite, textures missing,
/// too large or unreadable: each names the file and, for text, the line.
Result<Model> LoadModel(const std::filesystem::path& file, const ModelOptions& options = {});

}  // namespace pleinair::compositor
