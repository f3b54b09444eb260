#include "tools/marker_search/border_layout.h"

#include <algorithm>

namespace pleinair::marker_search {
namespace {

constexpr int kMax = BorderShape::kMax;
constexpr int kBandBegin = 4, kBandEnd = 9;  ///< Modules from the nearest side.
constexpr int kTriesPerLarge = 200, kTriesOfSmall = 1500, kTriesOfSmallAgain = 60;

bool InBand(int x, int y) {
  const int from_side = std::min({x, y, kEdge - 1 - x, kEdge - 1 - y});
  return from_side >= kBandBegin && from_side < kBandEnd;
}

BorderLayout::Placed DrawPlace(const std::vector<BorderShape>& shapes, RandomDraws* draws) {
  const BorderShape shape = shapes[draws->Below(static_cast<int>(shapes.size()))];
  // The place lies along a random side. Both sides that meet at a corner include it.
  const int along = kBandBegin + draws->Below(kEdge - 2 * kBandBegin - 1);
  const int across = kBandBegin + draws->Below(kBandEnd - kBandBegin - 1);
  switch (draws->Below(4)) {
    case 0:
      return {shape, along, across};
    case 1:
      return {shape, across, along};
    case 2:
      return {shape, along, kEdge - across - shape.Height()};
    default:
      return {shape, kEdge - across - shape.Width(), along};
  }
}

}  // namespace

BorderLayout::BorderLayout() { rows_.fill(std::string(kEdge, '#')); }

std::optional<BorderLayout> BorderLayout::Of(const tracker::sg::Border& border) {
  BorderLayout layout;
  std::array<std::string, kEdge> left;
  for (int y = 0; y < kEdge; ++y) left[y] = border[y];
  for (int y = 0; y < kEdge; ++y) {
    for (int x = 0; x < kEdge; ++x) {
      if (left[y][x] != '.') continue;
      // Collects the connected component of this module.
      std::vector<std::pair<int, int>> modules{{x, y}};
      left[y][x] = '#';
      int x0 = x, y0 = y;
      for (std::size_t i = 0; i < modules.size(); ++i) {
        const auto [cx, cy] = modules[i];
        x0 = std::min(x0, cx);
        y0 = std::min(y0, cy);
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          const int nx = cx + dx, ny = cy + dy;
          if (nx < 0 || ny < 0 || nx >= kEdge || ny >= kEdge || left[ny][nx] != '.') continue;
          left[ny][nx] = '#';
          modules.emplace_back(nx, ny);
        }
      }
      Placed placed{{}, x0, y0};
      for (const auto& [cx, cy] : modules) {
        if (cx - x0 >= kMax || cy - y0 >= kMax) return std::nullopt;
        placed.shape.modules |= 1U << (kMax * (cy - y0) + cx - x0);
      }
      if (!placed.shape.IsThick() || !layout.Add(placed)) return std::nullopt;
    }
  }
  return layout;
}

BorderLayout BorderLayout::Random(const ShapeLibrary& library, int large_shapes,
                                  RandomDraws* draws) {
  BorderLayout layout;
  for (int i = 0; i < large_shapes; ++i) {
    for (int k = 0; k < kTriesPerLarge; ++k) {
      if (layout.Add(DrawPlace(library.large, draws))) break;
    }
  }
  layout.AddSmallShapes(library, kTriesOfSmall, draws);
  return layout;
}

void BorderLayout::AddSmallShapes(const ShapeLibrary& library, int tries, RandomDraws* draws) {
  for (int i = 0; i < tries; ++i) Add(DrawPlace(library.small, draws));
}

BorderLayout BorderLayout::Varied(const ShapeLibrary& library, RandomDraws* draws) const {
  while (true) {
    BorderLayout varied = *this;
    if (shapes_.empty()) return Random(library, 12, draws);
    const int index = draws->Below(static_cast<int>(shapes_.size()));
    Placed placed = shapes_[index];
    const auto& alike = placed.IsLarge() ? library.large : library.small;
    varied.Remove(index);
    bool changed = false;
    switch (draws->Below(8)) {
      case 0:  // Shifted by at most two modules along each axis.
      case 1:
        placed.x += draws->Below(5) - 2;
        placed.y += draws->Below(5) - 2;
        changed = varied.Add(placed);
        break;
      case 2:  // Mirrored or turned.
        for (int turns = draws->Below(4); turns > 0; --turns) placed.shape = placed.shape.Turned();
        if (draws->Below(2) == 1) placed.shape = placed.shape.Mirrored();
        changed = varied.Add(placed);
        break;
      case 3:  // Replaced by a shape of the same kind.
      case 4:
        placed.shape = alike[draws->Below(static_cast<int>(alike.size()))];
        changed = varied.Add(placed);
        break;
      case 5: {  // Two shapes swapped.
        const int other = draws->Below(static_cast<int>(varied.shapes_.size()));
        Placed swapped = varied.shapes_[other];
        varied.Remove(other);
        std::swap(placed.x, swapped.x);
        std::swap(placed.y, swapped.y);
        changed = varied.Add(placed) && varied.Add(swapped);
        break;
      }
      case 6:  // Moved elsewhere; small shapes in the way are removed.
      {
        placed = DrawPlace({placed.shape}, draws);
        for (std::size_t i = varied.shapes_.size(); i-- > 0;) {
          const Placed& other = varied.shapes_[i];
          if (!other.IsLarge() && std::abs(other.x - placed.x) <= kMax &&
              std::abs(other.y - placed.y) <= kMax) {
            varied.Remove(i);
          }
        }
        changed = varied.Add(placed);
        break;
      }
      default:  // A large shape becomes a small one; a small one is replaced by a random shape.
        if (placed.IsLarge()) {
          changed = varied.Add(DrawPlace(library.small, draws));
        } else {
          for (int i = 0; i < kTriesPerLarge && !changed; ++i) {
            changed =
                varied.Add(DrawPlace(draws->Below(3) == 0 ? library.large : library.small, draws));
          }
        }
    }
    if (!changed) continue;
    if (draws->Below(3) > 0) varied.AddSmallShapes(library, kTriesOfSmallAgain, draws);
    if (varied.rows_ != rows_) return varied;
  }
}

bool BorderLayout::IsAsymmetric(int modules) const {
  for (int symmetry = 1; symmetry < 8; ++symmetry) {
    int differing = 0;
    for (int y = 0; y < kEdge; ++y) {
      for (int x = 0; x < kEdge; ++x) {
        int sx = symmetry & 1 ? kEdge - 1 - x : x, sy = symmetry & 2 ? kEdge - 1 - y : y;
        if ((symmetry & 4) != 0) std::swap(sx, sy);
        differing += rows_[y][x] != rows_[sy][sx] ? 1 : 0;
      }
    }
    if (differing < modules) return false;
  }
  return true;
}

bool BorderLayout::Fits(const Placed& placed) const {
  for (int i = 0; i < kMax * kMax; ++i) {
    if (!placed.shape.Has(i % kMax, i / kMax)) continue;
    const int x = placed.x + i % kMax, y = placed.y + i / kMax;
    if (!InBand(x, y)) return false;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (rows_[y + dy][x + dx] != '#') return false;
      }
    }
  }
  return true;
}

bool BorderLayout::Add(const Placed& placed) {
  if (!Fits(placed)) return false;
  Draw(placed, '.');
  shapes_.push_back(placed);
  return true;
}

void BorderLayout::Remove(std::size_t index) {
  Draw(shapes_[index], '#');
  shapes_.erase(shapes_.begin() + static_cast<std::ptrdiff_t>(index));
}

void BorderLayout::Draw(const Placed& placed, char value) {
  for (int i = 0; i < kMax * kMax; ++i) {
    if (!placed.shape.Has(i % kMax, i / kMax)) continue;
    rows_[placed.y + i / kMax][placed.x + i % kMax] = value;
  }
}

tracker::sg::Border BorderLayout::border() const {
  tracker::sg::Border border;
  for (int y = 0; y < kEdge; ++y) border[y] = rows_[y];
  return border;
}

}  // namespace pleinair::marker_search
