#pragma once

#include <cstddef>
#include <vector>

#include "base/error.h"
#include "compositor/models/model.h"
#include "compositor/models/placed_model.h"
#include "gl/texture.h"

namespace pleinair::compositor {

/// The materials of a scene's models, with their textures in the renderer's memory. Needs a current
/// OpenGL context; move-only.
class SceneMaterials {
 public:
  SceneMaterials() = default;
  /// Errors as UploadTextures().
  static Result<SceneMaterials> Create(const std::vector<PlacedModel>& scene);

  const Material& Of(int placed_model, int material) const {
    return scene_[static_cast<std::size_t>(placed_model)]
        .model->materials[static_cast<std::size_t>(material)];
  }
  /// Binds a material's base color to unit 0, metallic and roughness to unit 1: white where it has
  /// no texture of them.
  void BindTextures(int placed_model, const Material& material) const;

  std::size_t model_count() const { return scene_.size(); }
  /// Some of the objects have textures or alpha.
  bool HasTextures() const { return has_textures_; }
  /// Some mirror their surroundings: a metal or a coat does.
  bool HasGloss() const { return has_gloss_; }
  /// Some have holes or are glass.
  bool HasAlpha() const { return has_alpha_; }

 private:
  std::vector<PlacedModel> scene_;
  bool has_textures_ = false, has_alpha_ = false, has_gloss_ = false;
  gl::GlTexture white_;
  std::vector<std::vector<gl::GlTexture>> model_textures_;  // A list a placed model.
};

}  // namespace pleinair::compositor
