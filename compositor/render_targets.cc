#include "compositor/render_targets.h"

#include <algorithm>

namespace pleinair::compositor {
namespace {

// Mesa's software renderer stops at 4.
constexpr int kSamples = 4;

}  // namespace

Result<RenderTargets> RenderTargets::Create(int width, int height) {
  GLint most_samples = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
  const int samples = std::min(kSamples, static_cast<int>(most_samples));
  RenderTargets targets;
  PLEINAIR_ASSIGN_OR_RETURN(targets.ratio_samples_,
                            gl::GlTexture::Create2DMultisample(GL_RGBA16F, width, height, samples));
  PLEINAIR_ASSIGN_OR_RETURN(targets.objects_samples_,
                            gl::GlTexture::Create2DMultisample(GL_RGBA16F, width, height, samples));
  PLEINAIR_ASSIGN_OR_RETURN(
      targets.depth_samples_,
      gl::GlTexture::Create2DMultisample(GL_DEPTH_COMPONENT32F, width, height, samples));
  PLEINAIR_ASSIGN_OR_RETURN(targets.ratio_, gl::GlTexture::Create2D(GL_RGBA16F, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(targets.objects_, gl::GlTexture::Create2D(GL_RGBA16F, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(
      targets.draw_,
      gl::GlFramebuffer::Create(
          {{{&targets.ratio_samples_}, {&targets.objects_samples_}}, {&targets.depth_samples_}}));
  PLEINAIR_ASSIGN_OR_RETURN(targets.ratio_source_,
                            gl::GlFramebuffer::Create({{{&targets.ratio_samples_}}, {}}));
  PLEINAIR_ASSIGN_OR_RETURN(targets.objects_source_,
                            gl::GlFramebuffer::Create({{{&targets.objects_samples_}}, {}}));
  PLEINAIR_ASSIGN_OR_RETURN(targets.ratio_target_,
                            gl::GlFramebuffer::Create({{{&targets.ratio_}}, {}}));
  PLEINAIR_ASSIGN_OR_RETURN(targets.objects_target_,
                            gl::GlFramebuffer::Create({{{&targets.objects_}}, {}}));
  for (gl::GlTexture* passed : {&targets.passed_ratio_, &targets.passed_objects_}) {
    PLEINAIR_ASSIGN_OR_RETURN(*passed, gl::GlTexture::Create2D(GL_RGBA16F, width, height));
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      targets.pass_,
      gl::GlFramebuffer::Create({{{&targets.passed_ratio_}, {&targets.passed_objects_}}, {}}));
  PLEINAIR_ASSIGN_OR_RETURN(
      targets.back_, gl::GlFramebuffer::Create({{{&targets.ratio_}, {&targets.objects_}}, {}}));
  return targets;
}

void RenderTargets::BeginPass(bool back) const { (back ? back_ : pass_).Bind(); }

void RenderTargets::BeginDrawing() const {
  draw_.Bind();
  draw_.ClearColor(0, 1, 1, 1, 1);
  draw_.ClearColor(1, 0, 0, 0, 0);
  draw_.ClearDepth(1.0F);
}

void RenderTargets::Resolve() const {
  ratio_source_.BlitTo(ratio_target_);
  objects_source_.BlitTo(objects_target_);
}

}  // namespace pleinair::compositor
