#include "accuracy/occluder_masks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace pleinair::accuracy {
namespace {

constexpr int kTexels = Occluder::kTexels;
/// Texels of the marker's square along an axis: the first, and one after the last.
constexpr int kFirstTexel = static_cast<int>(-Occluder::kFirst * Occluder::kTexelsPerEdge);
constexpr int kLastTexel = kFirstTexel + Occluder::kTexelsPerEdge;
constexpr double kBorder = (1.0 - kContentShare) / 2.0;  // The border's width, in edges.

/// Centre of a texel along an axis, in edges.
double PlaceOf(int texel) { return Occluder::kFirst + (texel + 0.5) / Occluder::kTexelsPerEdge; }

/// Signed distance to an occluder's outline at a point (u right, v down, edges), or -1 and 1.
using Outline = std::function<double(double u, double v)>;

double Box(double u, double v, double u0, double v0, double u1, double v1) {
  return u > u0 && u < u1 && v > v0 && v < v1 ? -1.0 : 1.0;
}

/// Signed distance to a finger: all points within `radius` of a line segment.
double Capsule(Vec2 at, Vec2 from, Vec2 to, double radius) {
  const Vec2 along = to - from, away = at - from;
  const double length2 = std::max(along.x * along.x + along.y * along.y, 1e-9);
  const double share = std::clamp((away.x * along.x + away.y * along.y) / length2, 0.0, 1.0);
  return Norm(away - along * share) - radius;
}

/// The point that quarter turns about the marker's centre move to (u, v).
Vec2 TurnedBack(double u, double v, int quarters) {
  Vec2 at{u, v};
  for (int i = 0; i < quarters; ++i) at = {1.0 - at.y, at.x};
  return at;
}

Image<float> Rasterize(const Outline& outline, int quarters) {
  Image<float> distance(kTexels, kTexels);
  for (int y = 0; y < kTexels; ++y) {
    for (int x = 0; x < kTexels; ++x) {
      const Vec2 at = TurnedBack(PlaceOf(x), PlaceOf(y), quarters);
      distance(x, y) = static_cast<float>(outline(at.x, at.y));
    }
  }
  return distance;
}

/// The outline whose mask covers `share`, for a parameter 0…1.
Outline Bisect(const std::function<Outline(double)>& family, double share, bool of_content) {
  const auto covered = [&](double parameter) {
    const Outline outline = family(parameter);
    int inside = 0, all = 0;
    for (int y = kFirstTexel; y < kLastTexel; ++y) {
      for (int x = kFirstTexel; x < kLastTexel; ++x) {
        if (IsContent(x, y) != of_content) continue;
        ++all;
        inside += outline(PlaceOf(x), PlaceOf(y)) < 0.0;
      }
    }
    return static_cast<double>(inside) / all;
  };
  constexpr int kHalvings = 12;
  double low = 0.0, high = 1.0, best = 0.0, best_error = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high), error = covered(middle) - share;
    if (std::fabs(error) < best_error) {
      best_error = std::fabs(error);
      best = middle;
    }
    (error < 0.0 ? low : high) = middle;
  }
  return family(best);
}

/// A corner that is covered along both sides for a length of `reach`, at most to the border's
/// depth.
double Corner(double u, double v, double reach, double beyond) {
  const double depth = std::min(reach, kBorder);
  return std::min(Box(u, v, -beyond, -beyond, reach, depth),
                  Box(u, v, -beyond, -beyond, depth, reach));
}

bool InContent(double u, double v) {
  return std::fabs(u - 0.5) < kContentShare / 2 && std::fabs(v - 0.5) < kContentShare / 2;
}

/// Finger tips that hold the marker's edge.
std::function<Outline(double)> Fingers(double share, RandomStream* random) {
  struct Finger {
    double place, depth, turn;
  };
  std::vector<Finger> fingers(std::clamp(static_cast<int>(std::lround(share * 18)), 1, 12));
  const double first = random->Uniform();
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    fingers[i].place = (static_cast<double>(i) + first + random->Uniform(-.25, .25)) * 4.0 /
                       static_cast<double>(fingers.size());
    fingers[i].depth = random->Uniform(.75, 1.0);
    fingers[i].turn = random->Uniform(-.35, .35);
  }
  return [fingers](double parameter) -> Outline {
    const double radius = parameter * 0.45;
    return [fingers, radius](double u, double v) {
      if (InContent(u, v)) return 1.0;
      double nearest = 1.0;
      for (const Finger& finger : fingers) {
        const int side = ((static_cast<int>(std::floor(finger.place)) % 4) + 4) % 4;
        const double along = finger.place - std::floor(finger.place);
        const Vec2 tip{along, std::max(kBorder * finger.depth - radius, -radius * 0.6)};
        const Vec2 root = tip + Vec2{std::sin(finger.turn), -std::cos(finger.turn)};
        nearest = std::min(nearest, Capsule(TurnedBack(u, v, side), root, tip, radius));
      }
      return nearest;
    };
  };
}

/// A palm with four fingers that enters across one side.
std::function<Outline(double)> Hand(RandomStream* random) {
  const double spacing = random->Uniform(.15, .19), offset = random->Uniform(-.08, .08);
  std::array<double, 4> lengths{};
  for (double& length : lengths) length = random->Uniform(.75, 1.0);
  return [=](double reach) -> Outline {
    return [=](double u, double v) {
      double nearest =
          Capsule({u, v}, {.5 + offset, -2}, {.5 + offset, -1.1 + reach * 1.3}, spacing * 2);
      for (int i = 0; i < 4; ++i) {
        const double x = .5 + offset + (i - 1.5) * spacing;
        const Vec2 tip{x + (i - 1.5) * .02, -.55 + reach * 1.3 * lengths[i]};
        nearest = std::min(nearest, Capsule({u, v}, {x, -2}, tip, spacing * .47));
      }
      return nearest;
    };
  };
}

/// One finger across the border into the content: first deeper, then thicker.
std::function<Outline(double)> Finger(RandomStream* random) {
  const double x = random->Uniform(.38, .62), lean = random->Uniform(-.15, .15);
  return [=](double reach) -> Outline {
    const double radius = .055 + std::max(0.0, reach - .5) * .6;
    const Vec2 tip{x, .19 + std::min(reach, .5) * .86};
    return [=](double u, double v) { return Capsule({u, v}, {x + lean, -2}, tip, radius); };
  };
}

/// Patches of a smooth random field, over the border or the content alone.
std::function<Outline(double)> Blobs(bool content, RandomStream* random) {
  constexpr int kNodes = 26;
  std::vector<double> nodes(kNodes * kNodes);
  for (double& node : nodes) node = random->Normal();
  // Uniform cubic B-spline: smooth, and within the range of its nodes.
  const auto weights = [](double t) {
    return std::array<double, 4>{(1 - t) * (1 - t) * (1 - t) / 6,
                                 (3 * t * t * t - 6 * t * t + 4) / 6,
                                 (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6};
  };
  Image<float> field(kTexels, kTexels);
  for (int y = 0; y < kTexels; ++y) {
    for (int x = 0; x < kTexels; ++x) {
      const double scale = (kNodes - 3.0) / kTexels;
      const int column = static_cast<int>(x * scale), row = static_cast<int>(y * scale);
      const auto wx = weights(x * scale - column), wy = weights(y * scale - row);
      double value = 0.0;
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          value += wy[j] * wx[i] * nodes[(row + j) * kNodes + column + i];
        }
      }
      field(x, y) = static_cast<float>(value);
    }
  }
  constexpr double kSpan = 3.0;  // Range of the parameter, in standard deviations both ways.
  return [field = std::move(field), content](double parameter) -> Outline {
    const double level = (2.0 * parameter - 1.0) * kSpan;
    return [&field, content, level](double u, double v) {
      if (InContent(u, v) != content) return 1.0;
      const auto texel = [](double at) {
        return std::clamp(static_cast<int>((at - Occluder::kFirst) * Occluder::kTexelsPerEdge), 0,
                          kTexels - 1);
      };
      return field(texel(u), texel(v)) < level ? -1.0 : 1.0;
    };
  };
}

/// Bars and corners; `beyond` is how far they extend beyond the marker.
std::function<Outline(double)> Flat(const std::string& pattern, double beyond) {
  const double o = beyond;
  return [pattern, o](double p) -> Outline {
    const auto corner = [o](double u, double v, double reach, int quarters) {
      const Vec2 at = TurnedBack(u, v, quarters);
      return Corner(at.x, at.y, reach, o);
    };
    if (pattern == "corner1") return [=](double u, double v) { return corner(u, v, p, 0); };
    if (pattern == "corners2") {
      return [=](double u, double v) { return std::min(corner(u, v, p, 0), corner(u, v, p, 2)); };
    }
    if (pattern == "corners4") {
      return [=](double u, double v) {
        return std::min({corner(u, v, p / 2, 0), corner(u, v, p / 2, 1), corner(u, v, p / 2, 2),
                         corner(u, v, p / 2, 3)});
      };
    }
    const double depth = p * kBorder;
    if (pattern == "side1") {
      return [=](double u, double v) { return Box(u, v, -o, -o, 1 + o, depth); };
    }
    if (pattern == "sides2opp") {
      return [=](double u, double v) {
        return std::min(Box(u, v, -o, -o, 1 + o, depth), Box(u, v, -o, 1 - depth, 1 + o, 1 + o));
      };
    }
    if (pattern == "sides2adj") {
      return [=](double u, double v) {
        return std::min(Box(u, v, -o, -o, 1 + o, depth), Box(u, v, -o, -o, depth, 1 + o));
      };
    }
    // cbar: whole rows of the content.
    return [=](double u, double v) {
      return Box(u, v, kBorder, kBorder, 1 - kBorder, kBorder + p * kContentShare);
    };
  };
}

}  // namespace

bool IsMarker(int x, int y) {
  return x >= kFirstTexel && x < kLastTexel && y >= kFirstTexel && y < kLastTexel;
}

bool IsContent(int x, int y) { return InContent(PlaceOf(x), PlaceOf(y)); }

CoveredShares SharesOf(const Image<float>& cover) {
  double border = 0.0, content = 0.0;
  int border_texels = 0, content_texels = 0;
  for (int y = 0; y < kTexels; ++y) {
    for (int x = 0; x < kTexels; ++x) {
      if (!IsMarker(x, y)) continue;
      (IsContent(x, y) ? content : border) += cover(x, y);
      ++(IsContent(x, y) ? content_texels : border_texels);
    }
  }
  return {border / border_texels, content / content_texels,
          (border + content) / (border_texels + content_texels)};
}

OccluderMask MakeOccluderMask(const std::string& pattern, double share, RandomStream* random) {
  const double beyond = random->Uniform(.12, .45);
  int quarters = random->Below(4);
  bool rounded = true;
  const bool of_content = std::find(ContentPatterns().begin(), ContentPatterns().end(), pattern) !=
                          ContentPatterns().end();
  std::function<Outline(double)> family;
  if (pattern == "fingers") {
    family = Fingers(share, random);
    quarters = 0;
  } else if (pattern == "hand" || pattern == "chand") {
    family = Hand(random);
  } else if (pattern == "cfinger") {
    family = Finger(random);
  } else {
    rounded = false;
    if (pattern == "blobs" || pattern == "cblobs") {
      family = Blobs(of_content, random);
      quarters = 0;
    } else {
      family = Flat(pattern, beyond);
    }
  }
  OccluderMask mask;
  mask.distance = Rasterize(Bisect(family, share, of_content), quarters);
  mask.cover = Image<float>(kTexels, kTexels);
  for (std::size_t i = 0; i < mask.cover.size(); ++i) {
    mask.cover.data()[i] = mask.distance.data()[i] < 0.0F ? 1.0F : 0.0F;
  }
  if (!rounded) mask.distance = {};
  return mask;
}

}  // namespace pleinair::accuracy
