#include "content/draping/chord_error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/parallel_for.h"

namespace pleinair::content {
namespace {

constexpr double kMaxPairs = 7.0;     // Of places of a segment, beside its middle.
constexpr double kVertical_m = 1e-3;  // Segments shorter than this in plan climb a face.

double ErrorOfPiece(const DrapedPiece& piece, double above_m, const SurfaceIndex& surface,
                    const SurfaceRule& rule) {
  double largest_m = 0.0;
  for (std::size_t i = 1; i < piece.vertices.size(); ++i) {
    const Vec3 from = piece.vertices[i - 1].at.xyz, way = piece.vertices[i].at.xyz - from;
    const double length_m = std::hypot(way.x, way.y);
    if (length_m <= kVertical_m) continue;
    // An odd number: the middle is among them.
    const int places = 1 + 2 * static_cast<int>(std::min(std::floor(length_m / 2.0), kMaxPairs));
    for (int place = 0; place < places; ++place) {
      const Vec3 at = from + way * ((place + 0.5) / places);
      const std::optional<double> height_m = surface.HeightAt({at.x, at.y}, rule);
      if (height_m) largest_m = std::max(largest_m, std::fabs(at.z - above_m - *height_m));
    }
  }
  return largest_m;
}

}  // namespace

double MaxChordError(std::span<const LineToDrape> lines, const DrapedPieces& draped,
                     const SurfaceIndex& surface, const SurfaceRule& rule) {
  std::vector<double> errors(draped.pieces.size());
  ParallelFor(draped.pieces.size(), 0, [&](std::size_t i) {
    const DrapedPiece& piece = draped.pieces[i];
    errors[i] = ErrorOfPiece(piece, lines[piece.line].above_m, surface, rule);
  });
  return errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end());
}

}  // namespace pleinair::content
