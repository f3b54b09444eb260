#include "compositor/light/contact_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace pleinair::compositor {
namespace {

// Surfaces whose gap is at most this touch each other, because models are not exact.
constexpr double kTouchingM = 0.02;
// Sine of the min. angle between surfaces that change each other's light within a short distance.
constexpr double kMinSine = 0.3;
constexpr double kMinEdge_m = 0.02;
constexpr std::uint32_t kFewSegments = 4;
// Limits of the search: compared boxes, and compared triangles among those whose boxes overlap.
// Each limit takes some tenths of a second; bundled scenes need a thousandth of it.
constexpr std::size_t kMaxTriangles = 200'000, kMaxBoxes = 50'000'000, kMaxPairs = 200'000;
// Ends of edges that are no farther apart than this count as equal.
constexpr double kSamePlaceM = 1e-3;

struct Triangle {
  std::array<Vec3, 3> corners;
  Vec3 normal;
  bool two_sided = false;
  Vec3 low, high;  ///< The bounding box, extended by `kTouchingM`.

  double Height(Vec3 point) const { return Dot(point - corners[0], normal); }
  bool SeesPartOf(const Triangle& other) const {
    return std::any_of(other.corners.begin(), other.corners.end(), [&](Vec3 corner) {
      const double height = Height(corner);
      return (two_sided ? std::fabs(height) : height) > kTouchingM;
    });
  }
};

Vec3 Least(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 Most(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

Vec3 LongestAxis(Vec3 size) {
  if (size.x >= size.y && size.x >= size.z) return {1.0, 0.0, 0.0};
  return size.y >= size.z ? Vec3{0.0, 1.0, 0.0} : Vec3{0.0, 0.0, 1.0};
}

/// Triangles with an edge that a contact would shorten, and triangles without.
struct Triangles {
  std::vector<Triangle> coarse, fine;
};

bool IsCoarse(const std::array<std::array<float, 3>, 3>& corners,
              const ContactEdges::EdgeLimit& edge_limit) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &a = corners[i], &b = corners[(i + 1) % 3];
    const std::array<float, 3> middle{(a[0] + b[0]) * 0.5F, (a[1] + b[1]) * 0.5F,
                                      (a[2] + b[2]) * 0.5F};
    if (std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) > edge_limit(middle)) return true;
  }
  return false;
}

/// Collects the phantoms' triangles; none if there are too many.
Triangles PhantomTriangles(const std::vector<SurfaceMesh>& surfaces,
                           const ContactEdges::EdgeLimit& edge_limit) {
  Triangles triangles;
  std::size_t count = 0;
  for (const SurfaceMesh& surface : surfaces) {
    if (surface.is_phantom) count += surface.indices.size() / 3;
  }
  if (count > kMaxTriangles) return triangles;
  for (const SurfaceMesh& surface : surfaces) {
    if (!surface.is_phantom) continue;
    for (std::size_t t = 0; t + 2 < surface.indices.size(); t += 3) {
      std::array<std::array<float, 3>, 3> positions;
      Triangle triangle;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto& p = positions[c] = surface.positions[surface.indices[t + c]];
        triangle.corners[c] = {p[0], p[1], p[2]};
      }
      const auto& [a, b, c] = triangle.corners;
      const Vec3 across = Cross(b - a, c - a);
      if (!(Norm(across) > 0.0)) continue;
      triangle.normal = Normalized(across);
      triangle.two_sided = !surface.closed;
      const Vec3 around{kTouchingM, kTouchingM, kTouchingM};
      triangle.low = Least(Least(a, b), c) - around;
      triangle.high = Most(Most(a, b), c) + around;
      (IsCoarse(positions, edge_limit) ? triangles.coarse : triangles.fine).push_back(triangle);
    }
  }
  return triangles;
}

/// Clips a triangle to within touching distance of another one's plane.
std::vector<Vec3> StripOf(const Triangle& triangle, const Triangle& plane) {
  std::vector<Vec3> strip(triangle.corners.begin(), triangle.corners.end());
  for (const double side : {1.0, -1.0}) {
    // Sutherland & Hodgman 1974: points below the limit are kept.
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < strip.size(); ++i) {
      const Vec3 here = strip[i], next = strip[(i + 1) % strip.size()];
      const double above = side * plane.Height(here) - kTouchingM;
      const double next_above = side * plane.Height(next) - kTouchingM;
      if (above <= 0.0) kept.push_back(here);
      if ((above <= 0.0) != (next_above <= 0.0)) {
        kept.push_back(here + (next - here) * (above / (above - next_above)));
      }
    }
    strip = std::move(kept);
  }
  return strip;
}

std::optional<ContactEdges::Segment> ContactOf(const Triangle& a, const Triangle& b) {
  if (!a.SeesPartOf(b) || !b.SeesPartOf(a)) return std::nullopt;
  const Vec3 across = Cross(a.normal, b.normal);
  const double sine = Norm(across);
  if (sine < kMinSine) return std::nullopt;
  // The planes' intersection line.
  const Vec3 along = across * (1.0 / sine);
  const double at_a = Dot(a.normal, a.corners[0]), at_b = Dot(b.normal, b.corners[0]);
  const Vec3 origin =
      (Cross(b.normal, along) * at_a + Cross(along, a.normal) * at_b) * (1.0 / sine);
  double from = -1e300, to = 1e300;
  for (const auto& strip : {StripOf(a, b), StripOf(b, a)}) {
    double minimum = 1e300, maximum = -1e300;
    for (const Vec3 point : strip) {
      minimum = std::min(minimum, Dot(point - origin, along));
      maximum = std::max(maximum, Dot(point - origin, along));
    }
    from = std::max(from, minimum);
    to = std::min(to, maximum);
  }
  if (to - from < kMinEdge_m) return std::nullopt;
  return ContactEdges::Segment{origin + along * from, origin + along * to};
}

double DistanceToBox(Vec3 low, Vec3 high, Vec3 point) {
  return Norm(Most(Most(low - point, point - high), {}));
}

double DistanceToSegment(const ContactEdges::Segment& segment, Vec3 point) {
  const Vec3 along = segment.to - segment.from;
  const double share = std::clamp(Dot(point - segment.from, along) / Dot(along, along), 0.0, 1.0);
  return Norm(segment.from + along * share - point);
}

/// Finds contacting pairs by a sweep over boxes sorted along an axis.
class ContactSweep {
 public:
  /// Returns false if the search exceeds its limits.
  bool Run(Triangles* triangles) {
    Vec3 low = triangles->coarse[0].low, high = triangles->coarse[0].high;
    for (const Triangle& triangle : triangles->coarse) {
      low = Least(low, triangle.low);
      high = Most(high, triangle.high);
    }
    axis_ = LongestAxis(high - low);
    for (auto* list : {&triangles->coarse, &triangles->fine}) {
      std::stable_sort(list->begin(), list->end(), [this](const Triangle& a, const Triangle& b) {
        return Start(a) < Start(b);
      });
    }
    const auto &coarse = triangles->coarse, &fine = triangles->fine;
    for (auto a = coarse.begin(); a != coarse.end(); ++a) {
      const auto beside =
          std::lower_bound(fine.begin(), fine.end(), Start(*a),
                           [this](const Triangle& b, double start) { return Start(b) < start; });
      if (!Meet(*a, a + 1, coarse.end()) || !Meet(*a, beside, fine.end())) return false;
    }
    return std::all_of(fine.begin(), fine.end(), [&](const Triangle& a) {
      const auto beside =
          std::upper_bound(coarse.begin(), coarse.end(), Start(a),
                           [this](double start, const Triangle& b) { return start < Start(b); });
      return Meet(a, beside, coarse.end());
    });
  }

  std::vector<ContactEdges::Segment>& segments() { return segments_; }

 private:
  using Iterator = std::vector<Triangle>::const_iterator;

  double Start(const Triangle& triangle) const { return Dot(triangle.low, axis_); }

  /// Tests triangles that start later, within the extent of `a`.
  bool Meet(const Triangle& a, Iterator b, Iterator end) {
    const double last = Dot(a.high, axis_);
    for (; b != end && Start(*b) <= last; ++b) {
      if (++boxes_ > kMaxBoxes) return false;
      if (b->low.x > a.high.x || a.low.x > b->high.x || b->low.y > a.high.y ||
          a.low.y > b->high.y || b->low.z > a.high.z || a.low.z > b->high.z) {
        continue;
      }
      if (++pairs_ > kMaxPairs) return false;
      if (const auto segment = ContactOf(a, *b)) segments_.push_back(*segment);
    }
    return true;
  }

  Vec3 axis_;
  std::size_t boxes_ = 0, pairs_ = 0;
  std::vector<ContactEdges::Segment> segments_;
};

/// Keeps one of the segments with the same ends, in either direction.
void DropDuplicates(std::vector<ContactEdges::Segment>* segments) {
  using Place = std::array<double, 3>;
  struct Keyed {
    std::array<Place, 2> ends;
    ContactEdges::Segment segment;
  };
  std::vector<Keyed> keyed;
  keyed.reserve(segments->size());
  for (const ContactEdges::Segment& segment : *segments) {
    const auto rounded = [](Vec3 p) {
      const auto round = [](double v) { return std::round(v / kSamePlaceM); };
      return Place{round(p.x), round(p.y), round(p.z)};
    };
    std::array<Place, 2> ends{rounded(segment.from), rounded(segment.to)};
    if (ends[1] < ends[0]) std::swap(ends[0], ends[1]);
    keyed.push_back({ends, segment});
  }
  std::stable_sort(keyed.begin(), keyed.end(),
                   [](const Keyed& a, const Keyed& b) { return a.ends < b.ends; });
  const auto end = std::unique(keyed.begin(), keyed.end(),
                               [](const Keyed& a, const Keyed& b) { return a.ends == b.ends; });
  segments->clear();
  for (auto it = keyed.begin(); it != end; ++it) segments->push_back(it->segment);
}

}  // namespace

ContactEdges::ContactEdges(const std::vector<SurfaceMesh>& surfaces, const EdgeLimit& edge_limit) {
  Triangles triangles = PhantomTriangles(surfaces, edge_limit);
  if (triangles.coarse.empty()) return;
  ContactSweep sweep;
  if (!sweep.Run(&triangles)) return;
  DropDuplicates(&sweep.segments());
  if (sweep.segments().empty() || sweep.segments().size() > kMaxSegments) return;
  segments_ = std::move(sweep.segments());
  nodes_.push_back({{}, {}, 0, static_cast<std::uint32_t>(segments_.size()), 0});
  Divide(0);
}

void ContactEdges::Divide(std::uint32_t index) {
  const std::uint32_t first = nodes_[index].first, last = nodes_[index].last;
  Vec3 low{1e300, 1e300, 1e300}, high = -low;
  for (std::uint32_t i = first; i < last; ++i) {
    low = Least(low, Least(segments_[i].from, segments_[i].to));
    high = Most(high, Most(segments_[i].from, segments_[i].to));
  }
  nodes_[index].low = low;
  nodes_[index].high = high;
  if (last - first <= kFewSegments) return;
  const Vec3 axis = LongestAxis(high - low);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(segments_.begin() + first, segments_.begin() + middle, segments_.begin() + last,
                   [&](const Segment& a, const Segment& b) {
                     return Dot(a.from + a.to, axis) < Dot(b.from + b.to, axis);
                   });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_[index].children = children;
  nodes_.push_back({{}, {}, first, middle, 0});
  nodes_.push_back({{}, {}, middle, last, 0});
  Divide(children);
  Divide(children + 1);
}

bool ContactEdges::IsWithin(const std::array<float, 3>& point, double reach_m) const {
  return !nodes_.empty() && IsWithin(0, {point[0], point[1], point[2]}, reach_m);
}

bool ContactEdges::IsWithin(std::uint32_t index, Vec3 point, double reach_m) const {
  const Node& node = nodes_[index];
  if (DistanceToBox(node.low, node.high, point) > reach_m) return false;
  if (node.children != 0) {
    return IsWithin(node.children, point, reach_m) || IsWithin(node.children + 1, point, reach_m);
  }
  return std::any_of(segments_.begin() + node.first, segments_.begin() + node.last,
                     [&](const Segment& s) { return DistanceToSegment(s, point) <= reach_m; });
}

}  // namespace pleinair::compositor
