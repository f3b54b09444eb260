#include "compositor/passes/place_mean.h"

#include <epoxy/gl.h>

#include "compositor/surfaces/sample_places.h"

namespace pleinair::compositor {

Result<PlaceMean> PlaceMean::Create(int width, int height, const Antialiasing& antialiasing) {
  PlaceMean mean;
  if (antialiasing.DrawnPlaces() == 1) return mean;
  mean.places_ = SamplePlaces(antialiasing.places);
  PLEINAIR_ASSIGN_OR_RETURN(mean.ratio_, gl::GlTexture::Create2D(GL_RGBA32F, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(mean.objects_, gl::GlTexture::Create2D(GL_RGBA32F, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(mean.sums_,
                            gl::GlFramebuffer::Create({{{&mean.ratio_}, {&mean.objects_}}, {}}));
  PLEINAIR_ASSIGN_OR_RETURN(
      mean.program_, gl::GlProgram::Create({.vertex = "compositor/shaders/screen_triangle.vert",
                                            .fragment = "compositor/shaders/place_mean.frag"}));
  mean.no_attributes_ = gl::GlVertexArray::Create();
  return mean;
}

void PlaceMean::Copy(const gl::GlTexture& ratio, const gl::GlTexture& objects, float weight,
                     std::span<const PixelRect> within) const {
  no_attributes_.Bind();
  ratio.Bind(0);
  objects.Bind(1);
  program_.Use();
  program_.Set("u_weight", weight);
  DrawWithin(within);
}

void PlaceMean::Draw(const RenderTargets& targets, const FrameUniforms& frame,
                     std::span<const PixelRect> within,
                     const std::function<void(const FrameUniforms&)>& draw) const {
  if (places_.empty()) {
    draw(frame);
    return;
  }
  sums_.Bind();
  sums_.ClearColor(0, 0, 0, 0, 0);
  sums_.ClearColor(1, 0, 0, 0, 0);
  // Powers of two: the mean of equal ratios is exact, so that unaffected pixels keep their bytes.
  const float weight = 1.0F / static_cast<float>(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    draw(frame.SeenThrough(places_[i], {sums_.width(), sums_.height()}, static_cast<int>(i),
                           static_cast<int>(places_.size())));
    sums_.Bind();
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    Copy(targets.ratio(), targets.objects(), weight, within);
    glDisable(GL_BLEND);
  }
  targets.BeginPass(true);
  Copy(ratio_, objects_, 1.0F, within);
}

}  // namespace pleinair::compositor
