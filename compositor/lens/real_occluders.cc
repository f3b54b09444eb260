#include "compositor/lens/real_occluders.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "base/image.h"
#include "compositor/lens/nearest_fill.h"

namespace pleinair::compositor {
namespace {

// Pixels with more of the lens covered show the occluder alone.
constexpr float kAlone = 0.98F;
constexpr float kNotDrawn = 2.0F;

}  // namespace

Result<RealOccluders> RealOccluders::Create(int width, int height) {
  RealOccluders occluders;
  PLEINAIR_ASSIGN_OR_RETURN(occluders.frame_, gl::GlTexture::Create2D(GL_RGBA32F, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(occluders.background_,
                            gl::GlTexture::Create2D(GL_RGBA32F, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(occluders.occluders_,
                            gl::GlTexture::Create2D(GL_RGB32F, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(occluders.target_,
                            gl::GlFramebuffer::Create({{{&occluders.frame_}}, {}}));
  PLEINAIR_ASSIGN_OR_RETURN(
      occluders.program_,
      gl::GlProgram::Create({.vertex = "compositor/shaders/screen_triangle.vert",
                             .fragment = "compositor/shaders/lens_frame.frag"}));
  occluders.no_attributes_ = gl::GlVertexArray::Create();
  return occluders;
}

void RealOccluders::Estimate(const gl::GlTexture& share, std::span<const PixelRect> within) {
  target_.Bind();
  target_.ClearColor(0, 0, 0, 0, kNotDrawn);
  no_attributes_.Bind();
  share.Bind(1);
  program_.Use();
  DrawWithin(within);
  Image<float> frame(frame_.width(), frame_.height(), 4);
  frame_.Download(GL_RGBA, GL_FLOAT, std::as_writable_bytes(std::span(frame.data(), frame.size())));
  Image<float> light(frame.width(), frame.height(), 3), free(frame.width(), frame.height());
  Image<float> covered(frame.width(), frame.height());
  for (std::size_t i = 0; i < free.size(); ++i) {
    const float* from = frame.data() + 4 * i;
    if (from[3] == kNotDrawn) continue;
    for (int c = 0; c < 3; ++c) light.data()[3 * i + c] = from[c];
    free.data()[i] = std::pow(1.0F - std::fmin(from[3], 1.0F), 8.0F);
    covered.data()[i] = from[3] > kAlone ? 1.0F : 0.0F;
  }
  const Image<float> occluders = FillFromNearest(light, covered);
  const bool is_known = std::ranges::any_of(std::span(covered.data(), covered.size()),
                                            [](float weight) { return weight > 0.0F; });
  // Pixels that show a little of the occluder would tint the background.
  for (std::size_t i = 0; i < free.size() && is_known; ++i) {
    const float hidden = std::fmin(frame.data()[4 * i + 3], 1.0F);
    if (free.data()[i] == 0.0F || hidden == 0.0F) continue;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      light.data()[c] =
          std::fmax((light.data()[c] - hidden * occluders.data()[c]) / (1.0F - hidden), 0.0F);
    }
  }
  const Image<float> behind = FillFromNearest(light, free);
  for (std::size_t i = 0; i < free.size(); ++i) {
    for (int c = 0; c < 3; ++c) frame.data()[4 * i + c] = behind.data()[3 * i + c];
  }
  background_.Upload(GL_RGBA, GL_FLOAT, frame.data());
  occluders_.Upload(GL_RGB, GL_FLOAT, occluders.data());
}

}  // namespace pleinair::compositor
