#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/image.h"
#include "base/vector.h"
#include "compositor/models/model_frame.h"
#include "scene/leaf_contents.h"

namespace pleinair::compositor {

/// Normal reflectance of a clear coat with a refractive index of 1.5 (glTF 2.0, appendix B.2).
inline constexpr float kDielectricF0 = 0.04F;

/// The dielectric (glass-like) layer of a material.
struct DielectricCoat {
  float f0 = 0.0F;  ///< Normal reflectance; 0 is purely diffuse.
  /// Fraction of the base color's reflected light that the coat transmits. MTL adds `Ks` to `Kd`.
  /// glTF mixes them (specification 2.0, appendix B.3), here by the coat's normal reflectance.
  float base_share = 1.0F;
};

/// Coordinates of a texture from those of a mesh: matrix (u, v) + offset.
struct TextureCoordinates {
  bool second_set = false;                  ///< From VertexDetail::uv, else from Mesh::uvs.
  std::array<float, 4> matrix{1, 0, 0, 1};  ///< Row-major.
  std::array<float, 2> offset{};
};

/// Bumps of a surface (glTF 2.0, section 3.9.3): red to the right in the texture, green upwards,
/// blue outwards.
struct NormalMap {
  int texture = -1;    ///< Index into Model::textures, -1 for none; linear.
  float scale = 1.0F;  ///< Multiplies red and green.
  TextureCoordinates coordinates;
};

/// Light that a surface emits.
struct Emission {
  std::array<float, 3> luminance_cd_m2{};  ///< Linear Rec.709.
  int texture = -1;                        ///< Index into Model::textures, -1 for none; sRGB.
  TextureCoordinates coordinates;
};

/// Light that a thin open surface scatters to its other side (KHR_materials_diffuse_transmission).
struct DiffuseTransmission {
  std::array<float, 3> color{};  ///< Transmittance, linear Rec.709; black: none.
  /// Multiplies the color: index into Model::textures, -1 for none; sRGB. It takes the place of an
  /// emission texture.
  int texture = -1;
  TextureCoordinates coordinates;
};

/// A leaf whose colors follow from its pigments (compositor/models/leaf_material.h).
struct LeafSurface {
  scene::Leaf leaf;
  float gloss = 1.0F;       ///< Strength of the lobe; 0…4.
  float roughness = 0.35F;  ///< γ of shaders/leaf_gloss.glsl; 0.05…1.
};

/// Layers over a material's base, and the tint of its coat (KHR_materials_specular, _clearcoat,
/// _sheen).
struct MaterialLayers {
  std::array<float, 3> coat_tint{1, 1, 1};  ///< Multiplies DielectricCoat::f0.
  float clearcoat = 0.0F, clearcoat_roughness = 0.0F;
  std::array<float, 3> sheen_color{};
  float sheen_roughness = 0.0F;
  bool operator==(const MaterialLayers&) const = default;
};

/// The less common properties of a material.
struct MaterialDetail {
  NormalMap normal_map;
  Emission emission;
  TextureCoordinates metallic_roughness_coordinates;
  MaterialLayers layers;
  bool unlit = false;  ///< Shown in its own color, whatever the light (KHR_materials_unlit).
  DiffuseTransmission transmission;
  /// Then the material's colors are those under D65, and its roughness scales the gloss.
  std::optional<LeafSurface> leaf;

  bool Transmits() const { return transmission.color != std::array<float, 3>{}; }
};

/// A surface material, metallic–roughness; colors linear Rec.709.
struct Material {
  /// Meaning of the alpha of base color and texture, as in glTF: none; a hole below `alpha_cutoff`;
  /// the hidden fraction of the background.
  enum class Alpha { kIgnored, kCutout, kBlended };

  std::string name;
  std::array<float, 3> base_color{0.8F, 0.8F, 0.8F};
  float opacity = 1.0F;  ///< Alpha of the base color.
  Alpha alpha = Alpha::kCutout;
  float alpha_cutoff = 0.5F;
  float metallic = 0.0F;
  float roughness = 1.0F;
  DielectricCoat coat;
  int base_color_texture = -1;  ///< Index into Model::textures, -1 for none.
  /// Index as above; green scales roughness, blue scales metallic, both linear.
  int metallic_roughness_texture = -1;
  MaterialDetail detail;
  /// Unsupported features of the file's material, as user messages: "normal maps".
  std::set<std::string> unsupported_features;
};

/// A surface with holes has two meshes in a model. The render-only mesh is whole, because alpha
/// draws the holes. The shadow-only mesh has the holes cut out (compositor/models/alpha_cutout.h).
enum class MeshRole { kAll, kRenderOnly, kShadowOnly };

/// Further attributes of a vertex.
struct VertexDetail {
  std::array<float, 2> uv{};               ///< Second set of texture coordinates.
  std::array<float, 4> color{1, 1, 1, 1};  ///< Multiplies the base color and its alpha.
  bool operator==(const VertexDetail&) const = default;
};

/// Half way between two vertices.
VertexDetail Middle(const VertexDetail& a, const VertexDetail& b);

/// Three corners per triangle. Materials need not share vertices.
struct Mesh {
  std::string name;
  int material = 0;
  MeshRole role = MeshRole::kAll;
  std::vector<std::array<float, 3>> positions;  ///< Metres, model coordinates.
  std::vector<std::array<float, 3>> normals;    ///< Unit, one per position.
  std::vector<std::array<float, 2>> uvs;        ///< Empty, or one per position; v down.
  std::vector<VertexDetail> details;            ///< Empty, or one per position.
  std::vector<std::uint32_t> indices;  ///< Three per triangle, counter-clockwise from outside.
};

/// An animation in a file.
struct AnimationInFile {
  std::string name;         ///< May be empty.
  double duration_s = 0.0;  ///< As the file states it.
};

/// A loaded model: indexed triangle meshes with their materials and textures.
struct Model {
  enum class Format { kObj, kGltf };

  std::filesystem::path file;
  Format format = Format::kObj;
  /// The program that wrote the file, by its own words: the first comment of an OBJ, the generator
  /// of a glTF. Empty if absent.
  std::string written_by;
  /// Added to all positions. Zero, except for coordinates of which single precision would lose
  /// half a millimetre: those of a survey.
  Vec3 origin_m;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Image<std::uint8_t>> textures;  ///< As in the file, 3 or 4 channels.
  std::vector<AnimationInFile> animations;    ///< Those that a scene may name.
  /// Unsupported features of the file besides its materials, as user messages: "animations".
  std::set<std::string> unsupported_features;
};

/// Values of `unsupported_features`.
inline constexpr const char* kPointsAndLines = "points and lines";

/// All unsupported features of a model and of its used materials, as ordered user messages.
/// docs/guide/reference/models.md lists what is supported.
std::set<std::string> UnsupportedFeatures(const Model& model);

enum class NormalsMode { kFromFile, kFlat, kSmooth };

struct ModelOptions {
  NormalsMode normals = NormalsMode::kFromFile;  ///< kFromFile: flat where the file has none.
  /// If true, glass counts as opaque. Phantoms need it, because they are often modelled transparent
  /// to show the real surface behind them.
  bool opaque_glass = false;
  ModelFrame frame;
};

/// Loads OBJ (with its MTL) or glTF 2.0 (.gltf/.glb); the content decides the format.
///
/// Without a frame in `options`, both formats are in metres. OBJ defines no axes; its coordinates
/// are used unchanged. glTF is y-up with the front towards +z. Its axes are rotated to z-up: x to
/// x, y to z and z to −y. Upright glTF models thus stay upright, and their front faces −y. Without
/// a placement, x points to the marker's right, y to its upper edge and z out of the marker.
///
/// Limits keep hostile files from exhausting memory: 20 M vertices, textures of 16384 × 16384.
/// Errors: missing or cut short, indices out of range, values not finite, textures missing, too
/// large or unreadable. Each error names the file and, for text, the line.
Result<Model> LoadModel(const std::filesystem::path& file, const ModelOptions& options = {});

}  // namespace pleinair::compositor
