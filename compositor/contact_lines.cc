#include "compositor/contact_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace pleinair::compositor {
namespace {

// Surfaces that end so near to another one touch it: models are not exact.
constexpr double kTouchingM = 0.02;
// Sine of the least angle between surfaces that change each other's light within a short way.
constexpr double kLeastSine = 0.3;
constexpr double kShortestM = 0.02;
constexpr std::uint32_t kFewSegments = 4;
// Finding pairs of so many takes a tenth of a second; phantoms of more have vertices enough.
constexpr std::size_t kMostTriangles = 50'000;

struct Triangle {
  std::array<Vec3, 3> corners;
  Vec3 normal;
  bool two_sided = false;
  Vec3 low, high;  ///< Of the box that lies `kTouchingM` around it.

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

std::vector<Triangle> CoarseTriangles(const std::vector<SurfaceMesh>& surfaces, double finest_m) {
  std::vector<Triangle> triangles;
  for (const SurfaceMesh& surface : surfaces) {
    if (!surface.is_phantom) continue;
    for (std::size_t t = 0; t + 2 < surface.indices.size(); t += 3) {
      Triangle triangle;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto& p = surface.positions[surface.indices[t + c]];
        triangle.corners[c] = {p[0], p[1], p[2]};
      }
      const auto& [a, b, c] = triangle.corners;
      if (std::max({Norm(a - b), Norm(b - c), Norm(c - a)}) <= finest_m) continue;
      const Vec3 across = Cross(b - a, c - a);
      if (!(Norm(across) > 0.0)) continue;
      triangle.normal = Normalized(across);
      triangle.two_sided = !surface.closed;
      const Vec3 around{kTouchingM, kTouchingM, kTouchingM};
      triangle.low = Least(Least(a, b), c) - around;
      triangle.high = Most(Most(a, b), c) + around;
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

/// What of a triangle lies within touching distance of another one's plane.
std::vector<Vec3> StripOf(const Triangle& triangle, const Triangle& plane) {
  std::vector<Vec3> strip(triangle.corners.begin(), triangle.corners.end());
  for (const double side : {1.0, -1.0}) {
    // Sutherland & Hodgman 1974: what is below the limit stays.
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

std::optional<ContactLines::Segment> ContactOf(const Triangle& a, const Triangle& b) {
  if (!a.SeesPartOf(b) || !b.SeesPartOf(a)) return std::nullopt;
  const Vec3 across = Cross(a.normal, b.normal);
  const double sine = Norm(across);
  if (sine < kLeastSine) return std::nullopt;
  // The planes' common line.
  const Vec3 along = across * (1.0 / sine);
  const double at_a = Dot(a.normal, a.corners[0]), at_b = Dot(b.normal, b.corners[0]);
  const Vec3 origin =
      (Cross(b.normal, along) * at_a + Cross(along, a.normal) * at_b) * (1.0 / sine);
  double from = -1e300, to = 1e300;
  for (const auto& strip : {StripOf(a, b), StripOf(b, a)}) {
    double least = 1e300, most = -1e300;
    for (const Vec3 point : strip) {
      least = std::min(least, Dot(point - origin, along));
      most = std::max(most, Dot(point - origin, along));
    }
    from = std::max(from, least);
    to = std::min(to, most);
  }
  if (to - from < kShortestM) return std::nullopt;
  return ContactLines::Segment{origin + along * from, origin + along * to};
}

double DistanceToBox(Vec3 low, Vec3 high, Vec3 point) {
  return Norm(Most(Most(low - point, point - high), {}));
}

double DistanceToSegment(const ContactLines::Segment& segment, Vec3 point) {
  const Vec3 along = segment.to - segment.from;
  const double share = std::clamp(Dot(point - segment.from, along) / Dot(along, along), 0.0, 1.0);
  return Norm(segment.from + along * share - point);
}

}  // namespace

ContactLines::ContactLines(const std::vector<SurfaceMesh>& surfaces, double finest_m) {
  std::vector<Triangle> triangles = CoarseTriangles(surfaces, finest_m);
  if (triangles.empty() || triangles.size() > kMostTriangles) return;
  Vec3 low = triangles[0].low, high = triangles[0].high;
  for (const Triangle& triangle : triangles) {
    low = Least(low, triangle.low);
    high = Most(high, triangle.high);
  }
  const Vec3 axis = LongestAxis(high - low);
  std::sort(triangles.begin(), triangles.end(), [&](const Triangle& a, const Triangle& b) {
    return Dot(a.low, axis) < Dot(b.low, axis);
  });
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& a = triangles[i];
    const double last = Dot(a.high, axis);
    for (std::size_t j = i + 1; j < triangles.size() && Dot(triangles[j].low, axis) <= last; ++j) {
      const Triangle& b = triangles[j];
      if (b.low.x > a.high.x || a.low.x > b.high.x || b.low.y > a.high.y || a.low.y > b.high.y ||
          b.low.z > a.high.z || a.low.z > b.high.z) {
        continue;
      }
      if (const auto segment = ContactOf(a, b)) segments_.push_back(*segment);
    }
  }
  if (segments_.empty()) return;
  nodes_.push_back({{}, {}, 0, static_cast<std::uint32_t>(segments_.size()), 0});
  Divide(0);
}

void ContactLines::Divide(std::uint32_t index) {
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

bool ContactLines::IsWithin(const std::array<float, 3>& point, double reach_m) const {
  return !nodes_.empty() && IsWithin(0, {point[0], point[1], point[2]}, reach_m);
}

bool ContactLines::IsWithin(std::uint32_t index, Vec3 point, double reach_m) const {
  const Node& node = nodes_[index];
  if (DistanceToBox(node.low, node.high, point) > reach_m) return false;
  if (node.children != 0) {
    return IsWithin(node.children, point, reach_m) || IsWithin(node.children + 1, point, reach_m);
  }
  return std::any_of(segments_.begin() + node.first, segments_.begin() + node.last,
                     [&](const Segment& s) { return DistanceToSegment(s, point) <= reach_m; });
}

}  // namespace pleinair::compositor
