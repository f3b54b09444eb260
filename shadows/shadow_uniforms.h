#pragma once

#include <cstddef>
#include <glm/glm.hpp>

namespace pleinair::shadows {

constexpr int kMaxPartitions = 4;
/// First binding points used by shadow_visibility.glsl; each set uses one block and two textures.
constexpr int kUniformBlockBinding = 8;
constexpr int kTextureUnit = 8;
/// First unit of the textures with the casters' edges, one a set.
constexpr int kEdgeTextureUnit = 24;

/// Mirrors ShadowSlice in shadows/shaders/shadow_visibility.glsl (std140).
struct ShadowSliceUniforms {
  glm::vec4 u_from_marker;
  glm::vec4 v_from_marker;
  glm::vec4 depth_from_marker;
  glm::vec4 size;
};

/// Mirrors ShadowBlock in the same file.
struct ShadowUniforms {
  ShadowSliceUniforms slices[kMaxPartitions];
  glm::vec4 light_u;
  glm::vec4 light_v;
  glm::vec4 to_sun;
  glm::vec4 settings;
};
static_assert(offsetof(ShadowSliceUniforms, size) == 48);
static_assert(offsetof(ShadowUniforms, light_u) == 256);
static_assert(offsetof(ShadowUniforms, settings) == 304);
static_assert(sizeof(ShadowUniforms) == 320);

}  // namespace pleinair::shadows
