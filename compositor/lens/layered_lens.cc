#include "compositor/lens/layered_lens.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/parallel_for.h"
#include "compositor/lens/hidden_surfaces.h"
#include "compositor/lens/lens_layers.h"
#include "compositor/lens/pixel_surfaces.h"

namespace pleinair::compositor {
namespace {

static_assert(BlockLayers::kSide_px == ImageTiles::kSide_px);

// Coverage below which a layer counts as empty, and what rounding leaves of nothing.
constexpr float kNoCoverage = 1e-3F, kNothing = 2e-5F;

/// Collects the pieces of a block.
class PieceList {
 public:
  /// `drawn`: the part of the block that is needed.
  PieceList(const PixelRect& block, const PixelRect& drawn) : block_(block), drawn_(drawn) {}

  /// Returns a new piece without values; null if it does not reach what is needed.
  SurfacePiece* Add(int x, int y, float circle_px, PixelPart part) {
    const int left = x - block_.x, top = y - block_.y, reach = DiscKernels::Reach_px(circle_px);
    if (x + reach < drawn_.x || y + reach < drawn_.y || x - reach >= drawn_.x + drawn_.width ||
        y - reach >= drawn_.y + drawn_.height) {
      return nullptr;
    }
    SurfacePiece& piece = pieces_.emplace_back();
    piece.x = static_cast<std::int16_t>(left);
    piece.y = static_cast<std::int16_t>(top);
    piece.kernel = static_cast<std::int16_t>(DiscKernels::IndexOf(circle_px, part));
    piece.layer = static_cast<std::int16_t>(LayerOf(circle_px));
    return &piece;
  }
  std::vector<SurfacePiece> Take() { return std::move(pieces_); }

 private:
  PixelRect block_, drawn_;
  std::vector<SurfacePiece> pieces_;
};

void AddObject(const PixelSurfaces& surfaces, int x, int y, PieceList* list) {
  const PixelSurfaces::Depth& depth = surfaces.DepthAt(x, y);
  if (!depth.has_object) return;
  SurfacePiece* const piece = list->Add(x, y, depth.object_circle_px, surfaces.ObjectPart(x, y));
  if (piece == nullptr) return;
  // Surfaces in neighbouring layers are complete side by side.
  const bool is_seen_past_real = depth.object_layer >= depth.real_layer[0] + kLayersApart;
  std::copy_n(is_seen_past_real ? surfaces.WholeObject(x, y) : surfaces.Object(x, y), 4,
              piece->values);
}

void AddReal(const PixelSurfaces& surfaces, int x, int y, PieceList* list) {
  const PixelSurfaces::Depth& depth = surfaces.DepthAt(x, y);
  for (const int which : {0, 1}) {
    const bool is_occluder = surfaces.IsOccluder(depth.real_layer[which], x, y);
    const float part = surfaces.PartOf(which, x, y);
    if ((!is_occluder && !depth.has_change) || part == 0.0F) continue;
    SurfacePiece* const piece =
        list->Add(x, y, depth.real_circle_px[which], surfaces.RealPart(x, y));
    if (piece == nullptr) continue;
    for (int c = 0; c < 3; ++c) piece->values[4 + c] = part * surfaces.Change(x, y, c);
    if (is_occluder) piece->values[7] = surfaces.RealShare(which, x, y);
  }
}

/// The part of the image whose pixels reach into a block; without pixels where nothing is drawn.
PixelRect WindowOf(const PixelSurfaces& surfaces, const PixelRect& drawn) {
  if (drawn.width == 0) return {};
  const int reach = surfaces.ReachInto(drawn);
  return {drawn.x - reach, drawn.y - reach, drawn.width + 2 * reach, drawn.height + 2 * reach};
}

/// Takes what a pixel shows of a farther object out of its nearest one, which got the whole pixel.
/// The sum of both stays what the pixel shows, so that an inexact part of it matters little.
void TakeFromNearest(const PixelSurfaces& surfaces, const HiddenSurface& hidden, PieceList* list) {
  const float farther = 1.0F - surfaces.NearestPart(hidden.x, hidden.y);
  if (farther <= 0.0F) return;
  SurfacePiece* const piece =
      list->Add(hidden.x, hidden.y, surfaces.DepthAt(hidden.x, hidden.y).object_circle_px,
                surfaces.ObjectPart(hidden.x, hidden.y));
  if (piece == nullptr) return;
  for (int c = 0; c < 4; ++c) piece->values[c] = -farther * hidden.object[c];
}

void AddHidden(const HiddenSurface& hidden, PieceList* list) {
  if (std::ranges::any_of(hidden.object, [](float value) { return value != 0.0F; })) {
    SurfacePiece* const piece = list->Add(hidden.x, hidden.y, hidden.object_circle_px, {});
    if (piece != nullptr) std::copy_n(hidden.object, 4, piece->values);
  }
  SurfacePiece* const piece = list->Add(hidden.x, hidden.y, hidden.real_circle_px, {});
  if (piece != nullptr) std::copy_n(hidden.change, 3, piece->values + 4);
}

/// What a pixel shows of all layers.
struct Composed {
  float object[4] = {};
  float change[3] = {};
  float occluders = 0.0F;
};

Composed ComposePixel(const BlockLayers& layers, int x, int y) {
  Composed composed;
  int farthest_object = -1;
  for (const int layer : layers.layers()) {
    if (layers.At(layer, x, y)[3] > kNoCoverage) farthest_object = layer;
  }
  float before = 1.0F;   // What surfaces in front leave of the lens.
  float covered = 0.0F;  // The share of it that neighbouring layers cover so far.
  int last = -1;
  for (const int layer : layers.layers()) {
    const float* const sums = layers.At(layer, x, y);
    const float object = std::max(sums[3], 0.0F), occluder = std::max(sums[7], 0.0F);
    const float coverage = object + occluder;
    if (layer > last + 1) {
      before *= 1.0F - covered;
      covered = 0.0F;
    }
    if (coverage > kNoCoverage) last = layer;
    const float left = 1.0F - covered;
    const float part = before * (coverage > left ? left / coverage : 1.0F);
    for (int c = 0; c < 4; ++c) composed.object[c] += part * sums[c];
    for (int c = 0; c < 3; ++c) composed.change[c] += before * sums[4 + c];
    if (layer < farthest_object) composed.occluders += part * occluder;
    covered = std::min(covered + coverage, 1.0F);
  }
  return composed;
}

void WritePixel(const Composed& composed, int x, int y, LensImage* image) {
  float* const object = &image->objects(x, y);
  float* const ratio = &image->ratio(x, y);
  bool is_nothing = true;
  for (const float value : composed.object) is_nothing &= std::fabs(value) < kNothing;
  for (int c = 0; c < 4; ++c) object[c] = is_nothing ? 0.0F : std::max(composed.object[c], 0.0F);
  object[3] = std::min(object[3], 1.0F);
  for (int c = 0; c < 3; ++c) {
    const float change = composed.change[c];
    ratio[c] = std::fabs(change) < kNothing ? 1.0F : std::max(1.0F + change, 0.0F);
  }
  ratio[3] = 1.0F;
  image->occluder_share(x, y) = std::clamp(composed.occluders, 0.0F, 1.0F);
}

}  // namespace

void LayeredLens::Begin(const PinholeImage& image, const ThinLens& lens, double fx,
                        std::span<const PixelRect> within) {
  if (!kernels_ || kernels_->stop() != lens.stop) kernels_.emplace(lens.stop);
  lens_ = lens;
  fx_ = fx;
  image_ = &image;
  surfaces_.emplace(image, lens, fx, within);
  const std::vector<PixelRect> blocks = TilesOf(within);
  blocks_.assign(blocks.size(), {});
  ParallelFor(blocks.size(), 0, [&](std::size_t i) {
    Block& block = blocks_[i];
    block.pixels = blocks[i];
    block.drawn = surfaces_->DrawnPart(block.pixels);
    block.window = WindowOf(*surfaces_, block.drawn);
    if (block.window.width == 0) return;
    block.hiding = HidingPixels(*surfaces_, block.window, surfaces_->ReachInto(block.drawn));
  });
  const int width = image.ratio.width(), height = image.ratio.height();
  behind_ = {Image<float>(width, height), ImageTiles(width, height)};
  for (const Block& block : blocks_) {
    for (const HidingPixel& pixel : block.hiding) {
      if (!pixel.is_object) continue;
      const int x = std::clamp(pixel.x, 0, width - 1), y = std::clamp(pixel.y, 0, height - 1);
      behind_.max_dioptres(x, y) = BehindLayer_dioptres(lens, fx, pixel.layer);
      behind_.tiles.Include({x + 0.5F, y + 0.5F}, {x + 0.5F, y + 0.5F});
    }
  }
}

std::vector<SurfacePiece> LayeredLens::PiecesOf(const Block& block,
                                                const HiddenImage& hidden) const {
  PieceList list(block.pixels, block.drawn);
  for (int y = block.window.y; y < block.window.y + block.window.height; ++y) {
    for (int x = block.window.x; x < block.window.x + block.window.width; ++x) {
      AddObject(*surfaces_, x, y, &list);
      AddReal(*surfaces_, x, y, &list);
    }
  }
  for (const HidingPixel& pixel : block.hiding) {
    if (!pixel.is_object) continue;
    const HiddenSurface behind = BehindObject(hidden, lens_, fx_, pixel);
    AddHidden(behind, &list);
    TakeFromNearest(*surfaces_, behind, &list);
  }
  for (const HiddenSurface& surface : BehindRealSurfaces(*surfaces_, block.window, block.hiding)) {
    AddHidden(surface, &list);
  }
  return list.Take();
}

LensImage LayeredLens::Draw(const HiddenImage& hidden) {
  LensImage drawn{image_->ratio, image_->objects,
                  Image<float>(image_->ratio.width(), image_->ratio.height())};
  std::vector<std::vector<SurfacePiece>> pieces(blocks_.size());
  ParallelFor(blocks_.size(), 0, [&](std::size_t i) { pieces[i] = PiecesOf(blocks_[i], hidden); });
  for (const std::vector<SurfacePiece>& list : pieces) {
    for (const SurfacePiece& piece : list) kernels_->Prepare(piece.kernel);
  }
  std::vector<int> counts(blocks_.size());
  ParallelFor(blocks_.size(), 0, [&](std::size_t i) {
    const PixelRect& pixels = blocks_[i].pixels;
    if (pieces[i].empty()) return;
    const BlockLayers layers(pieces[i], *kernels_);
    counts[i] = static_cast<int>(layers.layers().size());
    for (int y = 0; y < pixels.height; ++y) {
      for (int x = 0; x < pixels.width; ++x) {
        if (!surfaces_->IsDrawn(pixels.x + x, pixels.y + y)) continue;
        WritePixel(ComposePixel(layers, x, y), pixels.x + x, pixels.y + y, &drawn);
      }
    }
  });
  layers_ = counts.empty() ? 0 : *std::ranges::max_element(counts);
  return drawn;
}

}  // namespace pleinair::compositor
