#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <span>
#include <vector>

#include "base/error.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/models/model.h"
#include "gl/buffer.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"

namespace pleinair::compositor {

/// A mesh in GPU memory for shaders/scene_surface.vert: its geometry without its light, which
/// VisibilityBuffer has.
class SurfaceBuffers {
 public:
  static Result<SurfaceBuffers> Create(const LitMesh& mesh);

  /// Moves the vertices to those of a mesh with as many.
  void SetVertices(const LitMesh& mesh);
  /// Replaces the indices by as many others.
  void SetIndices(std::span<const std::uint32_t> indices);

  void Draw() const { Draw(0, index_count_); }
  /// Draws the indices in [begin, end).
  void Draw(int begin, int end) const;
  bool is_phantom() const { return is_phantom_; }
  /// Returns whether it belongs to a virtual object and is visible.
  bool IsDrawnObject() const { return !is_phantom_ && role_ != MeshRole::kShadowOnly; }
  bool CastsShadow() const { return role_ != MeshRole::kRenderOnly; }
  int placed_model() const { return placed_model_; }
  int material() const { return material_; }
  /// As MeshTexturing::is_back.
  bool is_back() const { return is_back_; }
  const gl::GlVertexArray& vertex_array() const { return vertex_array_; }
  int index_count() const { return index_count_; }

 private:
  bool is_phantom_ = false;
  int placed_model_ = 0;
  int material_ = 0;
  MeshRole role_ = MeshRole::kAll;
  int index_count_ = 0;
  bool is_back_ = false;
  gl::GlBuffer vertices_;
  gl::GlBuffer details_;  // Empty if the vertices have none.
  gl::GlBuffer indices_;
  gl::GlVertexArray vertex_array_;
};

/// Uploads a model's textures, mip-mapped and repeating. Color textures are decoded from sRGB.
Result<std::vector<gl::GlTexture>> UploadTextures(const Model& model);

}  // namespace pleinair::compositor
