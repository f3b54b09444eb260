#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "compositor/lens/disc_kernel.h"
#include "compositor/lens/lens_layers.h"
#include "compositor/lens/pinhole_image.h"
#include "compositor/lens/thin_lens.h"
#include "compositor/surfaces/image_tiles.h"

namespace pleinair::compositor {

/// SignedCircle_px() of a surface as it is drawn: at most DiscKernels::kMaxCircle_px in size.
float DrawnCircle_px(const ThinLens& lens, double fx, float dioptres);

/// The surfaces of each pixel of a pinhole image, with their circles of confusion and layers of
/// depth. Beside the image lie the pixels of its border.
class PixelSurfaces {
 public:
  /// `image` must outlive this object. `fx`: render pixels. `within`: other pixels are empty.
  PixelSurfaces(const PinholeImage& image, const ThinLens& lens, double fx,
                std::span<const PixelRect> within);

  struct Depth {
    float object_circle_px = 0.0F;  ///< SignedCircle_px() of the object.
    float real_circle_px[2] = {};   ///< The nearest and the farthest real surface.
    std::int16_t object_layer = 0, real_layer[2] = {};  ///< LayerOf() those.
    bool has_object = false;  ///< Something of an object is drawn or hidden by real surfaces.
    bool has_change = false;  ///< The light of real surfaces changes.
  };
  const Depth& DepthAt(int x, int y) const { return depths_[Place(x, y)]; }

  /// What is seen of the object: premultiplied display-linear color, coverage.
  const float* Object(int x, int y) const { return image_->objects.data() + 4 * Place(x, y); }
  /// The object as if there were no real surfaces.
  const float* WholeObject(int x, int y) const {
    return (image_->objects_alone.empty() ? image_->objects : image_->objects_alone).data() +
           4 * Place(x, y);
  }
  float SeenCoverage(int x, int y) const { return std::clamp(Object(x, y)[3], 0.0F, 1.0F); }
  float WholeCoverage(int x, int y) const { return std::clamp(WholeObject(x, y)[3], 0.0F, 1.0F); }
  /// Part of the object's coverage that is its nearest surface, if other surfaces lie behind that
  /// by two layers and more; else 1.
  float NearestPart(int x, int y) const;
  /// Change of the light of real surfaces in a channel: (ratio − 1) times their coverage.
  float Change(int x, int y, int channel) const {
    return image_->ratio.data()[4 * Place(x, y) + static_cast<std::size_t>(channel)] - 1.0F;
  }
  /// Part of the real surfaces that the nearest (0) or the farthest one (1) has.
  float PartOf(int which, int x, int y) const {
    const float nearest = image_->dioptres.data()[4 * Place(x, y) + PinholeImage::kNearestPart];
    return which == 0 ? nearest : 1.0F - nearest;
  }
  /// Part of the pixel that shows one of the real surfaces.
  float RealShare(int which, int x, int y) const {
    return (1.0F - SeenCoverage(x, y)) * PartOf(which, x, y);
  }
  /// The part of a pixel that its objects cover, and the rest, by the slope of their coverage.
  PixelPart ObjectPart(int x, int y) const;
  PixelPart RealPart(int x, int y) const;

  /// Whether a lens changes what a pixel shows. Cells of pixels far from objects and from edges of
  /// shadows stay as they are.
  bool IsDrawn(int x, int y) const { return CellAt(x, y).is_drawn; }
  /// The part of a rectangle whose pixels it changes.
  PixelRect DrawnPart(const PixelRect& rect) const;
  /// How far circles of confusion reach into a rectangle from the pixels around it; 0: nothing is
  /// drawn there.
  int ReachInto(const PixelRect& rect) const;
  /// Whether a real surface at a pixel covers objects over a part of the lens: one in this layer,
  /// before objects nearby.
  bool IsOccluder(int layer, int x, int y) const {
    return layer + kLayersApart <= CellAt(x, y).farthest_near;
  }

 private:
  /// A square of pixels.
  struct Cell {
    int farthest_object = -1;  ///< Layer; −1: there is none.
    int farthest_near = -1;    ///< The same over all cells that the circles of this one may meet.
    int object_reach_px = 0;   ///< The reach of objects in it.
    int reach_px = 0;          ///< The reach of all that is drawn in it.
    bool is_sharp = false;     ///< It has an object, an occluder, or an edge of a shadow.
    bool is_drawn = false;     ///< Circles of a sharp one reach it.
  };
  template <typename Visit>  // Called with a cell and its distance from the rectangle, pixels.
  void VisitCells(const PixelRect& rect, int within_px, const Visit& visit) const;
  void FindReaches(std::span<const PixelRect> within);
  void FindDrawn();
  /// Whether the change of light has a step at a pixel.
  bool IsEdge(int x, int y) const;
  static constexpr int kCell_px = 16;
  const Cell& CellAt(int x, int y) const {
    return cells_[CellPlace(std::clamp(x / kCell_px, 0, columns_ - 1),
                            std::clamp(y / kCell_px, 0, rows_ - 1))];
  }
  std::size_t CellPlace(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  std::size_t Place(int x, int y) const {
    const int column = std::clamp(x, 0, image_->ratio.width() - 1);
    const int row = std::clamp(y, 0, image_->ratio.height() - 1);
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(image_->ratio.width()) +
           static_cast<std::size_t>(column);
  }

  const PinholeImage* image_;
  ThinLens lens_;
  double fx_;
  std::vector<Depth> depths_;
  int columns_, rows_;  // Numbers of cells.
  std::vector<Cell> cells_;
};

}  // namespace pleinair::compositor
