#include "content/flow/curvilinear_cells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace pleinair::content {
namespace {

constexpr int kMaxNewtonSteps = 20;
constexpr int kMaxWalk = 12;          // Cells, before the search by bins.
constexpr double kNewtonEnd = 1e-12;  // Of a cell.
constexpr double kBorder = 1e-9;      // Of a cell: borders belong to it.
constexpr double kMaxExtrapolated = 1.0;
constexpr double kCellsPerBin = 2.0;

std::size_t Product(const std::array<int, 3>& counts) {
  return static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1]) *
         static_cast<std::size_t>(counts[2]);
}

}  // namespace

struct CurvilinearCells::Parts {
  std::array<int, 3> counts{};
  std::array<int, 3> cells{};  // Cells along each axis; 1 for the flat one.
  bool plane = false;
  std::vector<Vec3> positions;
  Box bounds{};
  double min_edge_m = 0.0;
  // Cells by bins of space: those of bin b are bin_cells[bin_starts[b]…bin_starts[b + 1]).
  std::array<int, 3> bins{};
  std::vector<std::uint32_t> bin_starts, bin_cells;

  const Vec3& At(int i, int j, int k) const {
    return positions[static_cast<std::size_t>(i) +
                     static_cast<std::size_t>(counts[0]) *
                         (static_cast<std::size_t>(j) +
                          static_cast<std::size_t>(counts[1]) * static_cast<std::size_t>(k))];
  }

  struct Corners {
    std::array<Vec3, 8> p;
  };
  Corners CornersOf(const std::array<int, 3>& cell) const {
    Corners corners;
    const int up = plane ? 0 : 1;
    for (int n = 0; n < 8; ++n) {
      Vec3 at = At(cell[0] + (n & 1), cell[1] + (n >> 1 & 1), cell[2] + up * (n >> 2));
      if (plane) at.z = n >> 2;
      corners.p[static_cast<std::size_t>(n)] = at;
    }
    return corners;
  }

  int BinOf(double x, double low, double high, int count) const {
    if (!(high > low)) return 0;
    const double bin = std::clamp((x - low) / (high - low) * count, 0.0, count - 1.0);
    return bin > 0.0 ? static_cast<int>(bin) : 0;  // 0 if it is not a number.
  }
  std::array<int, 3> BinAt(const Vec3& p) const {
    return {BinOf(p.x, bounds.min.x, bounds.max.x, bins[0]),
            BinOf(p.y, bounds.min.y, bounds.max.y, bins[1]),
            plane ? 0 : BinOf(p.z, bounds.min.z, bounds.max.z, bins[2])};
  }
  std::size_t BinNumber(int x, int y, int z) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(bins[0]) *
               (static_cast<std::size_t>(y) +
                static_cast<std::size_t>(bins[1]) * static_cast<std::size_t>(z));
  }

  template <typename Visit>
  void ForCells(const Visit& visit) const {
    std::uint32_t number = 0;
    for (int k = 0; k < cells[2]; ++k) {
      for (int j = 0; j < cells[1]; ++j) {
        for (int i = 0; i < cells[0]; ++i) visit(std::array<int, 3>{i, j, k}, number++);
      }
    }
  }
  std::array<int, 3> CellOf(std::uint32_t number) const {
    const auto n = static_cast<int>(number);
    return {n % cells[0], n / cells[0] % cells[1], n / cells[0] / cells[1]};
  }

  void Measure();
  void FillBins();
  bool Solve(const Vec3& point, GridPlace* place) const;
};

void CurvilinearCells::Parts::Measure() {
  const double infinity = std::numeric_limits<double>::infinity();
  bounds = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (const Vec3& p : positions) {
    bounds.min = {std::min(bounds.min.x, p.x), std::min(bounds.min.y, p.y),
                  std::min(bounds.min.z, p.z)};
    bounds.max = {std::max(bounds.max.x, p.x), std::max(bounds.max.y, p.y),
                  std::max(bounds.max.z, p.z)};
  }
  const double collapsed_m = 1e-9 * Norm(bounds.max - bounds.min);
  min_edge_m = infinity;
  ForCells([&](const std::array<int, 3>& cell, std::uint32_t) {
    const Corners c = CornersOf(cell);
    for (const int axis : {1, 2, 4}) {
      if (plane && axis == 4) continue;
      const double edge_m = Norm(c.p[static_cast<std::size_t>(axis)] - c.p[0]);
      if (edge_m > collapsed_m) min_edge_m = std::min(min_edge_m, edge_m);
    }
  });
}

void CurvilinearCells::Parts::FillBins() {
  const double number = static_cast<double>(Product(cells)) / kCellsPerBin;
  const int side = std::max(1, static_cast<int>(plane ? std::sqrt(number) : std::cbrt(number)));
  bins = {side, side, plane ? 1 : side};
  bin_starts.assign(BinNumber(0, 0, bins[2]) + 1, 0);
  const auto for_bins = [&](const std::array<int, 3>& cell, const auto& visit) {
    const Corners c = CornersOf(cell);
    Vec3 low = c.p[0], high = c.p[0];
    for (const Vec3& p : c.p) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const auto first = BinAt(low), last = BinAt(high);
    for (int z = first[2]; z <= last[2]; ++z) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int x = first[0]; x <= last[0]; ++x) visit(BinNumber(x, y, z));
      }
    }
  };
  ForCells([&](const std::array<int, 3>& cell, std::uint32_t) {
    for_bins(cell, [&](std::size_t bin) { ++bin_starts[bin + 1]; });
  });
  for (std::size_t i = 1; i < bin_starts.size(); ++i) bin_starts[i] += bin_starts[i - 1];
  bin_cells.resize(bin_starts.back());
  std::vector<std::uint32_t> next(bin_starts.begin(), bin_starts.end() - 1);
  ForCells([&](const std::array<int, 3>& cell, std::uint32_t n) {
    for_bins(cell, [&](std::size_t bin) { bin_cells[next[bin]++] = n; });
  });
}

/// Newton's method in the cell of `place`. Returns false if it does not converge.
bool CurvilinearCells::Parts::Solve(const Vec3& point, GridPlace* place) const {
  const Corners c = CornersOf(place->index);
  const Vec3 target{point.x, point.y, plane ? 0.0 : point.z};
  Vec3 f{0.5, 0.5, plane ? 0.0 : 0.5};
  double edge_m = 0.0;
  for (int step = 0; step < kMaxNewtonSteps; ++step) {
    const auto mix = [](const Vec3& a, const Vec3& b, double t) { return a + (b - a) * t; };
    const Vec3 x00 = mix(c.p[0], c.p[1], f.x), x10 = mix(c.p[2], c.p[3], f.x);
    const Vec3 x01 = mix(c.p[4], c.p[5], f.x), x11 = mix(c.p[6], c.p[7], f.x);
    const Vec3 y0 = mix(x00, x10, f.y), y1 = mix(x01, x11, f.y);
    const Vec3 dz = y1 - y0;
    const Vec3 dy = mix(x10 - x00, x11 - x01, f.z);
    const Vec3 dx = mix(mix(c.p[1] - c.p[0], c.p[3] - c.p[2], f.y),
                        mix(c.p[5] - c.p[4], c.p[7] - c.p[6], f.y), f.z);
    const Vec3 rest = target - mix(y0, y1, f.z);
    const Vec3 yz = Cross(dy, dz);
    const double determinant = Dot(dx, yz);
    edge_m = plane ? std::min(Norm(dx), Norm(dy)) : std::min({Norm(dx), Norm(dy), Norm(dz)});
    if (!(std::fabs(determinant) > 0.0)) return false;
    const Vec3 change{Dot(rest, yz) / determinant, Dot(rest, Cross(dz, dx)) / determinant,
                      Dot(rest, Cross(dx, dy)) / determinant};
    f = f + change;
    // A far point sends Newton's method anywhere: the direction is what the walk needs.
    f = {std::clamp(f.x, -3.0, 4.0), std::clamp(f.y, -3.0, 4.0), std::clamp(f.z, -3.0, 4.0)};
    if (std::fabs(change.x) + std::fabs(change.y) + std::fabs(change.z) < kNewtonEnd) break;
  }
  if (plane) f.z = 0.0;
  place->fraction = {f.x, f.y, f.z};
  place->size_m = {edge_m, edge_m, edge_m};
  return std::isfinite(f.x + f.y + f.z);
}

Result<CurvilinearCells> CurvilinearCells::Create(std::array<int, 3> counts,
                                                  std::vector<Vec3> positions) {
  if (counts[0] < 2 || counts[1] < 2 || counts[2] < 1 || Product(counts) != positions.size()) {
    return InputError("", "a curvilinear grid has fewer than two points along an axis",
                      "give at least 2 x 2 points");
  }
  for (const Vec3& p : positions) {
    if (!std::isfinite(p.x + p.y + p.z)) {
      return InputError("", "a point of the grid has a coordinate that is not finite",
                        "repair the points of the grid");
    }
  }
  auto parts = std::make_shared<Parts>();
  parts->counts = counts;
  parts->plane = counts[2] == 1;
  for (std::size_t a = 0; a < 3; ++a) parts->cells[a] = std::max(1, counts[a] - 1);
  parts->positions = std::move(positions);
  parts->Measure();
  if (!std::isfinite(parts->min_edge_m)) {
    return InputError("", "the points of the grid are all at one place",
                      "repair the points of the grid");
  }
  parts->FillBins();
  return CurvilinearCells(std::move(parts));
}

Box CurvilinearCells::bounds() const { return parts_->bounds; }
double CurvilinearCells::min_edge_m() const { return parts_->min_edge_m; }
Vec3 CurvilinearCells::Position(int i, int j, int k) const { return parts_->At(i, j, k); }

bool CurvilinearCells::Find(const Vec3& point, GridPlace* place) const {
  const Parts& parts = *parts_;
  const auto inside = [](double f) { return f >= -kBorder && f <= 1.0 + kBorder; };
  const auto is_inside = [&](const GridPlace& at) {
    return inside(at.fraction[0]) && inside(at.fraction[1]) && inside(at.fraction[2]);
  };
  GridPlace border;
  bool has_border = false;
  for (int walk = 0; walk < kMaxWalk; ++walk) {
    if (!parts.Solve(point, place)) break;
    if (is_inside(*place)) return true;
    bool moved = false;
    const std::array<int, 3> from = place->index;
    for (std::size_t a = 0; a < 3; ++a) {
      const double f = place->fraction[a];
      const double cells = std::clamp(std::floor(f), -1.0 * parts.cells[a], 1.0 * parts.cells[a]);
      const int by = f > 1.0 + kBorder ? std::max(1, static_cast<int>(cells))
                     : f < -kBorder    ? static_cast<int>(cells)
                                       : 0;
      place->index[a] = std::clamp(place->index[a] + by, 0, parts.cells[a] - 1);
      moved = moved || place->index[a] != from[a];
    }
    if (moved) continue;
    border = *place;
    has_border = true;
    break;
  }
  const auto bin = parts.BinAt(point);
  const std::size_t number = parts.BinNumber(bin[0], bin[1], bin[2]);
  for (std::uint32_t i = parts.bin_starts[number]; i < parts.bin_starts[number + 1]; ++i) {
    GridPlace found;
    found.index = parts.CellOf(parts.bin_cells[i]);
    if (parts.Solve(point, &found) && is_inside(found)) {
      *place = found;
      return true;
    }
  }
  if (has_border) *place = border;
  const auto is_near = [](double f) {
    return f >= -kMaxExtrapolated && f <= 1.0 + kMaxExtrapolated;
  };
  // Too far to be continued: a place that no caller takes for near.
  if (!has_border || !is_near(place->fraction[0]) || !is_near(place->fraction[1]) ||
      !is_near(place->fraction[2])) {
    place->fraction[0] = std::numeric_limits<double>::quiet_NaN();
  }
  return false;
}

}  // namespace pleinair::content
