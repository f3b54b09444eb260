#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "compositor/models/animation/gltf_clip.h"
#include "compositor/models/animation/model_animation.h"
#include "compositor/models/gltf_placement.h"
#include "compositor/models/mesh_normals.h"

namespace tinygltf {
class Model;
struct Primitive;
}  // namespace tinygltf

namespace pleinair::compositor {

/// A mesh of a model and where a glTF file has it.
struct GltfPart {
  std::size_t node = 0;
  const tinygltf::Primitive* primitive = nullptr;
  std::vector<std::uint32_t> indices;  ///< Triangles of the model's mesh, by vertex of the file.
};

/// Moves the vertices of a glTF file by its nodes, morph targets and skins (glTF 2.0, 3.7). All
/// attributes are in memory, so that a shape needs no access to the file. Vertices are in the
/// model's order after SetFrame() and SetVertices().
class GltfRig : public ModelAnimation {
 public:
  /// `parts`: one per mesh of the model as read. `origin_m`: Model::origin_m as read. Errors as
  /// ApplyMorphTargets(), ApplySkin() and GltfClip::Read(); an animation without duration.
  static Result<std::shared_ptr<GltfRig>> Create(const tinygltf::Model& gltf,
                                                 const std::vector<GltfPart>& parts, Vec3 origin_m,
                                                 const std::string& animation,
                                                 const std::string& where);

  /// Applies the map of ApplyFrame().
  void SetFrame(const GltfPlacement& placed_from_read) { placed_from_read_ = placed_from_read; }
  /// Takes the vertices of ApplyNormals(). With NormalsMode::kSmooth the normals are averaged over
  /// each mesh at rest and move with it. Errors: vertices that move too far.
  Result<void> SetVertices(NormalsMode mode, std::vector<VertexSources> sources,
                           const std::string& where);

  double duration_s() const override { return clip_.duration_s(); }
  ModelBounds bounds() const override { return bounds_; }
  std::vector<MeshShape> At(double time_s) const override;

 private:
  using Float3 = std::array<float, 3>;
  /// Rows of an affine map, in single precision.
  using Affine = std::array<std::array<float, 4>, 3>;

  struct Influence {
    std::uint32_t joint = 0;
    float weight = 0.0F;  ///< Those of a vertex add up to 1.
  };
  struct Part {
    std::size_t node = 0;
    int skin = -1;
    MeshShape rest;  ///< As in the file; normals may be empty.
    /// Normals averaged over triangles, whose corners Place() turned where it mirrors them: their
    /// cofactors need no sign.
    bool normals_of_triangles = false;
    std::vector<std::uint32_t> indices;
    std::vector<MeshShape> targets;     ///< Differences from `rest`; either may be empty.
    std::vector<float> weights;         ///< Target weights, where the node has none.
    std::vector<Influence> influences;  ///< By vertex; empty without a skin.
    std::vector<std::uint32_t> influence_ends;
  };
  struct Skin {
    std::vector<std::size_t> nodes;  ///< One per joint.
    std::vector<GltfPlacement> binds;
  };
  struct Tree {
    std::vector<std::size_t> order;  ///< Nodes, parents first.
    std::vector<int> parents;        ///< By node; -1 for none.
  };

  /// `morph_vectors`: those of the parts before it; adds its own.
  static Result<Part> ReadPart(const tinygltf::Model& gltf, const GltfPart& part,
                               std::size_t joints, const std::string& where,
                               std::size_t* morph_vectors);
  static Result<void> ReadInfluences(const tinygltf::Model& gltf,
                                     const tinygltf::Primitive& primitive, std::size_t joints,
                                     const std::string& where, Part* part);
  void MakeTree(const tinygltf::Model& gltf);
  Affine MarkerFrom(const GltfPlacement& scene_from) const;
  std::vector<GltfPlacement> ScenePlacements(const GltfPose& pose) const;
  /// One map per joint of a skin. The last map is that of the identity, for vertices without
  /// joints.
  std::vector<Affine> MapsOf(const Skin& skin, const std::vector<GltfPlacement>& placements) const;
  MeshShape ShapeOf(const Part& part, const std::vector<float>& weights,
                    const std::vector<Affine>& maps) const;
  MeshShape Arranged(const VertexSources& sources, const MeshShape& part) const;

  GltfClip clip_;
  Tree tree_;
  std::vector<Skin> skins_;
  std::vector<Part> parts_;
  Vec3 origin_m_;
  GltfPlacement placed_from_read_;
  std::vector<VertexSources> sources_;  // One per mesh of the model.
  ModelBounds bounds_;
};

}  // namespace pleinair::compositor
