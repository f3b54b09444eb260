#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/models/leaf_material.h"
#include "compositor/models/model.h"
#include "compositor/models/placed_model.h"
#include "gl/texture.h"

namespace pleinair::compositor {

/// The materials of a scene's models, with their textures in GPU memory. Needs a current OpenGL
/// context; move-only.
class SceneMaterials {
 public:
  SceneMaterials() = default;
  /// Errors as UploadTextures().
  static Result<SceneMaterials> Create(const std::vector<PlacedModel>& scene);

  const Material& Of(int placed_model, int material) const {
    return scene_[static_cast<std::size_t>(placed_model)]
        .model->materials[static_cast<std::size_t>(material)];
  }
  const PlacedModel& Placed(int placed_model) const {
    return scene_[static_cast<std::size_t>(placed_model)];
  }
  /// Binds a material's textures. Unit 0 has the base color, unit 1 metallic and roughness, unit 2
  /// the normal map, unit 3 the emission. A missing texture is replaced by white.
  void BindTextures(int placed_model, const Material& material) const;

  /// Returns whether alpha decides where surfaces with a material are seen.
  bool HasHoles(int placed_model, int material) const;

  std::size_t model_count() const { return scene_.size(); }
  /// Returns whether an object has textures or alpha.
  bool HasTextures() const { return has_textures_; }
  /// Returns whether an object needs the permutation DETAILED of the shaders: it has normal maps,
  /// emission, layers, vertex details, unlit materials or several texture coordinates.
  bool HasDetails() const { return has_details_; }
  /// Returns whether an object is glossy: it has a metal or a coat.
  bool HasGloss() const { return has_gloss_; }
  /// Returns whether an object needs the permutation TRANSLUCENT of the shaders: it transmits light
  /// or is a leaf.
  bool HasTranslucent() const { return has_translucent_; }
  /// Sets the colors of sun and sky, linear Rec.709, by which leaves change theirs.
  void SetLight(LinearRgb sun, LinearRgb sky);
  /// How this light changes a material's colors; only leaves have any change.
  LeafTints TintsOf(int placed_model, int material) const;
  /// Returns whether an object has holes or glass.
  bool HasAlpha() const { return has_alpha_; }
  /// Returns whether an object needs the permutation BLENDED of the shaders: one has glass.
  bool HasBlended() const { return has_alpha_ && has_blended_; }

 private:
  std::vector<PlacedModel> scene_;
  bool has_textures_ = false, has_alpha_ = false, has_gloss_ = false, has_details_ = false;
  bool has_translucent_ = false, has_blended_ = false;
  std::map<std::pair<int, int>, LeafTints> tints_;  // Leaves, by placed model and material.
  gl::GlTexture white_;
  std::vector<std::vector<gl::GlTexture>> model_textures_;  // One list per placed model.
};

}  // namespace pleinair::compositor
