#include "compositor/surfaces/visibility_buffer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include "base/parallel_for.h"
#include "compositor/surfaces/texture_rows.h"

namespace pleinair::compositor {
namespace {

using Texel = std::array<float, 4>;

constexpr std::size_t kVerticesPerBlock = 8192;

}  // namespace

std::vector<std::uint32_t> ComponentsOf(const LitMesh& mesh, std::uint32_t first) {
  std::vector<std::uint32_t> parents(mesh.positions.size());
  std::iota(parents.begin(), parents.end(), 0U);
  const auto root_of = [&](std::uint32_t vertex) {
    while (parents[vertex] != vertex) {
      parents[vertex] = parents[parents[vertex]];
      vertex = parents[vertex];
    }
    return vertex;
  };
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::uint32_t a = root_of(mesh.indices[i]), b = root_of(mesh.indices[i - i % 3]);
    parents[std::max(a, b)] = std::min(a, b);
  }
  // A component's root is its first vertex, so it is numbered first.
  std::vector<std::uint32_t> components(parents.size());
  for (std::uint32_t vertex = 0; vertex < components.size(); ++vertex) {
    const std::uint32_t root = root_of(vertex);
    components[vertex] = root == vertex ? first++ : components[root];
  }
  return components;
}

Result<VisibilityBuffer> VisibilityBuffer::Create(std::span<const LitMesh* const> meshes,
                                                  std::span<const float> values) {
  VisibilityBuffer table;
  std::vector<float> component_values;
  std::uint32_t vertices = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const LitMesh& mesh = *meshes[m];
    table.first_vertices_.push_back(vertices);
    vertices += static_cast<std::uint32_t>(mesh.positions.size());
    const auto components = ComponentsOf(mesh, static_cast<std::uint32_t>(component_values.size()));
    if (!components.empty()) {
      component_values.resize(
          *std::max_element(components.begin(), components.end()) + std::size_t{1}, values[m]);
    }
    table.components_.insert(table.components_.end(), components.begin(), components.end());
  }
  PLEINAIR_RETURN_IF_ERROR(
      UploadRows(component_values, kTrianglesPerRow, GL_R32F, GL_RED, GL_FLOAT, &table.values_));
  return table;
}

Result<void> VisibilityBuffer::SetLight(std::span<const LitMesh* const> meshes,
                                        const LightMix& mix) {
  std::size_t count = 0;
  for (const LitMesh* mesh : meshes) count += mesh->positions.size();
  vertex_texels_.resize(kTexelsPerVertex * count);
  Texel* next = vertex_texels_.data();
  for (const LitMesh* mesh : meshes) {
    const std::size_t size = mesh->positions.size();
    ParallelFor((size + kVerticesPerBlock - 1) / kVerticesPerBlock, 0, [&](std::size_t block) {
      const std::size_t last = std::min(size, (block + 1) * kVerticesPerBlock);
      for (std::size_t i = block * kVerticesPerBlock; i < last; ++i) {
        const auto& [x, y, z] = mesh->positions[i];
        const auto& [nx, ny, nz] = mesh->normals[i];
        const auto [r, g, b] = mesh->AmbientWith(i, mix);
        // Virtual objects have no light in the case without them, but some have one behind them.
        const auto& lifts = mesh->sunlight.lifts;
        const auto [u, v, w] = mesh->is_phantom || mesh->IsTranslucent()
                                   ? mesh->AmbientWithout(i, mix)
                               : lifts.empty() ? std::array<float, 3>{}
                                               : lifts[i];
        Texel* texels = next + kTexelsPerVertex * i;
        texels[0] = {x, y, z, nx};
        texels[1] = {r, g, b, ny};
        texels[2] = {u, v, w, nz};
      }
    });
    next += kTexelsPerVertex * size;
  }
  return UploadRows(vertex_texels_, kVerticesPerRow * kTexelsPerVertex, GL_RGBA32F, GL_RGBA,
                    GL_FLOAT, &vertices_);
}

Result<void> VisibilityBuffer::SetTriangles(std::span<const SortedTriangles> meshes) {
  texels_.clear();
  linear_ratio_texels_.clear();
  first_ids_.clear();
  for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
    const std::size_t first_triangle = texels_.size();
    first_ids_.push_back(static_cast<int>(first_triangle) + 1);
    const std::uint32_t first = first_vertices_[mesh];
    const auto& [indices, ends, linear_ratios, first_ratio] = meshes[mesh];
    std::uint32_t kind = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(ends.back()); i += 3) {
      while (i >= static_cast<std::size_t>(ends[kind])) ++kind;
      texels_.push_back({first + indices[i], first + indices[i + 1], first + indices[i + 2],
                         kind | components_[first + indices[i]] << kKindBits});
    }
    if (linear_ratios.empty()) continue;
    linear_ratio_texels_.resize(first_triangle + first_ratio);
    linear_ratio_texels_.insert(linear_ratio_texels_.end(), linear_ratios.begin(),
                                linear_ratios.end());
  }
  PLEINAIR_RETURN_IF_ERROR(UploadRows(linear_ratio_texels_, kLinearRatiosPerRow, GL_RGBA32F,
                                      GL_RGBA, GL_FLOAT, &linear_ratios_,
                                      LinearShadowRatio::kTexels));
  return UploadRows(texels_, kTrianglesPerRow, GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                    &triangles_);
}

void VisibilityBuffer::Bind() const {
  triangles_.Bind(1);
  vertices_.Bind(6);
  values_.Bind(7);
}

}  // namespace pleinair::compositor
