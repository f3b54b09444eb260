#include "compositor/models/mesh_normals.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <utility>

#include "base/vector.h"

namespace pleinair::compositor {
namespace {

using Float3 = std::array<float, 3>;

Vec3 ToVec3(const Float3& a) { return {a[0], a[1], a[2]}; }

Float3 UnitFloats(Vec3 v) {
  const Vec3 unit = Normalized(v);
  return {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z)};
}

/// The triangle's normal, bit-identical for all triangles of one flat polygon. Their normals differ
/// in the last digits only, which are rounded away.
Float3 FlatNormal(Vec3 area_normal) {
  const Vec3 unit = Normalized(area_normal);
  constexpr double kSteps = 1 << 18;
  return UnitFloats(
      {std::round(unit.x * kSteps), std::round(unit.y * kSteps), std::round(unit.z * kSteps)});
}

Vec3 AreaNormal(const Mesh& mesh, std::size_t first) {
  const Vec3 a = ToVec3(mesh.positions[mesh.indices[first]]);
  return Cross(ToVec3(mesh.positions[mesh.indices[first + 1]]) - a,
               ToVec3(mesh.positions[mesh.indices[first + 2]]) - a);
}

void RemoveDegenerate(Mesh* mesh) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i + 2 < mesh->indices.size(); i += 3) {
    const double area = Norm(AreaNormal(*mesh, i));
    if (!(area > 0.0) || !std::isfinite(area)) continue;
    for (int c = 0; c < 3; ++c) mesh->indices[kept + c] = mesh->indices[i + c];
    kept += 3;
  }
  mesh->indices.resize(kept);
}

/// Gives triangles that satisfy `is_flat` corners of their own with the triangle's normal.
template <typename Predicate>
VertexSources Flatten(Mesh* mesh, const Predicate& is_flat) {
  VertexSources sources;
  Mesh out;
  out.name = mesh->name;
  out.material = mesh->material;
  constexpr std::uint32_t kUnused = ~0U;
  std::vector<std::uint32_t> shared(mesh->positions.size(), kUnused);
  const auto copy = [&](std::uint32_t vertex, const Float3& normal, bool flat) {
    sources.vertices.push_back(vertex);
    sources.flat.push_back(flat ? 1 : 0);
    out.positions.push_back(mesh->positions[vertex]);
    out.normals.push_back(normal);
    if (!mesh->uvs.empty()) out.uvs.push_back(mesh->uvs[vertex]);
    if (!mesh->details.empty()) out.details.push_back(mesh->details[vertex]);
    return static_cast<std::uint32_t>(out.positions.size() - 1);
  };
  for (std::size_t i = 0; i + 2 < mesh->indices.size(); i += 3) {
    const bool flat = is_flat(i);
    const Float3 normal = flat ? FlatNormal(AreaNormal(*mesh, i)) : Float3{};
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t vertex = mesh->indices[i + c];
      if (flat) {
        out.indices.push_back(copy(vertex, normal, true));
        continue;
      }
      if (shared[vertex] == kUnused) {
        shared[vertex] = copy(vertex, mesh->normals[vertex], false);
      }
      out.indices.push_back(shared[vertex]);
    }
  }
  *mesh = std::move(out);
  return sources;
}

}  // namespace

void SmoothNormals(Model* model) {
  std::map<Float3, Vec3> sums;
  for (const Mesh& mesh : model->meshes) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const Vec3 face = Normalized(AreaNormal(mesh, i));
      for (int c = 0; c < 3; ++c) {
        const Float3& at = mesh.positions[mesh.indices[i + c]];
        const Vec3 a =
            Normalized(ToVec3(mesh.positions[mesh.indices[i + (c + 1) % 3]]) - ToVec3(at));
        const Vec3 b =
            Normalized(ToVec3(mesh.positions[mesh.indices[i + (c + 2) % 3]]) - ToVec3(at));
        Vec3& sum = sums[at];
        sum = sum + face * std::atan2(Norm(Cross(a, b)), Dot(a, b));
      }
    }
  }
  for (Mesh& mesh : model->meshes) {
    mesh.normals.assign(mesh.positions.size(), Float3{});
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const auto sum = sums.find(mesh.positions[v]);
      if (sum != sums.end() && Norm(sum->second) > 1e-6) mesh.normals[v] = UnitFloats(sum->second);
    }
  }
}

std::vector<VertexSources> ApplyNormals(NormalsMode mode, Model* model) {
  for (Mesh& mesh : model->meshes) RemoveDegenerate(&mesh);
  if (mode == NormalsMode::kSmooth) SmoothNormals(model);
  std::vector<VertexSources> sources;
  for (std::size_t m = 0; m < model->meshes.size(); ++m) {
    Mesh& mesh = model->meshes[m];
    mesh.normals.resize(mesh.positions.size());
    for (Float3& normal : mesh.normals) {
      const double norm = Norm(ToVec3(normal));
      normal = norm > 1e-12 ? UnitFloats(ToVec3(normal)) : Float3{};
    }
    VertexSources flattened = Flatten(&mesh, [&](std::size_t first) {
      if (mode == NormalsMode::kFlat) return true;
      for (int c = 0; c < 3; ++c) {
        if (mesh.normals[mesh.indices[first + c]] == Float3{}) return true;
      }
      return false;
    });
    flattened.mesh = m;
    if (!mesh.indices.empty()) sources.push_back(std::move(flattened));
  }
  std::erase_if(model->meshes, [](const Mesh& mesh) { return mesh.indices.empty(); });
  return sources;
}

}  // namespace pleinair::compositor
