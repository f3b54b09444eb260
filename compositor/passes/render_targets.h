#pragma once

#include <span>

#include "base/error.h"
#include "base/image.h"
#include "compositor/surfaces/image_tiles.h"
#include "gl/framebuffer.h"
#include "gl/texture.h"

namespace pleinair::compositor {

/// Framebuffers of the virtual image. Geometry has several samples per pixel. Light on the real
/// surfaces is evaluated once per pixel and visible surface.
class RenderTargets {
 public:
  struct Content {
    bool detailed = false;     ///< Also gradients() and emissions(), drawn with the texels.
    bool blended = false;      ///< Also sample_weights(), drawn with the objects.
    bool multisampled = true;  ///< Several samples per pixel, else its center alone.
  };
  /// Errors (system): a size or format that the renderer does not support.
  static Result<RenderTargets> Create(int width, int height, const Content& content);

  /// Directs drawing to the triangle numbers, one per sample, and their depth; cleared to 0.
  void BeginSurfaces() const;
  /// Directs drawing to the same targets. If `textured`, also to the base color texels (color 1),
  /// and if detailed, to gradients() and emissions() (colors 2 and 3).
  void BeginObjectIds(bool textured) const;
  /// Directs drawing to the classification of the triangle numbers, once per pixel, and its depth.
  void BeginSorting() const;
  /// Directs drawing to objects(): premultiplied display-linear color with coverage, cleared to 0.
  /// If blended, also to sample_weights() (color 1), cleared to those of pixels without objects.
  /// Uses the depth of the classification.
  void BeginObjects() const;
  /// Directs drawing to the shadow-catcher ratio, cleared to 1, with alpha 0 outside `drawn`. Uses
  /// the depth of the classification.
  void BeginRatio(std::span<const PixelRect> drawn) const;
  /// After BeginRatio(): directs drawing to the ratio (color 0) and to objects() (color 1).
  void BeginAirlight() const;
  /// Directs drawing to the targets of a pass over ratio() and objects(), cleared as ratio()
  /// with alpha 0 and objects(). If `back`, from those into ratio() and objects(), not cleared.
  void BeginPass(bool back) const;
  /// Replaces ratio() and objects(), four channels each.
  void Replace(const Image<float>& ratio, const Image<float>& objects);
  const gl::GlTexture& passed_ratio() const { return passed_.ratio; }
  const gl::GlTexture& passed_objects() const { return passed_.objects; }

  /// Wanted samples per pixel of geometry. SamplesGiven() returns the samples that the current
  /// context's renderer provides, which may be fewer.
  static constexpr int kWantedSamples = 4;
  static int SamplesGiven();

  /// Samples per pixel that are drawn.
  int samples() const { return content_.multisampled ? samples_.ids.samples() : 1; }
  const gl::GlTexture& ids() const { return samples_.ids; }
  /// Depth of ids(), per sample.
  const gl::GlTexture& depth() const { return samples_.depth; }
  const gl::GlTexture& texels() const { return samples_.texels; }
  /// Bumps of the surface (shaders/surface_gradient.glsl) and texels of its emission, per sample.
  const gl::GlTexture& gradients() const { return samples_.gradients; }
  const gl::GlTexture& emissions() const { return samples_.emissions; }
  /// Share of a pixel of each unit of weight beside objects (shaders/uncovered_samples.glsl).
  const gl::GlTexture& sample_weights() const { return sample_weights_; }
  const gl::GlTexture& seen() const { return seen_; }
  /// Weights of the pieces of surface in seen() (shaders/piece_weights.glsl).
  const gl::GlTexture& weights() const { return weights_; }
  const gl::GlTexture& ratio() const { return picture_.ratio; }
  const gl::GlTexture& objects() const { return picture_.objects; }

 private:
  /// Several per pixel, drawn by geometry.
  struct Samples {
    gl::GlTexture ids, texels, gradients, emissions, depth;
  };
  /// One per pixel.
  struct VirtualPicture {
    gl::GlTexture ratio, objects;
  };
  /// One per Begin function.
  struct Framebuffers {
    gl::GlFramebuffer ids, ids_and_texels, sort, objects;
    gl::GlFramebuffer ratio, ratio_and_airlight;
    gl::GlFramebuffer pass, pass_back;
  };

  Samples samples_;
  gl::GlTexture seen_, weights_, kinds_, sample_weights_;
  VirtualPicture picture_, passed_;
  Framebuffers framebuffers_;
  Content content_;
};

}  // namespace pleinair::compositor
