#pragma once

#include "base/error.h"
#include "gl/framebuffer.h"
#include "gl/texture.h"

namespace pleinair::compositor {

/// What the virtual picture is drawn into. Geometry has several samples a pixel; light on the real
/// surfaces is worked out once for each pixel and surface that it shows.
class RenderTargets {
 public:
  /// Errors (system): a size or format that the renderer cannot do.
  static Result<RenderTargets> Create(int width, int height);

  /// Draws go to the numbers of triangles, a sample each, and to their depth; cleared to 0.
  void BeginSurfaces() const;
  /// Draws go there still; `textured`: and to what textures leave of the base color (color 1).
  void BeginObjectIds(bool textured) const;
  /// Draws go, once a pixel, to what the numbers say of it, and its depth.
  void BeginSorting() const;
  /// Draws go to objects(), the objects' premultiplied display-linear color with coverage, with
  /// the depth that sorting gave; cleared to 0.
  void BeginObjects() const;
  /// Draws go to the differential ratio, cleared to 1, with the depth that sorting gave.
  void BeginRatio() const;
  /// After BeginRatio(): draws go to the ratio (color 0) and to objects() (color 1).
  void BeginAirlight() const;
  /// Where one pass over ratio() and objects() may be drawn into; `back`: from there into them.
  void BeginPass(bool back) const;
  const gl::GlTexture& passed_ratio() const { return passed_.ratio; }
  const gl::GlTexture& passed_objects() const { return passed_.objects; }

  /// Samples a pixel that geometry is meant to have; and those that the renderer whose context is
  /// current gives it, which may be fewer.
  static constexpr int kWantedSamples = 4;
  static int SamplesGiven();

  int samples() const { return samples_.ids.samples(); }
  const gl::GlTexture& ids() const { return samples_.ids; }
  const gl::GlTexture& texels() const { return samples_.texels; }
  const gl::GlTexture& seen() const { return seen_; }
  const gl::GlTexture& ratio() const { return picture_.ratio; }
  const gl::GlTexture& objects() const { return picture_.objects; }

 private:
  /// Several a pixel: of what geometry draws.
  struct Samples {
    gl::GlTexture ids, texels, depth;
  };
  /// One a pixel.
  struct VirtualPicture {
    gl::GlTexture ratio, objects;
  };
  /// Where draws go, by the function that begins them.
  struct Framebuffers {
    gl::GlFramebuffer ids, ids_and_texels, sort, objects;
    gl::GlFramebuffer ratio, ratio_and_airlight;
    gl::GlFramebuffer pass, pass_back;
  };

  Samples samples_;
  gl::GlTexture seen_, kinds_;
  VirtualPicture picture_, passed_;
  Framebuffers framebuffers_;
};

}  // namespace pleinair::compositor
