#include "content/draping/drape_lines.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/parallel_for.h"
#include "content/draping/line_walk.h"

namespace pleinair::content {
namespace {

constexpr std::size_t kLinesOfAChunk = 64;

/// True if a place lies inside the rings, by the rule of even and odd.
bool IsInside(const std::vector<const std::vector<Point<World>>*>& rings, Vec2 at) {
  bool inside = false;
  for (const std::vector<Point<World>>* ring : rings) {
    for (std::size_t i = 1; i < ring->size(); ++i) {
      const Vec3 &a = (*ring)[i - 1].xyz, &b = (*ring)[i].xyz;
      if ((a.y > at.y) == (b.y > at.y)) continue;
      if (a.x + (b.x - a.x) * ((at.y - a.y) / (b.y - a.y)) > at.x) inside = !inside;
    }
  }
  return inside;
}

/// True if an area without a border on the surface has the surface inside it.
bool AnAreaCovers(std::span<const LineToDrape> lines, const SurfaceIndex& surface) {
  constexpr std::size_t kTried = 100;  // Vertices of the surface.
  const std::vector<Point<World>>& vertices = surface.mesh().vertices;
  const std::size_t step = std::max<std::size_t>(1, vertices.size() / kTried);
  std::vector<const std::vector<Point<World>>*> rings;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].kind == PartKind::kRing) rings.push_back(&lines[i].points);
    if (i + 1 < lines.size() && lines[i + 1].feature == lines[i].feature) continue;
    for (std::size_t at = 0; !rings.empty() && at < vertices.size(); at += step) {
      if (IsInside(rings, {vertices[at].xyz.x, vertices[at].xyz.y})) return true;
    }
    rings.clear();
  }
  return false;
}

void AddSegments(const LineToDrape& line, const DrapedPiece& piece, double* arc_m,
                 std::vector<DrapedSegment>* segments) {
  const std::vector<DrapedVertex>& vertices = piece.vertices;
  if (vertices.size() == 1) {
    segments->push_back({vertices[0].at, vertices[0].at, *arc_m, *arc_m, line.feature, true, true});
    return;
  }
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const Point<World>&from = vertices[i - 1].at, &to = vertices[i].at;
    const double begin_m = *arc_m;
    *arc_m += Norm(to.xyz - from.xyz);
    segments->push_back({from, to, begin_m, *arc_m, line.feature, piece.starts && i == 1,
                         piece.ends && i + 1 == vertices.size()});
  }
}

}  // namespace

DrapedPieces DrapeLines(std::span<const LineToDrape> lines, const SurfaceIndex& surface,
                        const DrapeOptions& options) {
  const std::size_t chunks = (lines.size() + kLinesOfAChunk - 1) / kLinesOfAChunk;
  std::vector<DrapedPieces> parts(chunks);
  DrapedPieces all;
  all.rings.resize(lines.size());
  ParallelFor(chunks, options.threads, [&](std::size_t chunk) {
    LineWalk walk(surface, options);
    DrapedPieces& part = parts[chunk];
    const std::size_t end = std::min(lines.size(), (chunk + 1) * kLinesOfAChunk);
    for (std::size_t i = chunk * kLinesOfAChunk; i < end; ++i) {
      WalkedLine walked = walk.Walk(lines[i]);
      all.rings[i] = std::move(walked.ring);
      part.report.vertices_in += lines[i].points.size();
      part.report.off_target += walked.off_target;
      part.report.clipped += walked.clipped;
      for (DrapedPiece& piece : walked.pieces) {
        piece.line = i;
        part.report.vertices_out += piece.vertices.size();
        part.pieces.push_back(std::move(piece));
      }
    }
  });
  for (DrapedPieces& part : parts) {
    std::move(part.pieces.begin(), part.pieces.end(), std::back_inserter(all.pieces));
    all.report.vertices_in += part.report.vertices_in;
    all.report.vertices_out += part.report.vertices_out;
    all.report.off_target += part.report.off_target;
    all.report.clipped += part.report.clipped;
  }
  return all;
}

DrapedLayer LayerOf(std::span<const LineToDrape> lines, const DrapedPieces& draped) {
  DrapedLayer layer;
  layer.report = draped.report;
  layer.segments.reserve(draped.report.vertices_out);
  double arc_m = 0.0;
  for (std::size_t i = 0; i < draped.pieces.size(); ++i) {
    const DrapedPiece& piece = draped.pieces[i];
    if (i == 0 || draped.pieces[i - 1].line != piece.line) arc_m = 0.0;
    AddSegments(lines[piece.line], piece, &arc_m, &layer.segments);
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (draped.rings[i].empty()) continue;
    // Rings of one feature are one area, so that the inner ones are holes.
    if (layer.areas.empty() || layer.areas.back().feature != lines[i].feature) {
      layer.areas.push_back({lines[i].feature, {}});
    }
    layer.areas.back().rings.push_back(draped.rings[i]);
  }
  return layer;
}

Result<void> CheckOnTarget(std::span<const LineToDrape> lines, const DrapedPieces& draped,
                           const SurfaceIndex& surface, const std::string& where) {
  if (!draped.pieces.empty() || lines.empty() || AnAreaCovers(lines, surface)) return {};
  return InputError(where, "no surface lies under any vertex",
                    "check that the phantoms of the scene reach there, and the rule `on`");
}

Result<DrapedLayer> DrapeExactly(std::span<const LineToDrape> lines, const SurfaceIndex& surface,
                                 const DrapeOptions& options, const std::string& where) {
  const DrapedPieces draped = DrapeLines(lines, surface, options);
  PLEINAIR_RETURN_IF_ERROR(CheckOnTarget(lines, draped, surface, where));
  return LayerOf(lines, draped);
}

}  // namespace pleinair::content
