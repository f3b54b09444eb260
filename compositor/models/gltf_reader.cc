#include "compositor/models/gltf_reader.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <set>
#include <utility>

#include "base/vector.h"
#include "compositor/models/gltf_accessor.h"
#include "compositor/models/gltf_compression.h"
#include "compositor/models/gltf_error.h"
#include "compositor/models/gltf_files.h"
#include "compositor/models/gltf_materials.h"
#include "compositor/models/gltf_placement.h"
#include "compositor/models/gltf_skin.h"
#include "compositor/models/gltf_texture_transform.h"
#include "compositor/models/model_limits.h"

namespace pleinair::compositor {
namespace {

constexpr const char* kUnchosenAnimations = "animations";

/// Extensions that a file may require and that change nothing the reader supports.
const std::set<std::string>& KnownExtensions() {
  static const std::set<std::string> known = {"KHR_materials_specular",
                                              "KHR_materials_ior",
                                              "KHR_materials_clearcoat",
                                              "KHR_materials_sheen",
                                              "KHR_materials_volume",
                                              "KHR_materials_transmission",
                                              "KHR_materials_unlit",
                                              "KHR_materials_emissive_strength",
                                              "KHR_mesh_quantization",
                                              "KHR_lights_punctual",
                                              "KHR_texture_transform",
                                              "EXT_texture_webp",
                                              "KHR_materials_diffuse_transmission"};
  return known;
}

bool KeepEncoded(tinygltf::Image* image, int index, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void* user) {
  if (image->bufferView < 0 && size > 0) {
    (*static_cast<EncodedGltfImages*>(user))[index].assign(bytes, bytes + size);
  }
  return true;
}

class GltfReader {
 public:
  GltfReader(std::string content, const std::filesystem::path& file, const ModelPose& pose)
      : content_(WithoutGaps(std::move(content))),
        file_(file),
        moment_(pose),
        where_(file.string()) {
    model_.file = file;
    model_.format = Model::Format::kGltf;
  }

  /// What moves the model that Read() returned.
  Result<std::shared_ptr<GltfRig>> ReadRig(const Model& model, const std::string& animation) const {
    std::vector<GltfPart> parts = parts_;
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i].indices = model.meshes[i].indices;
    return GltfRig::Create(gltf_, parts, model.origin_m, animation, where_);
  }

  Result<Model> Read() {
    PLEINAIR_RETURN_IF_ERROR(Parse());
    for (const std::string& extension : gltf_.extensionsRequired) {
      if (!KnownExtensions().contains(extension) && !CanDecompress(extension)) {
        return InputError(where_, "requires the glTF extension " + extension,
                          "export the model without it");
      }
    }
    PLEINAIR_RETURN_IF_ERROR(DecompressGltf(where_, &gltf_));
    PLEINAIR_ASSIGN_OR_RETURN(uvs_, ReadGltfMaterials(gltf_, encoded_, file_, &model_));
    PLEINAIR_ASSIGN_OR_RETURN(posed_.pose, PoseOf(gltf_, moment_, where_));
    if (!gltf_.skins.empty()) posed_.placements = ScenePlacements(gltf_, posed_.pose);
    PLEINAIR_RETURN_IF_ERROR(ReadNodes());
    if (model_.meshes.empty()) return GltfError(where_, "its scene has no triangles");
    model_.written_by = ShortName(gltf_.asset.generator);
    model_.animations = AnimationsOf(gltf_);
    if (!gltf_.animations.empty() && moment_.animation.empty()) {
      model_.unsupported_features.insert(kUnchosenAnimations);
    }
    return std::move(model_);
  }

 private:
  /// The nodes at the moment that is shown.
  struct Posed {
    GltfPose pose;
    std::vector<GltfPlacement> placements;  ///< By node; empty if there are no skins.
  };

  /// Read so far.
  struct Counts {
    std::size_t vertices = 0, triangles = 0;
  };

  /// Shape of a node's mesh.
  struct Shape {
    const std::vector<float>& weights;  ///< Weights of its morph targets.
    std::size_t node;
    int skin;  ///< -1 for none.
  };

  Result<void> Parse() {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(KeepEncoded, &encoded_);
    std::string error, warning;
    GltfFolder from{(file_.has_parent_path() ? file_.parent_path() / "" : "./").string(), {}};
    loader.SetFsCallbacks(FilesBesideModel(&from));
    const auto size = static_cast<unsigned>(std::min<std::size_t>(content_.size(), ~0U));
    bool ok = false;
    try {
      ok = content_.starts_with("glTF")
               ? loader.LoadBinaryFromMemory(
                     &gltf_, &error, &warning,
                     reinterpret_cast<const unsigned char*>(content_.data()), size, from.folder)
               : loader.LoadASCIIFromString(&gltf_, &error, &warning, content_.data(), size,
                                            from.folder);
    } catch (const std::exception& exception) {
      error = exception.what();
    }
    if (from.error) return tl::make_unexpected(*from.error);
    if (ok) return CheckGltfValues(gltf_, where_);
    // The JSON library's own words name only itself.
    std::string first = error.substr(0, error.find('\n'));
    if (first.empty()) first = "unknown cause";
    if (first.find("json.exception") != std::string::npos) first = "its JSON text is not whole";
    return GltfError(where_, "is not a valid glTF 2.0 file: " + first.substr(0, 200));
  }

  /// Walks the default scene's nodes. glTF's nodes form trees: none has two parents.
  Result<void> ReadNodes() {
    struct Visit {
      int node;
      GltfPlacement placement;
    };
    std::vector<Visit> to_visit;
    const int scene = gltf_.defaultScene >= 0 ? gltf_.defaultScene : 0;
    if (IsGltfIndex(scene, gltf_.scenes.size())) {
      for (const int node : gltf_.scenes[static_cast<std::size_t>(scene)].nodes) {
        to_visit.push_back({node, kUpright});
      }
    } else {
      std::vector<bool> is_child(gltf_.nodes.size());
      for (const tinygltf::Node& node : gltf_.nodes) {
        for (const int child : node.children) {
          if (IsGltfIndex(child, gltf_.nodes.size())) {
            is_child[static_cast<std::size_t>(child)] = true;
          }
        }
      }
      for (std::size_t i = 0; i < gltf_.nodes.size(); ++i) {
        if (!is_child[i]) to_visit.push_back({static_cast<int>(i), kUpright});
      }
    }
    std::reverse(to_visit.begin(), to_visit.end());
    std::vector<bool> seen(gltf_.nodes.size());
    while (!to_visit.empty()) {
      const Visit visit = to_visit.back();
      to_visit.pop_back();
      if (!IsGltfIndex(visit.node, gltf_.nodes.size())) {
        return GltfError(where_, "refers to a node out of range");
      }
      const auto index = static_cast<std::size_t>(visit.node);
      if (seen[index]) {
        return GltfError(where_,
                         "node " + std::to_string(index) + " has two parents or contains itself");
      }
      seen[index] = true;
      const tinygltf::Node& node = gltf_.nodes[index];
      const GltfPlacement placement = visit.placement * posed_.pose.local[index];
      if (!IsFinite(placement)) {
        return GltfError(where_,
                         "the placement of node " + std::to_string(index) + " is not finite");
      }
      if (node.mesh >= 0) {
        PLEINAIR_RETURN_IF_ERROR(ReadMesh(index, posed_.pose.weights[index], placement));
      }
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
        to_visit.push_back({*child, placement});
      }
    }
    return {};
  }

  /// `weights`: of the node's morph targets; empty: its mesh's.
  Result<void> ReadMesh(std::size_t index, const std::vector<float>& weights,
                        const GltfPlacement& placement) {
    const tinygltf::Node& node = gltf_.nodes[index];
    if (!IsGltfIndex(node.mesh, gltf_.meshes.size())) {
      return GltfError(where_, "refers to a mesh out of range");
    }
    const tinygltf::Mesh& source = gltf_.meshes[static_cast<std::size_t>(node.mesh)];
    const std::vector<float> own(source.weights.begin(), source.weights.end());
    for (const tinygltf::Primitive& primitive : source.primitives) {
      PLEINAIR_RETURN_IF_ERROR(ReadPrimitive(source.name, primitive,
                                             {weights.empty() ? own : weights, index, node.skin},
                                             node.skin >= 0 ? kUpright : placement));
    }
    return {};
  }

  Result<void> ReadPrimitive(const std::string& name, const tinygltf::Primitive& primitive,
                             const Shape& shape, const GltfPlacement& placement) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    const auto position = primitive.attributes.find("POSITION");
    if (mode < TINYGLTF_MODE_TRIANGLES) model_.unsupported_features.insert(kPointsAndLines);
    if (mode < TINYGLTF_MODE_TRIANGLES || position == primitive.attributes.end()) return {};
    Mesh mesh;
    mesh.name = name;
    PLEINAIR_ASSIGN_OR_RETURN(mesh.positions, ReadGltfFloats<3>(gltf_, position->second, where_));
    counts_.vertices += mesh.positions.size();
    if (counts_.vertices > kMaxVertices) {
      return GltfError(where_, "has more than 20 million vertices");
    }
    if (primitive.material >= 0 && !IsGltfIndex(primitive.material, gltf_.materials.size())) {
      return GltfError(where_, "refers to a material out of range");
    }
    mesh.material = primitive.material >= 0 ? primitive.material
                                            : static_cast<int>(model_.materials.size()) - 1;
    if (const auto normal = primitive.attributes.find("NORMAL");
        normal != primitive.attributes.end()) {
      PLEINAIR_ASSIGN_OR_RETURN(mesh.normals, ReadGltfFloats<3>(gltf_, normal->second, where_));
      if (mesh.normals.size() != mesh.positions.size()) {
        return GltfError(where_, "a mesh has more or fewer normals than positions");
      }
    }
    const MaterialUvs uvs = primitive.material >= 0
                                ? uvs_[static_cast<std::size_t>(primitive.material)]
                                : MaterialUvs{};
    PLEINAIR_ASSIGN_OR_RETURN(mesh.uvs, ReadUvs(primitive, uvs.first.set, mesh.positions.size()));
    for (auto& uv_of_vertex : mesh.uvs) {
      uv_of_vertex = uvs.first(uv_of_vertex);
      if (!IsWithinReach(uv_of_vertex)) {
        return GltfError(where_, "KHR_texture_transform takes texture coordinates beyond 1e8");
      }
    }
    PLEINAIR_RETURN_IF_ERROR(ReadDetails(primitive, uvs, &mesh));
    PLEINAIR_RETURN_IF_ERROR(ApplyMorphTargets(gltf_, primitive, shape.weights, where_, &mesh));
    if (shape.skin >= 0) {
      PLEINAIR_RETURN_IF_ERROR(
          ApplySkin(gltf_, primitive, shape.skin, posed_.placements, where_, &mesh));
    }
    PLEINAIR_RETURN_IF_ERROR(ReadTriangles(primitive, mode, &mesh));
    PLEINAIR_RETURN_IF_ERROR(Place(placement, &mesh));
    if (mesh.indices.empty()) return {};
    parts_.push_back({shape.node, &primitive, {}});
    model_.meshes.push_back(std::move(mesh));
    return {};
  }

  /// Reads one set of texture coordinates; empty if the primitive lacks it.
  Result<std::vector<std::array<float, 2>>> ReadUvs(const tinygltf::Primitive& primitive, int set,
                                                    std::size_t vertices) const {
    const auto found = primitive.attributes.find("TEXCOORD_" + std::to_string(set));
    if (found == primitive.attributes.end()) return std::vector<std::array<float, 2>>{};
    PLEINAIR_ASSIGN_OR_RETURN(auto uvs, ReadGltfFloats<2>(gltf_, found->second, where_));
    if (uvs.size() != vertices) {
      return GltfError(where_, "a mesh has more or fewer texture coordinates than positions");
    }
    return uvs;
  }

  /// Reads colors of vertices and the second set of texture coordinates.
  Result<void> ReadDetails(const tinygltf::Primitive& primitive, const MaterialUvs& uvs,
                           Mesh* mesh) const {
    const std::size_t vertices = mesh->positions.size();
    if (const auto color = primitive.attributes.find("COLOR_0");
        color != primitive.attributes.end()) {
      PLEINAIR_ASSIGN_OR_RETURN(const auto colors, ReadGltfColors(gltf_, color->second, where_));
      if (colors.size() != vertices) {
        return GltfError(where_, "a mesh has more or fewer colors than positions");
      }
      mesh->details.resize(vertices);
      for (std::size_t i = 0; i < vertices; ++i) mesh->details[i].color = colors[i];
    }
    if (!uvs.second_set) return {};
    PLEINAIR_ASSIGN_OR_RETURN(const auto second, ReadUvs(primitive, *uvs.second_set, vertices));
    if (second.empty()) return {};
    mesh->details.resize(vertices);
    for (std::size_t i = 0; i < vertices; ++i) mesh->details[i].uv = second[i];
    return {};
  }

  Result<void> ReadTriangles(const tinygltf::Primitive& primitive, int mode, Mesh* mesh) {
    std::vector<std::uint32_t> order;
    if (primitive.indices >= 0) {
      PLEINAIR_ASSIGN_OR_RETURN(order, ReadGltfIndices(gltf_, primitive.indices, where_));
    } else {
      order.resize(mesh->positions.size());
      std::iota(order.begin(), order.end(), 0U);
    }
    for (const std::uint32_t index : order) {
      if (index >= mesh->positions.size()) {
        return GltfError(where_, "a triangle of mesh \"" + mesh->name.substr(0, 64) +
                                     "\" refers to vertex " + std::to_string(index) + " of " +
                                     std::to_string(mesh->positions.size()));
      }
    }
    counts_.triangles += order.size();
    if (counts_.triangles > kMaxTriangles) {
      return GltfError(where_, "has more than 40 million triangles");
    }
    if (mode == TINYGLTF_MODE_TRIANGLES) {
      order.resize(order.size() / 3 * 3);
      mesh->indices = std::move(order);
      return {};
    }
    for (std::size_t i = 2; i < order.size(); ++i) {
      const bool fan = mode == TINYGLTF_MODE_TRIANGLE_FAN;
      std::array<std::uint32_t, 3> triangle{fan ? order[0] : order[i - 2], order[i - 1], order[i]};
      if (!fan && i % 2 == 1) std::swap(triangle[0], triangle[1]);
      mesh->indices.insert(mesh->indices.end(), triangle.begin(), triangle.end());
    }
    return {};
  }

  Result<void> Place(const GltfPlacement& placement, Mesh* mesh) {
    for (auto& p : mesh->positions) {
      const Vec3 in_file = placement.linear * Vec3{p[0], p[1], p[2]} + placement.translation_m;
      if (!has_vertex_ && Extent(in_file) > kMinFarCoordinate && Extent(in_file) < kMaxCoordinate) {
        model_.origin_m = in_file;
      }
      has_vertex_ = true;
      const Vec3 placed = in_file - model_.origin_m;
      if (!(Extent(placed) < kMaxExtent)) {
        return GltfError(where_, "its nodes move a vertex beyond 1e8 metres");
      }
      p = {static_cast<float>(placed.x), static_cast<float>(placed.y),
           static_cast<float>(placed.z)};
    }
    for (auto& n : mesh->normals) n = TurnedNormal(placement.linear, n);
    const auto& m = placement.linear.m;
    const Vec3 column0{m[0], m[3], m[6]}, column1{m[1], m[4], m[7]}, column2{m[2], m[5], m[8]};
    const bool mirrored = Dot(Cross(column0, column1), column2) < 0.0;
    if (mirrored) {
      for (std::size_t i = 0; i + 2 < mesh->indices.size(); i += 3) {
        std::swap(mesh->indices[i + 1], mesh->indices[i + 2]);
      }
    }
    return {};
  }

  static double Extent(Vec3 v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

  std::string content_;
  const std::filesystem::path& file_;
  const ModelPose& moment_;
  std::string where_;
  tinygltf::Model gltf_;
  EncodedGltfImages encoded_;
  Model model_;
  std::vector<MaterialUvs> uvs_;  ///< By material.
  Posed posed_;
  std::vector<GltfPart> parts_;  ///< By mesh of the model.
  bool has_vertex_ = false;
  Counts counts_;
};

}  // namespace

bool LooksLikeGltf(std::string_view content) {
  if (content.starts_with("glTF")) return true;
  const std::size_t first = content.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return first != std::string_view::npos && content[first] == '{';
}

Result<Model> ParseGltf(std::string content, const std::filesystem::path& file,
                        const ModelPose& pose) {
  return GltfReader(std::move(content), file, pose).Read();
}

Result<MovingGltf> ParseMovingGltf(std::string content, const std::filesystem::path& file,
                                   const std::string& animation) {
  const ModelPose at_rest;
  GltfReader reader(std::move(content), file, at_rest);
  MovingGltf moving;
  PLEINAIR_ASSIGN_OR_RETURN(moving.model, reader.Read());
  moving.model.unsupported_features.erase(kUnchosenAnimations);
  PLEINAIR_ASSIGN_OR_RETURN(moving.rig, reader.ReadRig(moving.model, animation));
  return moving;
}

}  // namespace pleinair::compositor
