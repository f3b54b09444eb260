#include "compositor/models/animation/gltf_rig.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel_for.h"
#include "compositor/models/gltf_accessor.h"
#include "compositor/models/gltf_error.h"
#include "compositor/models/gltf_skin.h"
#include "compositor/models/model_limits.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kVerticesPerBlock = 4096;
// Moments at which the bounds are measured; fewer for models that would take seconds.
constexpr std::size_t kMaxBoundMoments = 33, kMinBoundMoments = 3, kBoundVertices = 4'000'000;

Vec3 Widened(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

void IncludeIn(const std::array<float, 3>& p, ModelBounds* box) {
  box->min_m = {std::min<double>(box->min_m.x, p[0]), std::min<double>(box->min_m.y, p[1]),
                std::min<double>(box->min_m.z, p[2])};
  box->max_m = {std::max<double>(box->max_m.x, p[0]), std::max<double>(box->max_m.y, p[1]),
                std::max<double>(box->max_m.z, p[2])};
}

/// A coordinate within what a file may extend, whatever the key frames.
float Bounded(float value) {
  constexpr auto kMax = static_cast<float>(kMaxExtent);
  return std::fmax(-kMax, std::fmin(kMax, value));
}

std::array<float, 3> UnitOr(float x, float y, float z, const std::array<float, 3>& otherwise) {
  const float norm = std::sqrt(x * x + y * y + z * z);
  if (!(norm > 0.0F) || !std::isfinite(norm)) return otherwise;
  return {x / norm, y / norm, z / norm};
}

}  // namespace

Result<std::shared_ptr<GltfRig>> GltfRig::Create(const tinygltf::Model& gltf,
                                                 const std::vector<GltfPart>& parts, Vec3 origin_m,
                                                 const std::string& animation,
                                                 const std::string& where) {
  auto rig = std::make_shared<GltfRig>();
  rig->origin_m_ = origin_m;
  PLEINAIR_ASSIGN_OR_RETURN(rig->clip_, GltfClip::Read(gltf, animation, where));
  if (!(rig->duration_s() > 0.0)) {
    return InputError(where, "animation \"" + animation.substr(0, 64) + "\" has no two key frames",
                      "leave animation out, or name another");
  }
  rig->MakeTree(gltf);
  for (std::size_t i = 0; i < gltf.skins.size(); ++i) {
    Skin& skin = rig->skins_.emplace_back();
    PLEINAIR_ASSIGN_OR_RETURN(skin.binds, InverseBinds(gltf, static_cast<int>(i), where));
    for (const int joint : gltf.skins[i].joints) {
      if (!IsGltfIndex(joint, gltf.nodes.size())) {
        return GltfError(where, "a skin refers to a joint out of range");
      }
      skin.nodes.push_back(static_cast<std::size_t>(joint));
    }
  }
  std::size_t morph_vectors = 0;
  for (const GltfPart& part : parts) {
    const int skin = gltf.nodes[part.node].skin;
    const std::size_t joints = IsGltfIndex(skin, rig->skins_.size())
                                   ? rig->skins_[static_cast<std::size_t>(skin)].nodes.size()
                                   : 0;
    PLEINAIR_ASSIGN_OR_RETURN(Part read, ReadPart(gltf, part, joints, where, &morph_vectors));
    rig->parts_.push_back(std::move(read));
  }
  return rig;
}

/// The reader has refused nodes with two parents among those of the scene. Others, such as joints
/// outside of it, belong to their last parent.
void GltfRig::MakeTree(const tinygltf::Model& gltf) {
  const std::size_t nodes = gltf.nodes.size();
  tree_.parents.assign(nodes, -1);
  for (std::size_t i = 0; i < nodes; ++i) {
    for (const int child : gltf.nodes[i].children) {
      if (!IsGltfIndex(child, nodes)) continue;
      tree_.parents[static_cast<std::size_t>(child)] = static_cast<int>(i);
    }
  }
  for (std::size_t i = 0; i < nodes; ++i) {
    if (tree_.parents[i] < 0) tree_.order.push_back(i);
  }
  std::vector<bool> placed(nodes);
  for (std::size_t i = 0; i < tree_.order.size(); ++i) {
    const std::size_t parent = tree_.order[i];
    for (const int child : gltf.nodes[parent].children) {
      if (!IsGltfIndex(child, nodes)) continue;
      const auto index = static_cast<std::size_t>(child);
      if (placed[index] || tree_.parents[index] != static_cast<int>(parent)) continue;
      placed[index] = true;
      tree_.order.push_back(index);
    }
  }
}

Result<GltfRig::Part> GltfRig::ReadPart(const tinygltf::Model& gltf, const GltfPart& source,
                                        std::size_t joints, const std::string& where,
                                        std::size_t* morph_vectors) {
  const tinygltf::Primitive& primitive = *source.primitive;
  const tinygltf::Node& node = gltf.nodes[source.node];
  Part part;
  part.node = source.node;
  part.skin = node.skin;
  part.indices = source.indices;
  PLEINAIR_ASSIGN_OR_RETURN(part.rest.positions,
                            ReadGltfFloats<3>(gltf, primitive.attributes.at("POSITION"), where));
  if (const auto normal = primitive.attributes.find("NORMAL");
      normal != primitive.attributes.end()) {
    PLEINAIR_ASSIGN_OR_RETURN(part.rest.normals, ReadGltfFloats<3>(gltf, normal->second, where));
  }
  const std::vector<double>& own = gltf.meshes[static_cast<std::size_t>(node.mesh)].weights;
  const std::size_t targets = std::min(own.size(), primitive.targets.size());
  part.weights.assign(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(targets));
  // Targets may be empty, and nodes share meshes: their number counts too.
  *morph_vectors += primitive.targets.size();
  if (*morph_vectors > kMaxVertices) {
    return GltfError(where, "its morph targets have more than 20 million vectors");
  }
  for (const auto& target : primitive.targets) {
    MeshShape& shape = part.targets.emplace_back();
    for (const auto& [name, values] :
         {std::pair{"POSITION", &shape.positions}, std::pair{"NORMAL", &shape.normals}}) {
      const auto found = target.find(name);
      if (found == target.end()) continue;
      PLEINAIR_ASSIGN_OR_RETURN(*values, ReadGltfFloats<3>(gltf, found->second, where));
      if (values->size() != part.rest.positions.size()) {
        return GltfError(where, "a morph target has more or fewer vertices than its mesh");
      }
      // Targets may share their values: few bytes of the file can ask for much memory.
      *morph_vectors += values->size();
      if (*morph_vectors > kMaxVertices) {
        return GltfError(where, "its morph targets have more than 20 million vectors");
      }
    }
  }
  if (part.skin < 0) return part;
  PLEINAIR_RETURN_IF_ERROR(ReadInfluences(gltf, primitive, joints, where, &part));
  return part;
}

Result<void> GltfRig::ReadInfluences(const tinygltf::Model& gltf,
                                     const tinygltf::Primitive& primitive, std::size_t joints,
                                     const std::string& where, Part* part) {
  PLEINAIR_ASSIGN_OR_RETURN(
      const std::vector<SkinWeights> sets,
      ReadSkinWeights(gltf, primitive, joints, part->rest.positions.size(), where));
  for (std::size_t vertex = 0; vertex < part->rest.positions.size(); ++vertex) {
    const std::size_t first = part->influences.size();
    float sum = 0.0F;
    for (const SkinWeights& set : sets) {
      for (std::size_t k = 0; k < 4; ++k) {
        const float weight = set.weights[vertex][k];
        if (!(weight > 0.0F)) continue;
        part->influences.push_back({static_cast<std::uint32_t>(set.joints[vertex][k]), weight});
        sum += weight;
      }
    }
    for (std::size_t i = first; i < part->influences.size(); ++i) part->influences[i].weight /= sum;
    if (part->influences.size() == first) {
      part->influences.push_back({static_cast<std::uint32_t>(joints), 1.0F});
    }
    part->influence_ends.push_back(static_cast<std::uint32_t>(part->influences.size()));
  }
  return {};
}

Result<void> GltfRig::SetVertices(NormalsMode mode, std::vector<VertexSources> sources,
                                  const std::string& where) {
  sources_ = std::move(sources);
  std::size_t vertices = 1;
  for (const Part& part : parts_) vertices += part.rest.positions.size();
  for (Part& part : parts_) {
    if (mode == NormalsMode::kSmooth) {
      Model alone;
      alone.meshes.emplace_back();
      alone.meshes[0].positions = part.rest.positions;
      alone.meshes[0].indices = part.indices;
      SmoothNormals(&alone);
      part.rest.normals = std::move(alone.meshes[0].normals);
      part.normals_of_triangles = true;
    }
    part.indices.clear();
  }
  const std::size_t moments =
      std::clamp(kBoundVertices / vertices, kMinBoundMoments, kMaxBoundMoments);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  bounds_ = {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (std::size_t i = 0; i < moments; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(moments - 1);
    for (const MeshShape& shape : At(share * duration_s())) {
      for (const Float3& position : shape.positions) IncludeIn(position, &bounds_);
    }
  }
  if (Norm(bounds_.Size()) < kMaxExtent) return {};
  return GltfError(where, "its animation moves a vertex beyond 1e8 metres");
}

GltfRig::Affine GltfRig::MarkerFrom(const GltfPlacement& scene_from) const {
  const GltfPlacement from_origin{{}, -origin_m_};
  const GltfPlacement all = placed_from_read_ * from_origin * kUpright * scene_from;
  Affine rows{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      rows[row][column] = static_cast<float>(all.linear.m[3 * row + column]);
    }
  }
  rows[0][3] = static_cast<float>(all.translation_m.x);
  rows[1][3] = static_cast<float>(all.translation_m.y);
  rows[2][3] = static_cast<float>(all.translation_m.z);
  return rows;
}

std::vector<GltfPlacement> GltfRig::ScenePlacements(const GltfPose& pose) const {
  std::vector<GltfPlacement> placements = pose.local;
  for (const std::size_t node : tree_.order) {
    const int parent = tree_.parents[node];
    if (parent < 0) continue;
    placements[node] = placements[static_cast<std::size_t>(parent)] * pose.local[node];
  }
  return placements;
}

std::vector<GltfRig::Affine> GltfRig::MapsOf(const Skin& skin,
                                             const std::vector<GltfPlacement>& placements) const {
  std::vector<Affine> maps;
  maps.reserve(skin.nodes.size() + 1);
  for (std::size_t i = 0; i < skin.nodes.size(); ++i) {
    maps.push_back(MarkerFrom(placements[skin.nodes[i]] * skin.binds[i]));
  }
  maps.push_back(MarkerFrom({}));
  return maps;
}

MeshShape GltfRig::ShapeOf(const Part& part, const std::vector<float>& weights,
                           const std::vector<Affine>& maps) const {
  MeshShape shape = part.rest;
  const bool has_normals = !shape.normals.empty();
  std::vector<std::pair<float, const MeshShape*>> targets;
  for (std::size_t i = 0; i < std::min(weights.size(), part.targets.size()); ++i) {
    if (weights[i] != 0.0F && std::isfinite(weights[i])) {
      targets.emplace_back(weights[i], &part.targets[i]);
    }
  }
  const std::size_t count = shape.positions.size();
  ParallelForBlocks(count, kVerticesPerBlock, [&](std::size_t first, std::size_t last) {
    for (const auto& [weight, target] : targets) {
      for (std::size_t i = first; i < last && !target->positions.empty(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
          shape.positions[i][c] += weight * target->positions[i][c];
        }
      }
      for (std::size_t i = first; i < last && has_normals && !target->normals.empty(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) shape.normals[i][c] += weight * target->normals[i][c];
      }
    }
    for (std::size_t i = first; i < last; ++i) {
      Affine map = maps[0];
      if (part.skin >= 0) {
        map = {};
        std::size_t k = i == 0 ? 0 : part.influence_ends[i - 1];
        for (; k < part.influence_ends[i]; ++k) {
          const Affine& joint = maps[part.influences[k].joint];
          for (std::size_t row = 0; row < 3; ++row) {
            for (std::size_t column = 0; column < 4; ++column) {
              map[row][column] += part.influences[k].weight * joint[row][column];
            }
          }
        }
      }
      const auto [x, y, z] = shape.positions[i];
      for (std::size_t row = 0; row < 3; ++row) {
        shape.positions[i][row] =
            Bounded(map[row][0] * x + map[row][1] * y + map[row][2] * z + map[row][3]);
      }
      if (!has_normals) continue;
      // By the cofactors, which turn normals rightly whatever the scales.
      const auto& [a, b, c] = map;
      const auto [u, v, w] = shape.normals[i];
      const float sign = !part.normals_of_triangles && a[0] * (b[1] * c[2] - b[2] * c[1]) +
                                                               a[1] * (b[2] * c[0] - b[0] * c[2]) +
                                                               a[2] * (b[0] * c[1] - b[1] * c[0]) <
                                                           0.0F
                             ? -1.0F
                             : 1.0F;
      const float nx = u * (b[1] * c[2] - b[2] * c[1]) + v * (b[2] * c[0] - b[0] * c[2]) +
                       w * (b[0] * c[1] - b[1] * c[0]);
      const float ny = u * (c[1] * a[2] - c[2] * a[1]) + v * (c[2] * a[0] - c[0] * a[2]) +
                       w * (c[0] * a[1] - c[1] * a[0]);
      const float nz = u * (a[1] * b[2] - a[2] * b[1]) + v * (a[2] * b[0] - a[0] * b[2]) +
                       w * (a[0] * b[1] - a[1] * b[0]);
      shape.normals[i] = UnitOr(sign * nx, sign * ny, sign * nz, {0.0F, 0.0F, 1.0F});
    }
  });
  return shape;
}

MeshShape GltfRig::Arranged(const VertexSources& sources, const MeshShape& part) const {
  MeshShape shape;
  const std::size_t count = sources.vertices.size();
  shape.positions.resize(count);
  shape.normals.resize(count);
  ParallelForBlocks(count, kVerticesPerBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      shape.positions[i] = part.positions[sources.vertices[i]];
      if (sources.flat[i] == 0) shape.normals[i] = part.normals[sources.vertices[i]];
    }
  });
  for (std::size_t i = 0; i < count; ++i) {
    if (sources.flat[i] == 0) continue;
    // The three corners of a flat triangle follow each other.
    const Vec3 at = Widened(shape.positions[i]);
    const Vec3 n =
        Cross(Widened(shape.positions[i + 1]) - at, Widened(shape.positions[i + 2]) - at);
    const double norm = Norm(n);
    Float3 normal{0.0F, 0.0F, 1.0F};
    if (norm > 0.0) {
      normal = {static_cast<float>(n.x / norm), static_cast<float>(n.y / norm),
                static_cast<float>(n.z / norm)};
    }
    for (std::size_t k = i; k < i + 3; ++k) shape.normals[k] = normal;
    i += 2;
  }
  return shape;
}

std::vector<MeshShape> GltfRig::At(double time_s) const {
  const GltfPose pose = clip_.At(time_s);
  const std::vector<GltfPlacement> placements = ScenePlacements(pose);
  std::vector<std::vector<Affine>> skin_maps;
  skin_maps.reserve(skins_.size());
  for (const Skin& skin : skins_) skin_maps.push_back(MapsOf(skin, placements));
  std::vector<MeshShape> shapes;
  shapes.reserve(sources_.size());
  for (const VertexSources& sources : sources_) {
    const Part& part = parts_[sources.mesh];
    const std::vector<float>& weights =
        pose.weights[part.node].empty() ? part.weights : pose.weights[part.node];
    const MeshShape shape =
        part.skin < 0 ? ShapeOf(part, weights, {MarkerFrom(placements[part.node])})
                      : ShapeOf(part, weights, skin_maps[static_cast<std::size_t>(part.skin)]);
    shapes.push_back(Arranged(sources, shape));
  }
  return shapes;
}

}  // namespace pleinair::compositor
