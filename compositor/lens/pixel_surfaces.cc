#include "compositor/lens/pixel_surfaces.h"

#include <cmath>
namespace pleinair::compositor {
namespace {

constexpr int kMostReach_px = static_cast<int>(DiscKernels::kMaxCircle_px / 2) + 1;

/// −1, 0 or 1: the side of a pixel that a slope of coverage points to.
int SideOf(float slope, float steepest) {
  if (std::fabs(slope) < 0.41F * steepest) return 0;
  return slope > 0.0F ? 1 : -1;
}

}  // namespace

float DrawnCircle_px(const ThinLens& lens, double fx, float dioptres) {
  const double nearest = 1.0 / lens.MinDistance_m();
  const double circle_px = SignedCircle_px(lens, fx, std::min<double>(dioptres, nearest));
  return static_cast<float>(
      std::clamp(circle_px, -DiscKernels::kMaxCircle_px, DiscKernels::kMaxCircle_px));
}

PixelSurfaces::PixelSurfaces(const PinholeImage& image, const ThinLens& lens, double fx,
                             std::span<const PixelRect> within)
    : image_(&image),
      lens_(lens),
      fx_(fx),
      depths_(static_cast<std::size_t>(image.ratio.width()) * image.ratio.height()),
      columns_((image.ratio.width() + kCell_px - 1) / kCell_px),
      rows_((image.ratio.height() + kCell_px - 1) / kCell_px),
      cells_(static_cast<std::size_t>(columns_) * rows_) {
  const auto circle = [&](float dioptres) { return DrawnCircle_px(lens, fx, dioptres); };
  for (const PixelRect& rect : within) {
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
      for (int x = rect.x; x < rect.x + rect.width; ++x) {
        Depth& depth = depths_[Place(x, y)];
        const float* const dioptres = &image.dioptres(x, y);
        for (const int which : {0, 1}) {
          depth.real_circle_px[which] = circle(
              dioptres[which == 0 ? PinholeImage::kNearestReal : PinholeImage::kFarthestReal]);
          depth.real_layer[which] = static_cast<std::int16_t>(LayerOf(depth.real_circle_px[which]));
        }
        // Airlight before a real surface is in the objects' image, too.
        const float object = dioptres[PinholeImage::kObject];
        depth.object_circle_px = object > 0.0F ? circle(object) : depth.real_circle_px[0];
        depth.object_layer = static_cast<std::int16_t>(LayerOf(depth.object_circle_px));
        const float* const seen = Object(x, y);
        depth.has_object =
            WholeCoverage(x, y) > 0.0F || seen[0] != 0.0F || seen[1] != 0.0F || seen[2] != 0.0F;
        depth.has_change =
            Change(x, y, 0) != 0.0F || Change(x, y, 1) != 0.0F || Change(x, y, 2) != 0.0F;
        if (!depth.has_object) continue;
        Cell& cell = cells_[CellPlace(x / kCell_px, y / kCell_px)];
        cell.object_reach_px =
            std::max(cell.object_reach_px, DiscKernels::Reach_px(depth.object_circle_px));
        if (WholeCoverage(x, y) > 0.0F) {
          cell.farthest_object = std::max<int>(cell.farthest_object, depth.object_layer);
        }
      }
    }
  }
  FindReaches(within);
  FindDrawn();
}

void PixelSurfaces::FindReaches(std::span<const PixelRect> within) {
  for (const PixelRect& rect : within) {
    for (int top = rect.y; top < rect.y + rect.height; top += kCell_px) {
      for (int left = rect.x; left < rect.x + rect.width; left += kCell_px) {
        const PixelRect square{left, top, std::min(kCell_px, rect.x + rect.width - left),
                               std::min(kCell_px, rect.y + rect.height - top)};
        Cell& cell = cells_[CellPlace(left / kCell_px, top / kCell_px)];
        float real_circle = 0.0F;
        for (int y = top; y < top + square.height; ++y) {
          for (int x = left; x < left + square.width; ++x) {
            for (const float circle : DepthAt(x, y).real_circle_px) {
              real_circle = std::max(real_circle, std::fabs(circle));
            }
          }
        }
        const int real_reach = DiscKernels::Reach_px(real_circle);
        VisitCells(square, 2 * kMostReach_px, [&](const Cell& other, int distance_px) {
          if (other.object_reach_px + real_reach < distance_px) return;
          cell.farthest_near = std::max(cell.farthest_near, other.farthest_object);
        });
        cell.reach_px = std::max(cell.reach_px, cell.object_reach_px);
        cell.is_sharp = cell.object_reach_px > 0;
        float drawn_circle = -1.0F;
        for (int y = top; y < top + square.height; ++y) {
          for (int x = left; x < left + square.width; ++x) {
            const Depth& depth = DepthAt(x, y);
            cell.is_sharp = cell.is_sharp || (depth.has_change && IsEdge(x, y));
            for (const int which : {0, 1}) {
              const bool is_occluder = depth.real_layer[which] + kLayersApart <= cell.farthest_near;
              cell.is_sharp = cell.is_sharp || is_occluder;
              if (!depth.has_change && !is_occluder) continue;
              drawn_circle = std::max(drawn_circle, std::fabs(depth.real_circle_px[which]));
            }
          }
        }
        if (drawn_circle < 0.0F) continue;
        cell.reach_px = std::max(cell.reach_px, DiscKernels::Reach_px(drawn_circle));
      }
    }
  }
}

void PixelSurfaces::FindDrawn() {
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      Cell& cell = cells_[CellPlace(column, row)];
      const PixelRect square{column * kCell_px, row * kCell_px, kCell_px, kCell_px};
      VisitCells(square, kMostReach_px, [&](const Cell& other, int distance_px) {
        cell.is_drawn |= other.is_sharp && other.reach_px >= distance_px;
      });
    }
  }
}

float PixelSurfaces::NearestPart(int x, int y) const {
  const float* const parts = image_->object_parts.data() + 2 * Place(x, y);
  if (parts[0] >= 1.0F) return 1.0F;
  const int farthest = LayerOf(DrawnCircle_px(lens_, fx_, parts[1]));
  return farthest >= DepthAt(x, y).object_layer + kLayersApart ? parts[0] : 1.0F;
}

bool PixelSurfaces::IsEdge(int x, int y) const {
  // Steps of light that are not seen, blurred or not.
  constexpr float kStep = 0.01F;
  for (const int channel : {0, 1, 2}) {
    const float here = Change(x, y, channel);
    if (std::fabs(Change(x + 1, y, channel) - here) > kStep ||
        std::fabs(Change(x, y + 1, channel) - here) > kStep) {
      return true;
    }
  }
  return false;
}

template <typename Visit>
void PixelSurfaces::VisitCells(const PixelRect& rect, int within_px, const Visit& visit) const {
  const int first_row = std::max(0, (rect.y - within_px) / kCell_px);
  const int last_row = std::min(rows_ - 1, (rect.y + rect.height - 1 + within_px) / kCell_px);
  const int first_column = std::max(0, (rect.x - within_px) / kCell_px);
  const int last_column = std::min(columns_ - 1, (rect.x + rect.width - 1 + within_px) / kCell_px);
  for (int row = first_row; row <= last_row; ++row) {
    const int y = row * kCell_px;
    const int off_y = std::max({rect.y - y - kCell_px + 1, y - rect.y - rect.height + 1, 0});
    for (int column = first_column; column <= last_column; ++column) {
      const int x = column * kCell_px;
      const int off_x = std::max({rect.x - x - kCell_px + 1, x - rect.x - rect.width + 1, 0});
      visit(cells_[CellPlace(column, row)], std::max(off_x, off_y));
    }
  }
}

int PixelSurfaces::ReachInto(const PixelRect& rect) const {
  int reach = 0;
  VisitCells(rect, kMostReach_px, [&](const Cell& cell, int distance_px) {
    if (cell.reach_px >= distance_px) reach = std::max(reach, cell.reach_px);
  });
  return reach;
}

PixelRect PixelSurfaces::DrawnPart(const PixelRect& rect) const {
  int left = rect.x + rect.width, top = rect.y + rect.height, right = rect.x, bottom = rect.y;
  for (int y = rect.y; y < rect.y + rect.height; y += kCell_px) {
    for (int x = rect.x; x < rect.x + rect.width; x += kCell_px) {
      if (!IsDrawn(x, y)) continue;
      left = std::min(left, x);
      top = std::min(top, y);
      right = std::max(right, std::min(x + kCell_px, rect.x + rect.width));
      bottom = std::max(bottom, std::min(y + kCell_px, rect.y + rect.height));
    }
  }
  return {left, top, std::max(right - left, 0), std::max(bottom - top, 0)};
}

PixelPart PixelSurfaces::ObjectPart(int x, int y) const {
  const float coverage = WholeCoverage(x, y);
  if (coverage <= 0.0F || coverage >= 1.0F) return {};
  const float slope_x = WholeCoverage(x + 1, y) - WholeCoverage(x - 1, y);
  const float slope_y = WholeCoverage(x, y + 1) - WholeCoverage(x, y - 1);
  const float steepest = std::max(std::fabs(slope_x), std::fabs(slope_y));
  if (steepest < 0.1F) return {};
  return {SideOf(slope_x, steepest), SideOf(slope_y, steepest), false};
}

PixelPart PixelSurfaces::RealPart(int x, int y) const {
  const PixelPart object = ObjectPart(x, y);
  return {-object.x, -object.y, object.is_whole};
}

}  // namespace pleinair::compositor
