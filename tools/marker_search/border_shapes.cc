#include "tools/marker_search/border_shapes.h"

#include <algorithm>
#include <bit>

namespace pleinair::marker_search {
namespace {

constexpr int kMax = BorderShape::kMax;
/// Positions of a square of 2×2 modules along a side.
constexpr int kPlaces = kMax - 1;
/// Minimum filled share of a large shape's bounding box: slender shapes give no blob response.
constexpr double kCompact = 0.55;

constexpr std::uint32_t Square(int x, int y) { return 0b1100011U << (kMax * y + x); }

BorderShape ToTopLeft(BorderShape shape) {
  while (shape.modules != 0 && (shape.modules & 0x1FU) == 0) shape.modules >>= kMax;
  constexpr std::uint32_t kFirstColumn = 0x108421U;
  while (shape.modules != 0 && (shape.modules & kFirstColumn) == 0) shape.modules >>= 1;
  return shape;
}

/// Bits of `within` that are connected to those of `from` through `neighbours`.
template <typename Neighbours>
std::uint32_t Spread(std::uint32_t from, std::uint32_t within, Neighbours neighbours) {
  std::uint32_t reached = from & within;
  while (true) {
    const std::uint32_t more = (reached | neighbours(reached)) & within;
    if (more == reached) return reached;
    reached = more;
  }
}

/// Neighbours of the set bits in a grid of width `side`.
std::uint32_t Beside(std::uint32_t bits, int side) {
  std::uint32_t beside = bits << side | bits >> side;
  for (int i = 0; i < side * side; ++i) {
    if ((bits >> i & 1U) == 0) continue;
    if (i % side > 0) beside |= 1U << (i - 1);
    if (i % side < side - 1) beside |= 1U << (i + 1);
  }
  return beside;
}

}  // namespace

int BorderShape::Width() const {
  int width = 0;
  for (int i = 0; i < kMax * kMax; ++i) {
    if (Has(i % kMax, i / kMax)) width = std::max(width, i % kMax + 1);
  }
  return width;
}

int BorderShape::Height() const { return (std::bit_width(modules) + kMax - 1) / kMax; }

int BorderShape::Area() const { return std::popcount(modules); }

BorderShape BorderShape::Mirrored() const {
  BorderShape mirrored;
  for (int i = 0; i < kMax * kMax; ++i) {
    const int x = i % kMax, y = i / kMax;
    if (Has(x, y)) mirrored.modules |= 1U << (kMax * y + kMax - 1 - x);
  }
  return ToTopLeft(mirrored);
}

BorderShape BorderShape::Turned() const {
  BorderShape turned;
  for (int i = 0; i < kMax * kMax; ++i) {
    const int x = i % kMax, y = i / kMax;
    if (Has(x, y)) turned.modules |= 1U << (kMax * x + kMax - 1 - y);
  }
  return ToTopLeft(turned);
}

bool BorderShape::IsThick() const {
  std::uint32_t places = 0;
  for (int y = 0; y < kPlaces; ++y) {
    for (int x = 0; x < kPlaces; ++x) {
      if ((modules & Square(x, y)) == Square(x, y)) places |= 1U << (kPlaces * y + x);
    }
  }
  if (places == 0) return false;
  const std::uint32_t reached =
      Spread(places & (~places + 1U), places, [](std::uint32_t b) { return Beside(b, kPlaces); });
  if (reached != places) return false;
  std::uint32_t covered = 0;
  for (int y = 0; y < kPlaces; ++y) {
    for (int x = 0; x < kPlaces; ++x) {
      if ((places >> (kPlaces * y + x) & 1U) != 0) covered |= Square(x, y);
    }
  }
  return covered == modules;
}

bool BorderShape::HasHole() const {
  constexpr std::uint32_t kAll = (1U << (kMax * kMax)) - 1U;
  std::uint32_t edge = 0;
  for (int i = 0; i < kMax * kMax; ++i) {
    const int x = i % kMax, y = i / kMax;
    if (x == 0 || y == 0 || x == kMax - 1 || y == kMax - 1) edge |= 1U << i;
  }
  const std::uint32_t black = kAll & ~modules;
  return Spread(edge, black, [](std::uint32_t b) { return Beside(b, kMax); }) != black;
}

bool BorderShape::IsAsymmetric() const {
  BorderShape turned = *this;
  for (int i = 0; i < 4; ++i) {
    if ((i > 0 && turned == *this) || turned.Mirrored() == *this) return false;
    turned = turned.Turned();
  }
  return true;
}

ShapeLibrary MakeShapeLibrary() {
  ShapeLibrary library;
  std::vector<std::uint32_t> seen;
  for (std::uint32_t places = 1; places < 1U << (kPlaces * kPlaces); ++places) {
    std::uint32_t modules = 0;
    for (int i = 0; i < kPlaces * kPlaces; ++i) {
      if ((places >> i & 1U) != 0) modules |= Square(i % kPlaces, i / kPlaces);
    }
    const BorderShape shape{modules};
    if (ToTopLeft(shape) == shape) seen.push_back(modules);
  }
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  for (const std::uint32_t modules : seen) {
    const BorderShape shape{modules};
    if (!shape.IsThick() || shape.HasHole()) continue;
    const int width = shape.Width(), height = shape.Height();
    if (std::max(width, height) <= 3) {
      library.small.push_back(shape);
    } else if (std::min(width, height) >= 4 && shape.Area() >= kCompact * width * height &&
               shape.IsAsymmetric()) {
      library.large.push_back(shape);
    }
  }
  return library;
}

}  // namespace pleinair::marker_search
