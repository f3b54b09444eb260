#include "content/draping/surface_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pleinair::content {
namespace {

constexpr double kSameHeight_m = 1e-9;  // Rounding of heights up to 10⁶ m.
constexpr double kSamePlace_m = 1e-5;   // Faces of one wall, after rounding of a model's file.

}  // namespace

const SurfaceProfile& Profiler::Along(Vec2 a, Vec2 b) {
  const double length_m = Norm(b - a);
  const Vec2 way = (b - a) * (1.0 / length_m);
  profile_.pieces.clear();
  profile_.faces.clear();
  cuts_.clear();
  index_.TrianglesAlong(a, b, &triangles_);
  for (const std::uint32_t triangle : triangles_) {
    if (rule_.Allows(index_.mesh().surfaces[triangle])) Cut(triangle, a, way, length_m);
  }
  ChooseAmongPieces();
  GatherFaces(length_m);
  return profile_;
}

void Profiler::Cut(std::uint32_t triangle, Vec2 a, Vec2 way, double length_m) {
  const auto& numbers = index_.mesh().triangles[triangle];
  const std::array<Vec3, 3> corners = index_.Corners(triangle);
  std::array<double, 3> aside_m{};  // Left of the line; 0: on it.
  std::array<Crossing, 3> along{};
  int on_line = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 from_a{corners[i].x - a.x, corners[i].y - a.y};
    aside_m[i] = way.x * from_a.y - way.y * from_a.x;
    if (std::fabs(aside_m[i]) <= kOnLine_m) aside_m[i] = 0.0;
    along[i] = {(way.x * from_a.x + way.y * from_a.y) / length_m, corners[i].z};
    on_line += aside_m[i] == 0.0 ? 1 : 0;
  }
  if (on_line == 3) {
    // A wall in the plane of the line, of which the upper border is seen from above.
    if (rule_.choice == SurfaceChoice::kLowest && index_.IsVertical(triangle)) return;
    for (std::size_t i = 0; i < 3; ++i) {
      const Crossing &from = along[i], &to = along[(i + 1) % 3];
      if (std::fabs(to.at - from.at) * length_m > kOnLine_m) {
        AddPiece(from, to, triangle);
      } else {
        AddFace(from, to);
      }
    }
    return;
  }
  std::array<Crossing, 4> found{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (aside_m[i] == 0.0) found[count++] = along[i];
    std::size_t p = i, q = (i + 1) % 3;
    if (!(aside_m[p] * aside_m[q] < 0.0)) continue;
    // The same order in both triangles of an edge gives the same rounding.
    if (numbers[p] > numbers[q]) std::swap(p, q);
    const double share = aside_m[p] / (aside_m[p] - aside_m[q]);
    found[count++] = {along[p].at + share * (along[q].at - along[p].at),
                      along[p].z + share * (along[q].z - along[p].z)};
  }
  if (count < 2) return;
  if (index_.IsVertical(triangle)) {
    AddFace(found[0], found[1]);
  } else {
    AddPiece(found[0], found[1], triangle);
  }
}

void Profiler::AddPiece(Crossing from, Crossing to, std::uint32_t triangle) {
  if (from.at > to.at) std::swap(from, to);
  if (from.at >= 1.0 || to.at <= 0.0 || !(from.at < to.at)) return;
  ProfilePiece piece{from.at, to.at, from.z, to.z, triangle};
  const double begin_z = piece.HeightAt(0.0), end_z = piece.HeightAt(1.0);
  cuts_.push_back({std::max(from.at, 0.0), std::min(to.at, 1.0), begin_z, end_z, triangle});
}

void Profiler::AddFace(Crossing from, Crossing to) {
  constexpr double kBeyond = 1e-9;  // Of the line: a face at its very end counts.
  const double at = 0.5 * (from.at + to.at);
  if (at < -kBeyond || at > 1.0 + kBeyond) return;
  profile_.faces.push_back(
      {std::clamp(at, 0.0, 1.0), std::min(from.z, to.z), std::max(from.z, to.z)});
}

void Profiler::ChooseAmongPieces() {
  std::sort(cuts_.begin(), cuts_.end(), [](const ProfilePiece& a, const ProfilePiece& b) {
    return a.begin < b.begin || (a.begin == b.begin && a.triangle < b.triangle);
  });
  breaks_.clear();
  for (const ProfilePiece& cut : cuts_) {
    breaks_.push_back(cut.begin);
    breaks_.push_back(cut.end);
  }
  std::sort(breaks_.begin(), breaks_.end());
  breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
  active_.clear();
  std::size_t next = 0;
  for (std::size_t i = 0; i + 1 < breaks_.size(); ++i) {
    const double begin = breaks_[i];
    std::erase_if(active_, [&](const ProfilePiece* cut) { return cut->end <= begin; });
    for (; next < cuts_.size() && cuts_[next].begin <= begin; ++next) {
      active_.push_back(&cuts_[next]);
    }
    if (!active_.empty()) ChooseBetween(begin, breaks_[i + 1]);
  }
}

void Profiler::ChooseBetween(double begin, double end) {
  std::vector<ProfilePiece>& pieces = profile_.pieces;
  const auto sign = rule_.choice == SurfaceChoice::kLowest ? -1.0 : 1.0;
  while (true) {
    // The best one at the beginning, then at the end; of equals the one in use.
    const ProfilePiece* best = active_.front();
    for (const ProfilePiece* each : active_) {
      const double here = sign * (each->HeightAt(begin) - best->HeightAt(begin));
      const double there = sign * (each->HeightAt(end) - best->HeightAt(end));
      const bool equal_here = std::fabs(here) <= kSameHeight_m;
      const bool in_use = !pieces.empty() && pieces.back().end == begin &&
                          pieces.back().triangle == each->triangle &&
                          pieces.back().triangle != best->triangle;
      if ((!equal_here && here > 0.0) || (equal_here && there > kSameHeight_m) ||
          (equal_here && std::fabs(there) <= kSameHeight_m && in_use)) {
        best = each;
      }
    }
    // Where another one passes it.
    double until = end;
    for (const ProfilePiece* each : active_) {
      const double here = sign * (each->HeightAt(begin) - best->HeightAt(begin));
      const double there = sign * (each->HeightAt(end) - best->HeightAt(end));
      if (!(there > kSameHeight_m) || here > 0.0) continue;
      until = std::min(until, begin + (end - begin) * (-here / (there - here)));
    }
    if (!(until > begin)) until = end;
    const double begin_z = best->HeightAt(begin), end_z = best->HeightAt(until);
    const bool goes_on = !pieces.empty() && pieces.back().end == begin &&
                         pieces.back().triangle == best->triangle &&
                         std::fabs(pieces.back().end_z - begin_z) <= kSameHeight_m;
    if (goes_on) {
      pieces.back().end = until;
      pieces.back().end_z = end_z;
    } else {
      pieces.push_back({begin, until, begin_z, end_z, best->triangle});
    }
    if (until >= end) return;
    begin = until;
  }
}

void Profiler::GatherFaces(double length_m) {
  std::vector<ProfileFace>& faces = profile_.faces;
  std::sort(faces.begin(), faces.end(), [](const ProfileFace& a, const ProfileFace& b) {
    return a.at < b.at || (a.at == b.at && a.low_z < b.low_z);
  });
  std::size_t kept = 0;
  for (const ProfileFace& face : faces) {
    if (kept > 0 && (face.at - faces[kept - 1].at) * length_m <= kSamePlace_m) {
      faces[kept - 1].low_z = std::min(faces[kept - 1].low_z, face.low_z);
      faces[kept - 1].high_z = std::max(faces[kept - 1].high_z, face.high_z);
    } else {
      faces[kept++] = face;
    }
  }
  faces.resize(kept);
}

}  // namespace pleinair::content
