#include "compositor/models/surface_orientation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "compositor/models/model.h"
#include "compositor/models/placed_model.h"

namespace pleinair::compositor {
namespace {

Vec3 ToVec3(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

std::array<float, 3> ToFloats(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Gives equal numbers to vertices that are equal in every bit.
template <std::size_t N>
class Welder {
 public:
  std::uint32_t Insert(std::array<float, N> key) {
    for (float& value : key) value += 0.0F;  // −0 becomes 0.
    return ids_.try_emplace(key, static_cast<std::uint32_t>(ids_.size())).first->second;
  }
  std::size_t size() const { return ids_.size(); }

 private:
  struct BytesHash {
    std::size_t operator()(const std::array<float, N>& key) const {
      std::array<char, N * sizeof(float)> bytes;
      std::memcpy(bytes.data(), key.data(), bytes.size());
      return std::hash<std::string_view>{}({bytes.data(), bytes.size()});
    }
  };
  std::unordered_map<std::array<float, N>, std::uint32_t, BytesHash> ids_;
};

/// A triangle of a placed model, by its corners.
struct Triangle {
  std::uint32_t mesh = 0;
  std::array<std::uint32_t, 3> corners{};  ///< Indices into the mesh's vertices.
  std::array<std::uint32_t, 3> welded{};   ///< Position numbers, shared among meshes.
  Vec3 area_normal;                        ///< Twice the area, in the file's winding.
  double agreement = 0.0;                  ///< Area times the agreement with the file's normals.
  std::uint32_t component = 0;
  bool flip = false;
};

struct EdgeUse {
  std::uint64_t edge = 0;  ///< Both position numbers, smaller first.
  std::uint32_t triangle = 0;
  bool forwards = false;  ///< Runs from the smaller number to the larger.
};

std::vector<EdgeUse> SortedEdges(const std::vector<Triangle>& triangles) {
  std::vector<EdgeUse> edges;
  edges.reserve(triangles.size() * 3);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[t].welded[i];
      const std::uint32_t b = triangles[t].welded[(i + 1) % 3];
      const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
      edges.push_back({key, t, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
  });
  return edges;
}

/// Calls `visit(first, last)` for the uses of each edge.
template <typename Visit>
void ForEachEdge(const std::vector<EdgeUse>& edges, const Visit& visit) {
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first + 1;
    while (last < edges.size() && edges[last].edge == edges[first].edge) ++last;
    visit(first, last);
    first = last;
  }
}

/// Numbers the components, joined where exactly two triangles share an edge. Flips triangles so
/// that these neighbours agree. Returns the number of components.
std::uint32_t FloodComponents(const std::vector<EdgeUse>& edges, std::vector<Triangle>* triangles) {
  struct Neighbour {
    std::uint32_t triangle;
    bool same_direction;
  };
  std::vector<std::vector<Neighbour>> neighbours(triangles->size());
  ForEachEdge(edges, [&](std::size_t first, std::size_t last) {
    if (last - first != 2) return;
    const EdgeUse& a = edges[first];
    const EdgeUse& b = edges[first + 1];
    const bool same = a.forwards == b.forwards;
    neighbours[a.triangle].push_back({b.triangle, same});
    neighbours[b.triangle].push_back({a.triangle, same});
  });
  constexpr std::uint32_t kNone = ~0U;
  for (Triangle& triangle : *triangles) triangle.component = kNone;
  std::uint32_t count = 0;
  std::vector<std::uint32_t> open_list;
  for (std::uint32_t seed = 0; seed < triangles->size(); ++seed) {
    if ((*triangles)[seed].component != kNone) continue;
    (*triangles)[seed].component = count;
    open_list.assign(1, seed);
    while (!open_list.empty()) {
      const std::uint32_t current = open_list.back();
      open_list.pop_back();
      for (const Neighbour& neighbour : neighbours[current]) {
        Triangle& other = (*triangles)[neighbour.triangle];
        if (other.component != kNone) continue;
        other.component = count;
        other.flip = (*triangles)[current].flip != neighbour.same_direction;
        open_list.push_back(neighbour.triangle);
      }
    }
    ++count;
  }
  return count;
}

/// A component is closed when each of its edges belongs to an even number of its triangles.
std::vector<bool> ClosedComponents(const std::vector<EdgeUse>& edges,
                                   const std::vector<Triangle>& triangles, std::uint32_t count) {
  std::vector<bool> closed(count, true);
  std::vector<std::uint32_t> users;
  ForEachEdge(edges, [&](std::size_t first, std::size_t last) {
    users.clear();
    for (std::size_t i = first; i < last; ++i) {
      users.push_back(triangles[edges[i].triangle].component);
    }
    std::sort(users.begin(), users.end());
    for (std::size_t i = 0; i < users.size();) {
      std::size_t next = i;
      while (next < users.size() && users[next] == users[i]) ++next;
      if ((next - i) % 2 != 0) closed[users[i]] = false;
      i = next;
    }
  });
  return closed;
}

struct PlacedVertices {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;
};

/// Rotates, scales and moves a mesh. Normals transform by the cofactor matrix, which is also
/// correct for non-uniform scales and mirrors.
PlacedVertices Place(const Mesh& mesh, const PlacedModel& placed) {
  const auto& m = placed.linear.m;
  const Vec3 column0{m[0], m[3], m[6]}, column1{m[1], m[4], m[7]}, column2{m[2], m[5], m[8]};
  const double sign = Dot(Cross(column0, column1), column2) < 0.0 ? -1.0 : 1.0;
  const Vec3 cofactor0 = Cross(column1, column2) * sign;
  const Vec3 cofactor1 = Cross(column2, column0) * sign;
  const Vec3 cofactor2 = Cross(column0, column1) * sign;
  PlacedVertices out;
  for (const auto& position : mesh.positions) {
    // Rounded to the stored precision, so that welding compares the values that others see.
    out.positions.push_back(
        ToVec3(ToFloats(placed.linear * ToVec3(position) + placed.translation_m)));
  }
  for (const auto& n : mesh.normals) {
    const Vec3 normal = cofactor0 * n[0] + cofactor1 * n[1] + cofactor2 * n[2];
    const double norm = Norm(normal);
    out.normals.push_back(norm > 0.0 ? normal * (1.0 / norm) : Vec3{});
  }
  return out;
}

/// Collects one mesh's triangles of one kind into a surface.
class SurfaceBuilder {
 public:
  /// `keeps_vertices`: as TracedSurfaces().
  SurfaceBuilder(const Mesh& mesh, const PlacedVertices& vertices, bool keeps_vertices)
      : mesh_(mesh), vertices_(vertices), keeps_vertices_(keeps_vertices) {}

  void Add(const Triangle& triangle) {
    const Vec3 face = Normalized(triangle.flip ? -triangle.area_normal : triangle.area_normal);
    std::array<std::uint32_t, 3> corners = triangle.corners;
    if (triangle.flip) std::swap(corners[1], corners[2]);
    for (const std::uint32_t corner : corners) {
      Vec3 normal = corner < vertices_.normals.size() ? vertices_.normals[corner] : Vec3{};
      if (Dot(normal, normal) == 0.0) normal = face;
      if (Dot(normal, face) < 0.0) normal = -normal;
      surface.indices.push_back(Vertex(corner, ToFloats(normal)));
    }
  }

  SurfaceMesh surface;
  std::vector<std::uint32_t> sources;  ///< Vertices of the mesh, one per vertex of the surface.

 private:
  std::uint32_t Vertex(std::uint32_t corner, const std::array<float, 3>& normal) {
    const std::array<float, 3> position = ToFloats(vertices_.positions[corner]);
    const bool has_uv = !mesh_.uvs.empty();
    const std::array<float, 2> uv = has_uv ? mesh_.uvs[corner] : std::array<float, 2>{};
    const std::array<float, 8> key{position[0], position[1], position[2], normal[0],
                                   normal[1],   normal[2],   uv[0],       uv[1]};
    const bool has_detail = !mesh_.details.empty();
    const std::uint32_t id = keeps_vertices_ ? InsertSource(key, corner)
                             : has_detail    ? InsertDetailed(key, mesh_.details[corner])
                                             : welder_.Insert(key);
    if (id == surface.positions.size()) {
      sources.push_back(corner);
      if (has_detail) surface.details.push_back(mesh_.details[corner]);
      surface.positions.push_back(position);
      surface.normals.push_back(normal);
      if (has_uv) surface.uvs.push_back(uv);
    }
    return id;
  }

  /// Corners of one vertex have equal positions and coordinates; their normals may be turned.
  std::uint32_t InsertSource(std::array<float, 8> key, std::uint32_t corner) {
    key[6] = static_cast<float>(corner & 0xFFFFU);
    key[7] = static_cast<float>(corner >> 16);
    return welder_.Insert(key);
  }

  std::uint32_t InsertDetailed(const std::array<float, 8>& key, const VertexDetail& detail) {
    std::array<float, 14> longer;
    const auto end = std::ranges::copy(key, longer.begin()).out;
    std::ranges::copy(detail.color, std::ranges::copy(detail.uv, end).out);
    return detailed_welder_.Insert(longer);
  }

  const Mesh& mesh_;
  const PlacedVertices& vertices_;
  bool keeps_vertices_;
  Welder<8> welder_;
  Welder<14> detailed_welder_;  // For meshes with vertex details, in place of the other.
};

/// Collects the triangles of the render-only meshes, or of all others.
std::vector<Triangle> CollectTriangles(const Model& model,
                                       const std::vector<PlacedVertices>& placed,
                                       bool drawn_alone) {
  std::vector<Triangle> triangles;
  Welder<3> welder;
  for (std::uint32_t m = 0; m < model.meshes.size(); ++m) {
    const Mesh& mesh = model.meshes[m];
    if ((mesh.role == MeshRole::kRenderOnly) != drawn_alone) continue;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      Triangle triangle;
      triangle.mesh = m;
      std::array<Vec3, 3> p;
      Vec3 normal_sum;
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t corner = mesh.indices[i + c];
        triangle.corners[c] = corner;
        p[c] = placed[m].positions[corner];
        triangle.welded[c] = welder.Insert(ToFloats(p[c]));
        if (corner < placed[m].normals.size()) normal_sum = normal_sum + placed[m].normals[corner];
      }
      triangle.area_normal = Cross(p[1] - p[0], p[2] - p[0]);
      if (!(Norm(triangle.area_normal) > 1e-14)) continue;
      triangle.agreement = Dot(triangle.area_normal, normal_sum);
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

/// Orients triangles by their neighbours, enclosed volumes and normals. Returns for each component
/// whether it is closed.
std::vector<bool> Orient(const std::vector<PlacedVertices>& vertices,
                         std::vector<Triangle>* to_turn) {
  std::vector<Triangle>& triangles = *to_turn;
  const std::vector<EdgeUse> edges = SortedEdges(triangles);
  const std::uint32_t count = FloodComponents(edges, &triangles);
  std::vector<bool> closed = ClosedComponents(edges, triangles, count);

  // Six times the enclosed volume (divergence theorem), and the agreement with the file's normals.
  std::vector<double> volume(count), agreement(count);
  std::vector<Vec3> reference(count);
  std::vector<bool> seen(count);
  for (const Triangle& triangle : triangles) {
    const std::uint32_t c = triangle.component;
    const Vec3 corner = vertices[triangle.mesh].positions[triangle.corners[0]];
    if (!seen[c]) reference[c] = corner;
    seen[c] = true;
    const double sign = triangle.flip ? -1.0 : 1.0;
    volume[c] += sign * Dot(corner - reference[c], triangle.area_normal);
    agreement[c] += sign * triangle.agreement;
  }
  for (Triangle& triangle : triangles) {
    const std::uint32_t c = triangle.component;
    if ((closed[c] ? volume[c] : agreement[c]) < 0.0) triangle.flip = !triangle.flip;
  }
  return closed;
}

std::vector<TracedSurface> MakeSurfaces(const PlacedModel& placed, int placed_index,
                                        bool keeps_vertices) {
  const Model& model = *placed.model;
  std::vector<PlacedVertices> vertices;
  for (const Mesh& mesh : model.meshes) vertices.push_back(Place(mesh, placed));
  std::vector<TracedSurface> surfaces;
  std::vector<std::vector<SurfaceBuilder>> builders;
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    builders.emplace_back(2, SurfaceBuilder(model.meshes[m], vertices[m], keeps_vertices));
  }
  for (const bool drawn_alone : {false, true}) {
    std::vector<Triangle> triangles = CollectTriangles(model, vertices, drawn_alone);
    const std::vector<bool> closed = Orient(vertices, &triangles);
    for (const Triangle& triangle : triangles) {
      const bool is_body = closed[triangle.component] && !drawn_alone;
      builders[triangle.mesh][is_body ? 1 : 0].Add(triangle);
    }
  }
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    for (int kind = 0; kind < 2; ++kind) {
      SurfaceMesh& surface = builders[m][kind].surface;
      if (surface.indices.empty()) continue;
      surface.is_phantom = placed.is_phantom;
      surface.placed_model = placed_index;
      surface.material = model.meshes[m].material;
      surface.role = model.meshes[m].role;
      surface.closed = kind == 1;
      surfaces.push_back({std::move(surface), m, std::move(builders[m][kind].sources)});
    }
  }
  return surfaces;
}

}  // namespace

std::vector<SurfaceMesh> OrientedSurfaces(const PlacedModel& placed, int placed_index) {
  std::vector<SurfaceMesh> surfaces;
  for (TracedSurface& traced : MakeSurfaces(placed, placed_index, false)) {
    surfaces.push_back(std::move(traced.surface));
  }
  return surfaces;
}

std::vector<TracedSurface> TracedSurfaces(const PlacedModel& placed, int placed_index) {
  return MakeSurfaces(placed, placed_index, true);
}

}  // namespace pleinair::compositor
