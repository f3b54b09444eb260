#include "compositor/surfaces/surface_buffers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>

namespace pleinair::compositor {
namespace {

struct Vertex {
  std::array<float, 3> position;
  std::array<float, 2> uv;
};

std::vector<Vertex> VerticesOf(const LitMesh& mesh) {
  std::vector<Vertex> vertices(mesh.positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i].position = mesh.positions[i];
    if (!mesh.texturing.uvs.empty()) vertices[i].uv = mesh.texturing.uvs[i];
  }
  return vertices;
}

}  // namespace

Result<SurfaceBuffers> SurfaceBuffers::Create(const LitMesh& mesh) {
  const std::vector<Vertex> vertices = VerticesOf(mesh);
  SurfaceBuffers surface;
  surface.is_phantom_ = mesh.is_phantom;
  surface.placed_model_ = mesh.placed_model;
  surface.material_ = mesh.material;
  surface.role_ = mesh.role;
  surface.index_count_ = static_cast<int>(mesh.indices.size());
  PLEINAIR_ASSIGN_OR_RETURN(surface.vertices_,
                            gl::GlBuffer::FromSpan(std::span<const Vertex>(vertices)));
  PLEINAIR_ASSIGN_OR_RETURN(surface.indices_,
                            gl::GlBuffer::FromSpan(std::span<const std::uint32_t>(mesh.indices)));
  surface.vertex_array_ = gl::GlVertexArray::Create();
  gl::GlVertexArray& array = surface.vertex_array_;
  constexpr int kStride = sizeof(Vertex);
  array.SetFloatAttribute(0, 3, surface.vertices_, kStride, offsetof(Vertex, position));
  array.SetFloatAttribute(1, 2, surface.vertices_, kStride, offsetof(Vertex, uv));
  array.SetElementBuffer(surface.indices_);
  surface.is_back_ = mesh.texturing.is_back;
  if (const auto& details = mesh.texturing.details; !details.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(surface.details_,
                              gl::GlBuffer::FromSpan(std::span<const VertexDetail>(details)));
    constexpr int kDetailStride = sizeof(VertexDetail);
    array.SetFloatAttribute(2, 2, surface.details_, kDetailStride, offsetof(VertexDetail, uv));
    array.SetFloatAttribute(3, 4, surface.details_, kDetailStride, offsetof(VertexDetail, color));
  }
  return surface;
}

void SurfaceBuffers::SetVertices(const LitMesh& mesh) {
  const std::vector<Vertex> vertices = VerticesOf(mesh);
  vertices_.Update(vertices.data(), vertices.size() * sizeof(Vertex));
}

void SurfaceBuffers::SetIndices(std::span<const std::uint32_t> indices) {
  indices_.Update(indices.data(), indices.size_bytes());
}

void SurfaceBuffers::Draw(int begin, int end) const {
  if (begin == end) return;
  vertex_array_.Bind();
  const std::uintptr_t offset = static_cast<std::uintptr_t>(begin) * sizeof(std::uint32_t);
  // OpenGL takes an offset into the element buffer as a pointer.
  glDrawElements(GL_TRIANGLES, end - begin, GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr)
}

Result<std::vector<gl::GlTexture>> UploadTextures(const Model& model) {
  std::vector<gl::GlTexture> textures;
  textures.reserve(model.textures.size());
  for (std::size_t i = 0; i < model.textures.size(); ++i) {
    const Image<std::uint8_t>& picture = model.textures[i];
    const auto index = static_cast<int>(i);
    const bool linear = std::ranges::any_of(model.materials, [&](const Material& m) {
      return m.metallic_roughness_texture == index || m.detail.normal_map.texture == index;
    });
    const auto longest = static_cast<unsigned>(std::max(picture.width(), picture.height()));
    PLEINAIR_ASSIGN_OR_RETURN(
        gl::GlTexture texture,
        gl::GlTexture::Create2D(linear ? GL_RGBA8 : GL_SRGB8_ALPHA8, picture.width(),
                                picture.height(), static_cast<int>(std::bit_width(longest))));
    texture.Upload(picture.channels() == 4 ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE, picture.data());
    texture.GenerateMipmaps();
    texture.SetFilter(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
    texture.SetWrap(GL_REPEAT);
    textures.push_back(std::move(texture));
  }
  return textures;
}

}  // namespace pleinair::compositor
