#pragma once

// Internal: drapes one line after the other.

#include <cstddef>
#include <optional>
#include <vector>

#include "content/draping/drape_lines.h"
#include "content/draping/surface_profile.h"

namespace pleinair::content {

/// A line as it is draped.
struct WalkedLine {
  std::vector<DrapedPiece> pieces;
  std::vector<Point<World>> ring;  ///< As of DrapedPieces; empty unless the line is a ring.
  std::size_t off_target = 0, clipped = 0;
};

/// Walks along lines over a surface. One object a thread.
class LineWalk {
 public:
  LineWalk(const SurfaceIndex& surface, const DrapeOptions& options)
      : surface_(surface), options_(options), profiler_(surface, options.on) {}

  WalkedLine Walk(const LineToDrape& line);

 private:
  /// The part of a line between two vertices of the file that lies inside the radius.
  struct Stretch {
    Vec3 from, to;
    bool from_file = false, to_file = false;
  };
  /// Where a stretch has a surface below it.
  struct Cover {
    bool begins = false, reaches = false;  // At its vertices of the file.
    bool anywhere = false;
    std::size_t gaps = 0;  // Between covered parts.
  };
  std::optional<Stretch> InsideRadius(const Vec3& from, const Vec3& to) const;
  Cover WalkStretch(const Stretch& stretch, bool is_first);
  void WalkAlone(const Vec3& point);
  void Follow(const ProfilePiece& piece, const Stretch& stretch, double length_m);
  void StandAlone(const ProfileFace& face, const Stretch& stretch);
  bool Peaks(const ProfileFace& face, double surface_z) const;
  const ProfileFace* FaceAt(double at, double length_m) const;
  /// Goes on to a vertex of the surface: directly, over a face, or after a break.
  void Join(const DrapedVertex& next, const ProfileFace* face);
  void Add(const DrapedVertex& vertex);
  void AddOffTarget(const Vec3& vertex);
  void CloseRing();
  void Count(const LineToDrape& line, const std::vector<std::optional<Cover>>& covers);

  const SurfaceIndex& surface_;
  const DrapeOptions& options_;
  Profiler profiler_;
  WalkedLine walked_;
  double above_m_ = 0.0;
  bool is_ring_ = false;
  std::vector<ProfileFace> faces_;  // Of the stretch; a face at its beginning may be of the last.
};

}  // namespace pleinair::content
