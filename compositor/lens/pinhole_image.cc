#include "compositor/lens/pinhole_image.h"

#include <algorithm>
#include <cmath>

namespace pleinair::compositor {
namespace {

// Smaller changes of the light of real surfaces look the same when they are blurred.
constexpr float kNoticed = 0.01F;

}  // namespace

float OccluderEdge(const PinholeImage& image, int x, int y) {
  // A surface nearer by less has almost the same circle of confusion.
  constexpr float kNearer = 1.02F;
  float object = 0.0F, real = 0.0F;
  const auto look = [&](int column, int row) {
    const float* const dioptres = &image.dioptres(std::max(column, 0), std::max(row, 0));
    object = std::max(object, dioptres[PinholeImage::kObject]);
    real = std::max(real, dioptres[PinholeImage::kNearestReal]);
  };
  look(x, y);
  look(x - 1, y);
  look(x, y - 1);
  return object > 0.0F && real > kNearer * object ? real : 0.0F;
}

DioptreRange AffectedDioptres(const PinholeImage& image, std::span<const PixelRect> within) {
  DioptreRange range;
  const auto include = [&](float dioptres) {
    range.min = std::min(range.min, dioptres);
    range.max = std::max(range.max, dioptres);
  };
  for (const PixelRect& rect : within) {
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
      for (int x = rect.x; x < rect.x + rect.width; ++x) {
        const float* const dioptres = &image.dioptres(x, y);
        if (dioptres[PinholeImage::kObject] > 0.0F) include(dioptres[PinholeImage::kObject]);
        if (const float occluder = OccluderEdge(image, x, y); occluder > 0.0F) include(occluder);
        const float* const ratio = &image.ratio(x, y);
        const bool is_changed = std::fabs(ratio[0] - 1.0F) > kNoticed ||
                                std::fabs(ratio[1] - 1.0F) > kNoticed ||
                                std::fabs(ratio[2] - 1.0F) > kNoticed;
        if (!is_changed || dioptres[PinholeImage::kNearestReal] == 0.0F) continue;
        include(dioptres[PinholeImage::kNearestReal]);
        if (dioptres[PinholeImage::kFarthestReal] > 0.0F) {
          include(dioptres[PinholeImage::kFarthestReal]);
        }
      }
    }
  }
  return range;
}

}  // namespace pleinair::compositor
