#include "compositor/lens/lens_views.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "compositor/lens/lens_view.h"
#include "compositor/lens/nearest_fill.h"

namespace pleinair::compositor {
namespace {

// Shares of the views that count as occluded and as showing an object.
constexpr float kMinShare = 0.02F;

Image<float> Downloaded(const gl::GlTexture& texture, GLenum format, int channels) {
  Image<float> image(texture.width(), texture.height(), channels);
  texture.Download(format, GL_FLOAT, std::as_writable_bytes(std::span(image.data(), image.size())));
  return image;
}

}  // namespace

float WeightOfView(std::size_t view, std::size_t count) {
  constexpr std::size_t kUnits = std::size_t{1} << 20U;
  const std::size_t units = (view + 1) * kUnits / count - view * kUnits / count;
  return static_cast<float>(units) / static_cast<float>(kUnits);
}

Result<LensViews> LensViews::Create(int width, int height) {
  LensViews views;
  for (gl::GlTexture* sum : {&views.sums_.ratio, &views.sums_.objects}) {
    PLEINAIR_ASSIGN_OR_RETURN(*sum, gl::GlTexture::Create2D(GL_RGBA32F, width, height));
  }
  PLEINAIR_ASSIGN_OR_RETURN(views.sums_.distance, gl::GlTexture::Create2D(GL_RG32F, width, height));
  for (gl::GlTexture* single : {&views.sums_.share, &views.virtual_}) {
    PLEINAIR_ASSIGN_OR_RETURN(*single, gl::GlTexture::Create2D(GL_R32F, width, height));
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      views.sums_.pictures,
      gl::GlFramebuffer::Create(
          {{{&views.sums_.ratio}, {&views.sums_.objects}, {&views.sums_.distance}}, {}}));
  PLEINAIR_ASSIGN_OR_RETURN(views.sums_.occluders,
                            gl::GlFramebuffer::Create({{{&views.sums_.share}}, {}}));
  const auto create = [](const char* fragment) {
    return gl::GlProgram::Create(
        {.vertex = "compositor/shaders/screen_triangle.vert", .fragment = fragment});
  };
  PLEINAIR_ASSIGN_OR_RETURN(views.programs_.view, create("compositor/shaders/lens_view.frag"));
  PLEINAIR_ASSIGN_OR_RETURN(views.programs_.copy, create("compositor/shaders/place_mean.frag"));
  PLEINAIR_ASSIGN_OR_RETURN(views.programs_.occluders,
                            create("compositor/shaders/lens_occluders.frag"));
  views.no_attributes_ = gl::GlVertexArray::Create();
  return views;
}

void LensViews::AddViews(const RenderTargets& targets, const AveragedViews& views,
                         std::span<const PixelRect> within, const DrawFrame& draw,
                         const gl::GlFramebuffer& sums, const gl::GlProgram& program,
                         const BindInputs& bind) const {
  const std::size_t count = views.frames.size();
  for (std::size_t i = 0; i < count; ++i) {
    draw(views.frames[i]);
    sums.Bind();
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    no_attributes_.Bind();
    targets.depth().Bind(0);
    bind();
    program.Use();
    SetLensDepth(program, views.planes, targets.samples());
    program.Set("u_weight", WeightOfView(i, count));
    DrawWithin(within);
    glDisable(GL_BLEND);
  }
}

void LensViews::Draw(const RenderTargets& targets, const AveragedViews& views,
                     std::span<const PixelRect> within, const DrawFrame& draw) const {
  sums_.pictures.Bind();
  for (const int sum : {0, 1, 2}) sums_.pictures.ClearColor(sum, 0, 0, 0, 0);
  AddViews(targets, views, within, draw, sums_.pictures, programs_.view, [&] {
    targets.ratio().Bind(1);
    targets.objects().Bind(2);
    targets.ids().Bind(3);
  });
  targets.BeginPass(true);
  sums_.ratio.Bind(0);
  sums_.objects.Bind(1);
  programs_.copy.Use();
  programs_.copy.Set("u_weight", 1.0F);
  DrawWithin(within);
}

ObjectDistances LensViews::Distances() const {
  const Image<float> sums = Downloaded(sums_.distance, GL_RG, 2);
  ObjectDistances objects{Image<float>(sums.width(), sums.height()),
                          Image<float>(sums.width(), sums.height())};
  for (std::size_t i = 0; i < objects.share.size(); ++i) {
    const float share = sums.data()[2 * i + 1];
    objects.share.data()[i] = share;
    if (share > 0.0F) objects.dioptres.data()[i] = sums.data()[2 * i] / share;
  }
  return objects;
}

bool LensViews::MeasureOccluders(const RenderTargets& targets, const AveragedViews& views,
                                 std::span<const PixelRect> within, const ObjectDistances& objects,
                                 const DrawFrame& draw_real) {
  virtual_.Upload(GL_RED, GL_FLOAT, FillFromNearest(objects.dioptres, objects.share).data());

  sums_.occluders.Bind();
  sums_.occluders.ClearColor(0, 0, 0, 0, 0);
  AddViews(targets, views, within, draw_real, sums_.occluders, programs_.occluders,
           [&] { virtual_.Bind(1); });
  const Image<float> occluded = Downloaded(sums_.share, GL_RED, 1);
  for (std::size_t i = 0; i < occluded.size(); ++i) {
    if (occluded.data()[i] > kMinShare && objects.share.data()[i] > kMinShare) return true;
  }
  return false;
}

}  // namespace pleinair::compositor
