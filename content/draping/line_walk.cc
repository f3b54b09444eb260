#include "content/draping/line_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pleinair::content {
namespace {

constexpr double kMerged_m = 1e-6;  // Vertices nearer than this are one.
constexpr double kCrack_m = 1e-3;   // Gaps in plan that are none: models are rounded to 0.1 mm.
constexpr double kStep_m = 0.01;    // Jumps that need no face, such as that of a print's thickness.
constexpr double kAtFace_m = 1e-4;  // From a jump, in plan.
// The other side of the Earth has the same east and north.
constexpr double kThisSideOfEarth_m = 1e6;

Vec2 Plan(const Vec3& v) { return {v.x, v.y}; }

bool IsNear(const Vec3& at, double radius_m) {
  return Norm(Plan(at)) <= radius_m && Norm(at) <= kThisSideOfEarth_m;
}

}  // namespace

WalkedLine LineWalk::Walk(const LineToDrape& line) {
  walked_ = {};
  above_m_ = line.above_m;
  is_ring_ = line.kind == PartKind::kRing;
  faces_.clear();
  std::vector<std::optional<Cover>> covers;
  bool is_one_place = true;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const Vec3 &from = line.points[i - 1].xyz, &to = line.points[i].xyz;
    const std::optional<Stretch> stretch = InsideRadius(from, to);
    std::optional<Cover>& cover = covers.emplace_back();
    if (!stretch) {
      is_one_place = false;
      AddOffTarget(to);
    } else if (options_.own_heights || Norm(Plan(to - from)) > kOnLine_m) {
      is_one_place = false;
      cover = WalkStretch(*stretch, i == 1);
      if (!stretch->to_file) AddOffTarget(to);
    } else {
      const bool is_covered = surface_.HeightAt(Plan(to), options_.on).has_value();
      cover = Cover{is_covered, is_covered, is_covered, 0};
    }
  }
  if (is_one_place && !line.points.empty()) WalkAlone(line.points.front().xyz);
  if (is_ring_) CloseRing();
  // The first vertex may lie over no surface.
  std::vector<Point<World>>& ring = walked_.ring;
  if (!ring.empty() && Norm(Plan(ring.front().xyz - ring.back().xyz)) > 0.0) {
    ring.push_back(ring.front());
  }
  Count(line, covers);
  return std::move(walked_);
}

std::optional<LineWalk::Stretch> LineWalk::InsideRadius(const Vec3& from, const Vec3& to) const {
  if (std::max(Norm(from), Norm(to)) > kThisSideOfEarth_m) return std::nullopt;
  const double radius_m = options_.radius_m;
  const Vec2 a = Plan(from), way = Plan(to - from);
  const bool from_inside = Norm(a) <= radius_m, to_inside = Norm(Plan(to)) <= radius_m;
  if (from_inside && to_inside) return Stretch{from, to, true, true};
  // |a + s way|² = r².
  const double square = way.x * way.x + way.y * way.y;
  const double half = a.x * way.x + a.y * way.y;
  const double root = half * half - square * (a.x * a.x + a.y * a.y - radius_m * radius_m);
  if (!(root > 0.0) || !(square > 0.0)) return std::nullopt;
  const double enters = from_inside ? 0.0 : (-half - std::sqrt(root)) / square;
  const double leaves = to_inside ? 1.0 : (-half + std::sqrt(root)) / square;
  if (enters < 0.0 || leaves > 1.0 || !(enters < leaves)) return std::nullopt;
  return Stretch{from_inside ? from : from + (to - from) * enters,
                 to_inside ? to : from + (to - from) * leaves, from_inside, to_inside};
}

void LineWalk::WalkAlone(const Vec3& point) {
  if (!IsNear(point, options_.radius_m)) return;
  double height_m = point.z;
  if (!options_.own_heights) {
    const std::optional<double> surface_m = surface_.HeightAt(Plan(point), options_.on);
    if (!surface_m) return;
    height_m = *surface_m;
  }
  walked_.pieces.emplace_back();
  Add({{{point.x, point.y, height_m + above_m_}}, true});
}

LineWalk::Cover LineWalk::WalkStretch(const Stretch& stretch, bool is_first) {
  const double length_m = Norm(Plan(stretch.to - stretch.from));
  if (options_.own_heights) {
    const Vec3 up{0.0, 0.0, above_m_};
    const bool goes_on =
        !walked_.pieces.empty() &&
        Norm(walked_.pieces.back().vertices.back().at.xyz - stretch.from - up) <= kCrack_m;
    if (!goes_on) walked_.pieces.emplace_back();
    Add({{stretch.from + up}, stretch.from_file});
    Add({{stretch.to + up}, stretch.to_file});
    return {true, true, true, 0};
  }
  const SurfaceProfile& profile = profiler_.Along(Plan(stretch.from), Plan(stretch.to));
  // A face at the vertex between two stretches belongs to both.
  std::optional<ProfileFace> carried;
  if (!is_first && !faces_.empty() && faces_.back().at >= 1.0) carried = faces_.back();
  faces_ = profile.faces;
  if (carried && (faces_.empty() || faces_.front().at > 0.0)) {
    faces_.insert(faces_.begin(), {0.0, carried->low_z, carried->high_z});
  }
  Cover cover;
  double end = is_first ? -std::numeric_limits<double>::infinity() : 0.0;
  std::size_t next_face = 0;
  const auto stand_alone_until = [&](double begin) {
    for (; next_face < faces_.size(); ++next_face) {
      const ProfileFace& face = faces_[next_face];
      if ((begin - face.at) * length_m <= kAtFace_m) return;
      if ((face.at - end) * length_m > kAtFace_m) StandAlone(face, stretch);
    }
  };
  for (const ProfilePiece& piece : profile.pieces) {
    stand_alone_until(piece.begin);
    if (cover.anywhere && (piece.begin - end) * length_m > kCrack_m) ++cover.gaps;
    Follow(piece, stretch, length_m);
    cover.begins = cover.begins || piece.begin * length_m <= kCrack_m;
    cover.anywhere = true;
    end = piece.end;
    while (next_face < faces_.size() && (faces_[next_face].at - end) * length_m <= kAtFace_m) {
      ++next_face;
    }
  }
  stand_alone_until(std::numeric_limits<double>::infinity());
  cover.reaches = cover.anywhere && (1.0 - end) * length_m <= kCrack_m;
  if (!cover.reaches) AddOffTarget(stretch.to);
  return cover;
}

void LineWalk::Follow(const ProfilePiece& piece, const Stretch& stretch, double length_m) {
  const auto vertex = [&](double at, double z) {
    const bool is_from = at * length_m <= kMerged_m, is_to = (1.0 - at) * length_m <= kMerged_m;
    const Vec3 place = is_from ? stretch.from
                       : is_to ? stretch.to
                               : stretch.from + (stretch.to - stretch.from) * at;
    return DrapedVertex{{{place.x, place.y, z + above_m_}},
                        (is_from && stretch.from_file) || (is_to && stretch.to_file)};
  };
  Join(vertex(piece.begin, piece.begin_z), FaceAt(piece.begin, length_m));
  for (const ProfileFace& face : faces_) {
    const double z = piece.HeightAt(face.at);
    if ((face.at - piece.begin) * length_m <= kAtFace_m ||
        (piece.end - face.at) * length_m <= kAtFace_m || !Peaks(face, z)) {
      continue;
    }
    Add(vertex(face.at, z));
    Add(vertex(face.at, face.high_z));
    Add(vertex(face.at, z));
  }
  Add(vertex(piece.end, piece.end_z));
}

void LineWalk::StandAlone(const ProfileFace& face, const Stretch& stretch) {
  if (options_.on.choice == SurfaceChoice::kLowest) return;
  const Vec3 place = stretch.from + (stretch.to - stretch.from) * face.at;
  walked_.pieces.emplace_back();
  Add({{{place.x, place.y, face.low_z + above_m_}}, false});
  Add({{{place.x, place.y, face.high_z + above_m_}}, false});
}

bool LineWalk::Peaks(const ProfileFace& face, double surface_z) const {
  // A sign or a railing in the air is passed below.
  return options_.on.choice != SurfaceChoice::kLowest && face.high_z > surface_z + kStep_m &&
         face.low_z - surface_z <= 0.5 * (face.high_z - surface_z);
}

const ProfileFace* LineWalk::FaceAt(double at, double length_m) const {
  for (const ProfileFace& face : faces_) {
    if (std::fabs(face.at - at) * length_m <= kAtFace_m) return &face;
  }
  return nullptr;
}

void LineWalk::Join(const DrapedVertex& next, const ProfileFace* face) {
  if (walked_.pieces.empty()) {
    walked_.pieces.emplace_back();
    return Add(next);
  }
  const Vec3 last = walked_.pieces.back().vertices.back().at.xyz;
  const bool is_gap = Norm(Plan(next.at.xyz - last)) > kCrack_m;
  const double low = std::min(last.z, next.at.xyz.z) - above_m_;
  const double high = std::max(last.z, next.at.xyz.z) - above_m_;
  if (!is_gap && face != nullptr && Peaks(*face, high)) {
    Add({{{next.at.xyz.x, next.at.xyz.y, face->high_z + above_m_}}, false});
    return Add(next);
  }
  // A face that spans at least half of the jump is the wall between the two heights.
  const bool is_climbed =
      face != nullptr &&
      std::min(face->high_z, high) - std::max(face->low_z, low) >= 0.5 * (high - low);
  if (is_gap || (high - low > kStep_m && !is_climbed)) walked_.pieces.emplace_back();
  Add(next);
}

void LineWalk::Add(const DrapedVertex& vertex) {
  std::vector<DrapedVertex>& vertices = walked_.pieces.back().vertices;
  if (!vertices.empty() && Norm(vertices.back().at.xyz - vertex.at.xyz) <= kMerged_m) {
    // The file's vertex stays where two are one.
    if (vertex.of_file) {
      vertices.back() = vertex;
      if (is_ring_) walked_.ring.back() = vertex.at;
    }
    return;
  }
  vertices.push_back(vertex);
  if (is_ring_) walked_.ring.push_back(vertex.at);
}

void LineWalk::AddOffTarget(const Vec3& vertex) {
  if (!is_ring_) return;
  const double height_m = walked_.ring.empty() ? vertex.z + above_m_ : walked_.ring.back().xyz.z;
  walked_.ring.push_back({{vertex.x, vertex.y, height_m}});
}

void LineWalk::CloseRing() {
  if (walked_.pieces.empty()) return;
  const DrapedVertex first = walked_.pieces.front().vertices.front();
  const Vec3 last = walked_.pieces.back().vertices.back().at.xyz;
  if (!first.of_file || Norm(Plan(first.at.xyz - last)) > kCrack_m ||
      (walked_.pieces.size() == 1 && walked_.pieces[0].vertices.size() == 1)) {
    return;
  }
  const std::size_t pieces = walked_.pieces.size();
  Join(first, !faces_.empty() && faces_.back().at >= 1.0 ? &faces_.back() : nullptr);
  if (walked_.pieces.size() > pieces) {  // It jumps where it closes.
    walked_.pieces.pop_back();
    return;
  }
  walked_.pieces.front().starts = false;
  walked_.pieces.back().ends = false;
}

void LineWalk::Count(const LineToDrape& line, const std::vector<std::optional<Cover>>& covers) {
  const std::size_t count = line.points.size();
  const auto is_inside = [&](std::size_t i) {
    return IsNear(line.points[i].xyz, options_.radius_m);
  };
  const auto is_covered = [&](std::size_t i) {
    if (count == 1) return !walked_.pieces.empty();
    return (i > 0 && covers[i - 1] && covers[i - 1]->reaches) ||
           (i + 1 < count && covers[i] && covers[i]->begins);
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_inside(i)) {
      ++walked_.clipped;
    } else if (!is_covered(i)) {
      ++walked_.off_target;
    }
  }
  // Gaps that no vertex of the file lies in.
  for (std::size_t i = 0; i < covers.size(); ++i) {
    if (!covers[i]) continue;
    const Cover& cover = *covers[i];
    walked_.off_target += cover.gaps;
    const bool leads = !cover.begins && is_inside(i) && is_covered(i);
    const bool trails = !cover.reaches && is_inside(i + 1) && is_covered(i + 1);
    if (cover.anywhere) {
      walked_.off_target += (leads ? 1 : 0) + (trails ? 1 : 0);
    } else if (leads && trails) {
      ++walked_.off_target;
    }
  }
}

}  // namespace pleinair::content
