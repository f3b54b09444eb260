#include "compositor/passes/render_targets.h"

#include <algorithm>
#include <array>

namespace pleinair::compositor {
namespace {

constexpr std::array<GLenum, 3> kSampledFormats{GL_R32UI, GL_RGBA16F, GL_DEPTH_COMPONENT32F};

}  // namespace

// More than kWantedSamples are not asked for: Mesa's software renderer stops there, and so do the
// shaders.
int RenderTargets::SamplesGiven() {
  int samples = kWantedSamples;
  for (const GLenum format : kSampledFormats) {
    GLint maximum = 1;
    glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, format, GL_SAMPLES, 1, &maximum);
    samples = std::min(samples, static_cast<int>(maximum));
  }
  return samples;
}

Result<RenderTargets> RenderTargets::Create(int width, int height) {
  const int samples = SamplesGiven();
  RenderTargets targets;
  const auto create_samples = [&](GLenum format) {
    return gl::GlTexture::Create2DMultisample(format, width, height, samples);
  };
  PLEINAIR_ASSIGN_OR_RETURN(targets.ids_, create_samples(kSampledFormats[0]));
  PLEINAIR_ASSIGN_OR_RETURN(targets.texels_, create_samples(kSampledFormats[1]));
  PLEINAIR_ASSIGN_OR_RETURN(targets.depth_samples_, create_samples(kSampledFormats[2]));
  PLEINAIR_ASSIGN_OR_RETURN(targets.seen_, gl::GlTexture::Create2D(GL_RGBA32UI, width, height));
  targets.seen_.SetFilter(GL_NEAREST, GL_NEAREST);
  PLEINAIR_ASSIGN_OR_RETURN(targets.kinds_,
                            gl::GlTexture::Create2D(GL_DEPTH_COMPONENT32F, width, height));
  for (gl::GlTexture* picture :
       {&targets.ratio_, &targets.objects_, &targets.passed_ratio_, &targets.passed_objects_}) {
    PLEINAIR_ASSIGN_OR_RETURN(*picture, gl::GlTexture::Create2D(GL_RGBA16F, width, height));
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      targets.draw_ids_, gl::GlFramebuffer::Create({{{&targets.ids_}}, {&targets.depth_samples_}}));
  PLEINAIR_ASSIGN_OR_RETURN(targets.draw_ids_and_texels_,
                            gl::GlFramebuffer::Create({{{&targets.ids_}, {&targets.texels_}},
                                                       {&targets.depth_samples_}}));
  PLEINAIR_ASSIGN_OR_RETURN(targets.sort_,
                            gl::GlFramebuffer::Create({{{&targets.seen_}}, {&targets.kinds_}}));
  PLEINAIR_ASSIGN_OR_RETURN(targets.draw_objects_,
                            gl::GlFramebuffer::Create({{{&targets.objects_}}, {&targets.kinds_}}));
  PLEINAIR_ASSIGN_OR_RETURN(targets.draw_ratio_,
                            gl::GlFramebuffer::Create({{{&targets.ratio_}}, {&targets.kinds_}}));
  PLEINAIR_ASSIGN_OR_RETURN(
      targets.draw_ratio_and_airlight_,
      gl::GlFramebuffer::Create({{{&targets.ratio_}, {&targets.objects_}}, {&targets.kinds_}}));
  PLEINAIR_ASSIGN_OR_RETURN(
      targets.pass_,
      gl::GlFramebuffer::Create({{{&targets.passed_ratio_}, {&targets.passed_objects_}}, {}}));
  PLEINAIR_ASSIGN_OR_RETURN(
      targets.back_, gl::GlFramebuffer::Create({{{&targets.ratio_}, {&targets.objects_}}, {}}));
  return targets;
}

void RenderTargets::BeginSurfaces() const {
  draw_ids_.Bind();
  draw_ids_.ClearUnsigned(0, 0);
  draw_ids_.ClearDepth(1.0F);
}

void RenderTargets::BeginObjectIds(bool textured) const {
  (textured ? draw_ids_and_texels_ : draw_ids_).Bind();
}

void RenderTargets::BeginSorting() const { sort_.Bind(); }

void RenderTargets::BeginObjects() const {
  draw_objects_.Bind();
  draw_objects_.ClearColor(0, 0, 0, 0, 0);
}

void RenderTargets::BeginRatio() const {
  draw_ratio_.Bind();
  draw_ratio_.ClearColor(0, 1, 1, 1, 1);
}

void RenderTargets::BeginAirlight() const { draw_ratio_and_airlight_.Bind(); }

void RenderTargets::BeginPass(bool back) const { (back ? back_ : pass_).Bind(); }

}  // namespace pleinair::compositor
