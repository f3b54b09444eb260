#pragma once

// Internal: the section of a surface below a straight line.

#include <cstdint>
#include <vector>

#include "base/vector.h"
#include "content/draping/surface_index.h"

namespace pleinair::content {

/// A part of the line over one triangle, straight between its ends. Parameters: 0 at the beginning
/// of the line, 1 at its end.
struct ProfilePiece {
  double begin = 0.0, end = 0.0;
  double begin_z = 0.0, end_z = 0.0;
  std::uint32_t triangle = 0;

  double HeightAt(double at) const {
    if (at <= begin) return begin_z;
    if (at >= end) return end_z;
    return begin_z + (end_z - begin_z) * ((at - begin) / (end - begin));
  }
};

/// Vertical faces that the line crosses at one place.
struct ProfileFace {
  double at = 0.0;
  double low_z = 0.0, high_z = 0.0;
};

/// The height of a surface along a line, as seen from above.
struct SurfaceProfile {
  std::vector<ProfilePiece> pieces;  ///< In order, without overlap. Gaps: there is no surface.
  std::vector<ProfileFace> faces;    ///< In order, one at a place.
};

/// Computes profiles; keeps memory between calls. One object a thread.
///
/// The line is cut with every triangle that it passes. Of those that lie above one another, `rule`
/// chooses at each place, so that pieces also begin where two surfaces intersect. Neighbours get
/// the same crossing of their common edge to the last bit, and an edge or corner on the line
/// belongs to both: there are no ties to decide.
class Profiler {
 public:
  Profiler(const SurfaceIndex& index, const SurfaceRule& rule) : index_(index), rule_(rule) {}

  /// The profile from a to b, which must be apart. Valid until the next call.
  const SurfaceProfile& Along(Vec2 a, Vec2 b);

 private:
  struct Crossing {
    double at, z;
  };
  void Cut(std::uint32_t triangle, Vec2 a, Vec2 way, double length_m);
  void AddPiece(Crossing from, Crossing to, std::uint32_t triangle);
  void AddFace(Crossing from, Crossing to);
  void ChooseAmongPieces();
  void ChooseBetween(double begin, double end);
  void GatherFaces(double length_m);

  const SurfaceIndex& index_;
  SurfaceRule rule_;
  std::vector<std::uint32_t> triangles_;
  std::vector<ProfilePiece> cuts_;
  std::vector<const ProfilePiece*> active_;
  std::vector<double> breaks_;
  SurfaceProfile profile_;
};

}  // namespace pleinair::content
