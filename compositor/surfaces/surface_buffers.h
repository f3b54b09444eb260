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

/// A mesh in the renderer's memory, for shaders/scene_surface.vert: where it is, not how it is lit
/// (VisibilityBuffer).
class SurfaceBuffers {
 public:
  static Result<SurfaceBuffers> Create(const LitMesh& mesh);

  /// Other indices of the same number.
  void SetIndices(std::span<const std::uint32_t> indices);

  void Draw() const { Draw(0, index_count_); }
  /// Draws the indices from `begin` to before `end`.
  void Draw(int begin, int end) const;
  bool is_phantom() const { return is_phantom_; }
  /// Of a virtual object, and to be seen.
  bool IsDrawnObject() const { return !is_phantom_ && role_ != MeshRole::kShadowOnly; }
  bool CastsShadow() const { return role_ != MeshRole::kRenderOnly; }
  int placed_model() const { return placed_model_; }
  int material() const { return material_; }
  const gl::GlVertexArray& vertex_array() const { return vertex_array_; }
  int index_count() const { return index_count_; }

 private:
  bool is_phantom_ = false;
  int placed_model_ = 0;
  int material_ = 0;
  MeshRole role_ = MeshRole::kAll;
  int index_count_ = 0;
  gl::GlBuffer vertices_;
  gl::GlBuffer indices_;
  gl::GlVertexArray vertex_array_;
};

/// A model's textures as the renderer samples them: those of colors decoded from sRGB, mip-mapped,
/// repeating.
Result<std::vector<gl::GlTexture>> UploadTextures(const Model& model);

}  // namespace pleinair::compositor
