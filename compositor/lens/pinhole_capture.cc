#include "compositor/lens/pinhole_capture.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "compositor/lens/lens_view.h"

namespace pleinair::compositor {
namespace {

Image<float> Downloaded(const gl::GlTexture& texture) {
  Image<float> image(texture.width(), texture.height(), 4);
  texture.Download(GL_RGBA, GL_FLOAT,
                   std::as_writable_bytes(std::span(image.data(), image.size())));
  return image;
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
  PLEINAIR_ASSIGN_OR_RETURN(capture.target_,
                            gl::GlFramebuffer::Create({{{&capture.dioptres_}}, {}}));
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
  no_attributes_.Bind();
  targets.depth().Bind(0);
  targets.ids().Bind(3);
  program_.Use();
  SetLensDepth(program_, view, targets.samples());
  DrawWithin(within);
  return Downloaded(dioptres_);
}

PinholeImage PinholeCapture::Capture(const RenderTargets& targets, const shadows::View& view,
                                     std::span<const PixelRect> within) const {
  PinholeImage image{.ratio = Downloaded(targets.ratio()),
                     .objects = Downloaded(targets.objects()),
                     .objects_alone = {},
                     .dioptres = Dioptres(targets, view, within)};
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
  objects.shade(tiles);
  const Image<float> colors = Downloaded(targets.objects());
  FillBetweenSamples(colors, tiles, &alone);
  image->objects_alone = image->objects;
  for (const PixelRect& rect : tiles) {
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
      std::copy_n(&colors(rect.x, y), static_cast<std::ptrdiff_t>(4) * rect.width,
                  &image->objects_alone(rect.x, y));
      for (int x = rect.x; x < rect.x + rect.width; ++x) {
        image->dioptres(x, y, PinholeImage::kObject) = alone(x, y, PinholeImage::kObject);
      }
    }
  }
}

}  // namespace pleinair::compositor
