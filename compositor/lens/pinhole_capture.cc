#include "compositor/lens/pinhole_capture.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "compositor/lens/lens_view.h"

namespace pleinair::compositor {
namespace {

/// The rectangle around others.
PixelRect BoundsOf(std::span<const PixelRect> within) {
  if (within.empty()) return {};
  int left = within[0].x, top = within[0].y, right = left, bottom = top;
  for (const PixelRect& rect : within) {
    left = std::min(left, rect.x);
    top = std::min(top, rect.y);
    right = std::max(right, rect.x + rect.width);
    bottom = std::max(bottom, rect.y + rect.height);
  }
  return {left, top, right - left, bottom - top};
}

/// The texture in the rectangle around `within`, and `image` beside that.
Image<float> DownloadedInto(Image<float> image, const gl::GlTexture& texture,
                            std::span<const PixelRect> within) {
  const int channels = image.channels();
  const PixelRect part = BoundsOf(within);
  texture.DownloadPart(part.x, part.y, part.width, part.height, channels == 4 ? GL_RGBA : GL_RG,
                       GL_FLOAT, channels * static_cast<int>(sizeof(float)),
                       std::as_writable_bytes(std::span(image.data(), image.size())));
  return image;
}

/// The texture, 0 beside the rectangle.
Image<float> Downloaded(const gl::GlTexture& texture, std::span<const PixelRect> within,
                        int channels = 4) {
  return DownloadedInto(Image<float>(texture.width(), texture.height(), channels), texture, within);
}

/// The ratio, beside the rectangle as where it is not drawn: 1, with alpha 0.
Image<float> DownloadedRatio(const RenderTargets& targets, std::span<const PixelRect> within) {
  const gl::GlTexture& texture = targets.ratio();
  Image<float> ratio(texture.width(), texture.height(), 4);
  for (std::size_t i = 0; i < ratio.size(); ++i) ratio.data()[i] = i % 4 == 3 ? 0.0F : 1.0F;
  return DownloadedInto(std::move(ratio), texture, within);
}

/// Fills in the distances of surfaces whose part of a pixel lies between the renderer's samples,
/// from the pixels beside it. `objects`: their coverage.
void FillBetweenSamples(const Image<float>& objects, std::span<const PixelRect> within,
                        Image<float>* dioptres) {
  struct Filled {
    int x, y, channel;
    float dioptres;
  };
  std::vector<Filled> filled;
  const auto fill = [&](int x, int y, int channel) {
    float nearest = 0.0F;
    for (int v = std::max(0, y - 1); v <= std::min(objects.height() - 1, y + 1); ++v) {
      for (int u = std::max(0, x - 1); u <= std::min(objects.width() - 1, x + 1); ++u) {
        nearest = std::max(nearest, (*dioptres)(u, v, channel));
      }
    }
    filled.push_back({x, y, channel, nearest});
  };
  for (const PixelRect& rect : within) {
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
      for (int x = rect.x; x < rect.x + rect.width; ++x) {
        const float coverage = objects(x, y, 3);
        if (coverage <= 0.0F || coverage >= 1.0F) continue;
        for (const int channel :
             {PinholeImage::kObject, PinholeImage::kNearestReal, PinholeImage::kFarthestReal}) {
          if ((*dioptres)(x, y, channel) == 0.0F) fill(x, y, channel);
        }
      }
    }
  }
  for (const Filled& at : filled) (*dioptres)(at.x, at.y, at.channel) = at.dioptres;
}

bool HasOccluderEdge(const PinholeImage& image, const PixelRect& tile) {
  for (int y = tile.y; y < tile.y + tile.height; ++y) {
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      if (OccluderEdge(image, x, y) > 0.0F) return true;
    }
  }
  return false;
}

PixelRect Around(const PixelRect& tile, int width, int height) {
  const int x = std::max(0, tile.x - tile.width), y = std::max(0, tile.y - tile.height);
  return {x, y, std::min(width, tile.x + 2 * tile.width) - x,
          std::min(height, tile.y + 2 * tile.height) - y};
}

}  // namespace

Result<PinholeCapture> PinholeCapture::Create(int width, int height) {
  PinholeCapture capture;
  PLEINAIR_ASSIGN_OR_RETURN(capture.dioptres_, gl::GlTexture::Create2D(GL_RGBA32F, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(capture.object_parts_,
                            gl::GlTexture::Create2D(GL_RG32F, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(capture.behind_, gl::GlTexture::Create2D(GL_R32F, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(
      capture.target_,
      gl::GlFramebuffer::Create({{{&capture.dioptres_}, {&capture.object_parts_}}, {}}));
  PLEINAIR_ASSIGN_OR_RETURN(
      capture.program_,
      gl::GlProgram::Create({.vertex = "compositor/shaders/screen_triangle.vert",
                             .fragment = "compositor/shaders/lens_surfaces.frag"}));
  capture.no_attributes_ = gl::GlVertexArray::Create();
  return capture;
}

Image<float> PinholeCapture::Dioptres(const RenderTargets& targets, const shadows::View& view,
                                      std::span<const PixelRect> within) const {
  target_.Bind();
  target_.ClearColor(0, 0, 0, 1, 0);  // Nothing is known.
  target_.ClearColor(1, 1, 0, 0, 0);
  no_attributes_.Bind();
  targets.depth().Bind(0);
  targets.ids().Bind(3);
  program_.Use();
  SetLensDepth(program_, view, targets.samples());
  DrawWithin(within);
  return Downloaded(dioptres_, within);
}

PinholeImage PinholeCapture::Capture(const RenderTargets& targets, const shadows::View& view,
                                     std::span<const PixelRect> within) const {
  PinholeImage image{.ratio = DownloadedRatio(targets, within),
                     .objects = Downloaded(targets.objects(), within),
                     .objects_alone = {},
                     .dioptres = Dioptres(targets, view, within),
                     .object_parts = Downloaded(object_parts_, within, 2)};
  FillBetweenSamples(image.objects, within, &image.dioptres);
  return image;
}

void PinholeCapture::AddHidden(const RenderTargets& targets, const shadows::View& view,
                               std::span<const PixelRect> within, const ObjectDrawing& objects,
                               PinholeImage* image) const {
  const int width = image->objects.width(), height = image->objects.height();
  ImageTiles hidden(width, height), drawn = hidden;
  for (const PixelRect& rect : within) {
    drawn.Include({rect.x + 0.5F, rect.y + 0.5F},
                  {rect.x + rect.width - 0.5F, rect.y + rect.height - 0.5F});
  }
  for (const PixelRect& tile : TilesOf(within)) {
    if (!HasOccluderEdge(*image, tile)) continue;
    const PixelRect around = Around(tile, width, height);
    hidden.Include({around.x + 0.5F, around.y + 0.5F},
                   {around.x + around.width - 0.5F, around.y + around.height - 0.5F});
  }
  // Without the tiles that are not drawn.
  const std::vector<PixelRect> tiles = drawn.Without(drawn.Without(hidden)).Rectangles();
  if (tiles.empty()) return;
  objects.draw();
  Image<float> alone = Dioptres(targets, view, tiles);
  const Image<float> parts = Downloaded(object_parts_, tiles, 2);
  objects.shade(tiles);
  const Image<float> colors = Downloaded(targets.objects(), tiles);
  FillBetweenSamples(colors, tiles, &alone);
  image->objects_alone = image->objects;
  for (const PixelRect& rect : tiles) {
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
      std::copy_n(&colors(rect.x, y), static_cast<std::ptrdiff_t>(4) * rect.width,
                  &image->objects_alone(rect.x, y));
      for (int x = rect.x; x < rect.x + rect.width; ++x) {
        image->dioptres(x, y, PinholeImage::kObject) = alone(x, y, PinholeImage::kObject);
        std::copy_n(&parts(x, y), 2, &image->object_parts(x, y));
      }
    }
  }
}

HiddenImage PinholeCapture::CaptureBehind(const RenderTargets& targets, const shadows::View& view,
                                          const ImageTiles& tiles, const Image<float>& max_dioptres,
                                          const std::function<void(const BehindNearest&)>& draw) {
  behind_.Upload(GL_RED, GL_FLOAT, max_dioptres.data());
  draw({&behind_, static_cast<float>(1.0 / view.near_m), static_cast<float>(1.0 / view.far_m)});
  const std::vector<PixelRect> within = tiles.Rectangles();
  HiddenImage hidden{.ratio = DownloadedRatio(targets, within),
                     .objects = Downloaded(targets.objects(), within),
                     .dioptres = Dioptres(targets, view, within)};
  FillBetweenSamples(hidden.objects, within, &hidden.dioptres);
  return hidden;
}

}  // namespace pleinair::compositor
