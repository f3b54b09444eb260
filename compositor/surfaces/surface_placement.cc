#include "compositor/surfaces/surface_placement.h"

namespace pleinair::compositor {
namespace {

/// Where the shadow of a mesh may end. Creases that are concave are left out.
std::vector<shadows::CasterEdge> EdgesOf(const LitMesh& mesh,
                                         std::span<const OutlineEdge> outline) {
  const auto at = [&](std::uint32_t vertex) {
    const auto& p = mesh.positions[vertex];
    return glm::vec3(p[0], p[1], p[2]);
  };
  std::vector<shadows::CasterEdge> edges;
  edges.reserve(outline.size());
  for (const OutlineEdge& edge : outline) {
    const glm::vec3 a = at(edge.a), b = at(edge.b);
    const glm::vec3 normal = glm::cross(b - a, at(edge.corner) - a);
    glm::vec3 other(0.0F);
    if (edge.other_corner != OutlineEdge::kNone) {
      const glm::vec3 to_other = at(edge.other_corner) - a;
      if (glm::dot(normal, to_other) > 0.0F) continue;
      other = glm::cross(to_other, b - a);
    }
    edges.push_back({a, b, normal, other});
  }
  return edges;
}

}  // namespace

void SurfacePlacement::Clear() {
  casters_.clear();
  phantom_casters_.clear();
  shapes_.clear();
  ++revision_;
}

void SurfacePlacement::Add(const LitMesh& mesh, std::span<const OutlineEdge> outline) {
  Shape& shape = shapes_.emplace_back();
  if (mesh.role != MeshRole::kRenderOnly) shape.edges = EdgesOf(mesh, outline);
  shape.revision = revision_;
  for (const auto& p : mesh.positions) shape.bounds.Include({p[0], p[1], p[2]});
}

void SurfacePlacement::IncludeShapes(const ModelBounds& shapes) {
  shapes_.back().changes = true;
  for (const Vec3 corner : {shapes.min_m, shapes.max_m}) {
    shapes_.back().bounds.Include({corner.x, corner.y, corner.z});
  }
}

void SurfacePlacement::SetShape(std::size_t surface, const LitMesh& mesh) {
  for (const auto& p : mesh.positions) shapes_[surface].bounds.Include({p[0], p[1], p[2]});
  shapes_[surface].revision = ++revision_;
  shapes_[surface].triangles = {mesh.positions, mesh.indices};
}

void SurfacePlacement::Reset(std::size_t models, std::span<const SurfaceBuffers> surfaces) {
  moved_.assign(models, glm::dmat4(1.0));
  Place(surfaces);
}

void SurfacePlacement::Move(int placed_model, const Mat3& linear, Vec3 translation_m,
                            std::span<const SurfaceBuffers> surfaces) {
  glm::dmat4 moved(1.0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) moved[column][row] = linear(row, column);
  }
  moved[3] = glm::dvec4(translation_m.x, translation_m.y, translation_m.z, 1.0);
  moved_[static_cast<std::size_t>(placed_model)] = moved;
  Place(surfaces);
}

void SurfacePlacement::Place(std::span<const SurfaceBuffers> surfaces) {
  casters_.clear();
  phantom_casters_.clear();
  object_bounds_ = bounds_ = {};
  shadows::Box without_shadow;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const SurfaceBuffers& surface = surfaces[i];
    shadows::ShadowCaster caster;
    caster.vertices = &surface.vertex_array();
    caster.index_count = surface.index_count();
    caster.revision = shapes_[i].revision;
    caster.sun_side_only = shapes_[i].changes;
    caster.triangles = shapes_[i].triangles;
    if (!shapes_[i].changes && caster.triangles.indices.empty()) caster.edges = shapes_[i].edges;
    caster.marker_from_model = MovedBy(surface.placed_model());
    const shadows::Box& lit = shapes_[i].bounds;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec4 point((corner & 1) != 0 ? lit.max.x : lit.min.x,
                             (corner & 2) != 0 ? lit.max.y : lit.min.y,
                             (corner & 4) != 0 ? lit.max.z : lit.min.z, 1.0);
      caster.bounds.Include(glm::dvec3(caster.marker_from_model * point));
    }
    bounds_.Include(caster.bounds);
    if (!surface.is_phantom()) {
      (surface.CastsShadow() ? object_bounds_ : without_shadow).Include(caster.bounds);
    }
    if (!surface.CastsShadow()) {
      if (surface.is_phantom()) continue;
      // It receives shadows, so that the depths of the maps must reach it.
      caster.index_count = 0;
      caster.triangles = {};
    }
    if (surface.is_phantom()) phantom_casters_.push_back(caster);
    casters_.push_back(caster);
  }
  if (object_bounds_.Empty()) object_bounds_ = without_shadow;
}

}  // namespace pleinair::compositor
