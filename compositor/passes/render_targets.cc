#include "compositor/passes/render_targets.h"

#include <algorithm>
#include <array>

#include "compositor/coverage/pixel_pieces.h"

namespace pleinair::compositor {
namespace {

constexpr std::array<GLenum, 3> kSampledFormats{GL_R32UI, GL_RGBA16F, GL_DEPTH_COMPONENT32F};

}  // namespace

// Requests at most kWantedSamples: Mesa's software renderer and the shaders support no more.
int RenderTargets::SamplesGiven() {
  int samples = kWantedSamples;
  for (const GLenum format : kSampledFormats) {
    GLint maximum = 1;
    glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, format, GL_SAMPLES, 1, &maximum);
    samples = std::min(samples, static_cast<int>(maximum));
  }
  return samples;
}

Result<RenderTargets> RenderTargets::Create(int width, int height, const Content& content) {
  const int samples = SamplesGiven();
  RenderTargets targets;
  targets.content_ = content;
  const auto create_samples = [&](GLenum format) {
    return gl::GlTexture::Create2DMultisample(format, width, height, samples);
  };
  PLEINAIR_ASSIGN_OR_RETURN(targets.samples_.ids, create_samples(kSampledFormats[0]));
  PLEINAIR_ASSIGN_OR_RETURN(targets.samples_.texels, create_samples(kSampledFormats[1]));
  PLEINAIR_ASSIGN_OR_RETURN(targets.samples_.depth, create_samples(kSampledFormats[2]));
  PLEINAIR_ASSIGN_OR_RETURN(targets.seen_, gl::GlTexture::Create2D(GL_RGBA32UI, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(targets.weights_, gl::GlTexture::Create2D(GL_RG32UI, width, height));
  for (gl::GlTexture* of_pieces : {&targets.seen_, &targets.weights_}) {
    of_pieces->SetFilter(GL_NEAREST, GL_NEAREST);
  }
  PLEINAIR_ASSIGN_OR_RETURN(targets.kinds_,
                            gl::GlTexture::Create2D(GL_DEPTH_COMPONENT32F, width, height));
  for (gl::GlTexture* picture : {&targets.picture_.ratio, &targets.picture_.objects,
                                 &targets.passed_.ratio, &targets.passed_.objects}) {
    PLEINAIR_ASSIGN_OR_RETURN(*picture, gl::GlTexture::Create2D(GL_RGBA16F, width, height));
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      targets.framebuffers_.ids,
      gl::GlFramebuffer::Create({{{&targets.samples_.ids}}, {&targets.samples_.depth}}));
  gl::FramebufferAttachments with_texels{{{&targets.samples_.ids}, {&targets.samples_.texels}},
                                         {&targets.samples_.depth}};
  if (content.detailed) {
    for (gl::GlTexture* texels : {&targets.samples_.gradients, &targets.samples_.emissions}) {
      PLEINAIR_ASSIGN_OR_RETURN(*texels, create_samples(kSampledFormats[1]));
      with_texels.colors.push_back({texels});
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(targets.framebuffers_.ids_and_texels,
                            gl::GlFramebuffer::Create(with_texels));
  PLEINAIR_ASSIGN_OR_RETURN(
      targets.framebuffers_.sort,
      gl::GlFramebuffer::Create({{{&targets.seen_}, {&targets.weights_}}, {&targets.kinds_}}));
  gl::FramebufferAttachments of_objects{{{&targets.picture_.objects}}, {&targets.kinds_}};
  if (content.blended) {
    PLEINAIR_ASSIGN_OR_RETURN(targets.sample_weights_,
                              gl::GlTexture::Create2D(GL_R16F, width, height));
    of_objects.colors.push_back({&targets.sample_weights_});
  }
  PLEINAIR_ASSIGN_OR_RETURN(targets.framebuffers_.objects, gl::GlFramebuffer::Create(of_objects));
  PLEINAIR_ASSIGN_OR_RETURN(
      targets.framebuffers_.ratio,
      gl::GlFramebuffer::Create({{{&targets.picture_.ratio}}, {&targets.kinds_}}));
  PLEINAIR_ASSIGN_OR_RETURN(
      targets.framebuffers_.ratio_and_airlight,
      gl::GlFramebuffer::Create(
          {{{&targets.picture_.ratio}, {&targets.picture_.objects}}, {&targets.kinds_}}));
  PLEINAIR_ASSIGN_OR_RETURN(
      targets.framebuffers_.pass,
      gl::GlFramebuffer::Create({{{&targets.passed_.ratio}, {&targets.passed_.objects}}, {}}));
  PLEINAIR_ASSIGN_OR_RETURN(
      targets.framebuffers_.pass_back,
      gl::GlFramebuffer::Create({{{&targets.picture_.ratio}, {&targets.picture_.objects}}, {}}));
  // Targets that no objects are drawn into have weights, too.
  if (content.blended) targets.BeginObjects();
  return targets;
}

void RenderTargets::BeginSurfaces() const {
  // Without it, all samples of a pixel are those of its center.
  (content_.multisampled ? glEnable : glDisable)(GL_MULTISAMPLE);
  framebuffers_.ids.Bind();
  framebuffers_.ids.ClearUnsigned(0, 0);
  framebuffers_.ids.ClearDepth(1.0F);
}

void RenderTargets::BeginObjectIds(bool textured) const {
  (textured ? framebuffers_.ids_and_texels : framebuffers_.ids).Bind();
}

void RenderTargets::BeginSorting() const { framebuffers_.sort.Bind(); }

void RenderTargets::BeginObjects() const {
  framebuffers_.objects.Bind();
  framebuffers_.objects.ClearColor(0, 0, 0, 0, 0);
  if (content_.blended) {
    framebuffers_.objects.ClearColor(1, 1.0F / static_cast<float>(kWeightOfPixel), 0, 0, 0);
  }
}

void RenderTargets::BeginRatio(std::span<const PixelRect> drawn) const {
  framebuffers_.ratio.Bind();
  framebuffers_.ratio.ClearColor(0, 1, 1, 1, 0);
  glEnable(GL_SCISSOR_TEST);
  for (const auto& [x, y, width, height] : drawn) {
    glScissor(x, y, width, height);
    framebuffers_.ratio.ClearColor(0, 1, 1, 1, 1);
  }
  glDisable(GL_SCISSOR_TEST);
}

void RenderTargets::BeginAirlight() const { framebuffers_.ratio_and_airlight.Bind(); }

void RenderTargets::BeginPass(bool back) const {
  (back ? framebuffers_.pass_back : framebuffers_.pass).Bind();
  if (back) return;
  framebuffers_.pass.ClearColor(0, 1, 1, 1, 0);
  framebuffers_.pass.ClearColor(1, 0, 0, 0, 0);
}

void RenderTargets::Replace(const Image<float>& ratio, const Image<float>& objects) {
  picture_.ratio.Upload(GL_RGBA, GL_FLOAT, ratio.data());
  picture_.objects.Upload(GL_RGBA, GL_FLOAT, objects.data());
}

}  // namespace pleinair::compositor
