#include "shadows/edge_map.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace pleinair::shadows {
namespace {

// As EdgeLine() in shaders/shadow_formulae.glsl.
constexpr double kNormalSteps = 1023.0, kDistanceSteps = 1023.0, kFarthest = 0.75;
constexpr unsigned kNormalBits = 11, kDistanceBits = 10;

std::uint32_t DistanceOf(std::uint32_t line) { return line & ((1U << kDistanceBits) - 1U); }

/// Whether two lines of a texel are the same to a fortieth of a texel. Both sides of an open
/// surface have such lines, and so has a flat one that is cut in two.
bool AreAlike(std::uint32_t line, std::uint32_t other) {
  constexpr int kAlike = 32;
  const auto differ = [&](unsigned shift, unsigned bits) {
    const std::uint32_t mask = (1U << bits) - 1U;
    return std::abs(static_cast<int>((line >> shift) & mask) -
                    static_cast<int>((other >> shift) & mask)) > kAlike;
  };
  return !differ(0, kDistanceBits) && !differ(kDistanceBits, kNormalBits) &&
         !differ(kDistanceBits + kNormalBits, kNormalBits);
}

/// Cuts a line off outside of [0, side] along one axis. False: nothing is left.
bool Clip(glm::dvec2& a, glm::dvec2& b, int axis, double side) {
  for (const double bound : {0.0, side}) {
    const double sign = bound > 0.0 ? -1.0 : 1.0;
    const double da = sign * (a[axis] - bound), db = sign * (b[axis] - bound);
    if (!(da >= 0.0 || db >= 0.0)) return false;
    if (da < 0.0) a = glm::mix(a, b, da / (da - db));
    if (db < 0.0) b = glm::mix(b, a, db / (db - da));
  }
  return true;
}

void AddTo(EdgeMap::Lines& lines, std::uint32_t line) {
  for (std::uint32_t& slot : lines) {
    if (slot == 0) {
      slot = line;
      return;
    }
    if (AreAlike(slot, line)) return;
    if (DistanceOf(line) < DistanceOf(slot)) std::swap(line, slot);
  }
}

/// Adds a line to the texels that it crosses; (0, 0) is a corner of the first one.
void AddLine(glm::dvec2 a, glm::dvec2 b, int side, std::span<EdgeMap::Lines> texels) {
  const glm::dvec2 along = b - a;
  const double length = glm::length(along);
  if (!(length > 1e-9 && std::isfinite(length))) return;
  const glm::dvec2 normal(-along.y / length, along.x / length);
  const double offset = glm::dot(normal, a);
  if (!Clip(a, b, 0, side) || !Clip(a, b, 1, side)) return;
  const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x);
  const int major = steep ? 1 : 0, minor = 1 - major;
  if (a[major] > b[major]) std::swap(a, b);
  const auto texel = [side](double value) {
    return std::clamp(static_cast<int>(std::floor(value)), 0, side - 1);
  };
  const double slope = b[major] > a[major] ? (b[minor] - a[minor]) / (b[major] - a[major]) : 0.0;
  for (int i = texel(a[major]); i <= texel(b[major]); ++i) {
    const double from = std::max<double>(i, a[major]) - a[major];
    const double to = std::min<double>(i + 1, b[major]) - a[major];
    const double first = a[minor] + slope * from, last = a[minor] + slope * to;
    for (int j = texel(std::min(first, last)); j <= texel(std::max(first, last)); ++j) {
      const glm::ivec2 at = steep ? glm::ivec2(j, i) : glm::ivec2(i, j);
      const double distance = offset - glm::dot(normal, glm::dvec2(at) + 0.5);
      const double sign = distance < 0.0 ? -1.0 : 1.0;
      AddTo(texels[static_cast<std::size_t>(at.y) * side + at.x],
            EdgeMap::Packed(sign * normal, sign * distance));
    }
  }
}

}  // namespace

std::uint32_t EdgeMap::Packed(const glm::dvec2& to_line, double distance_texels) {
  const auto component = [](double value) {
    return static_cast<std::uint32_t>(
        std::lround((std::clamp(value, -1.0, 1.0) + 1.0) * kNormalSteps));
  };
  const double share = std::clamp(distance_texels / kFarthest, 0.0, 1.0);
  const auto distance = static_cast<std::uint32_t>(std::lround(share * kDistanceSteps));
  return component(to_line.y) << (kDistanceBits + kNormalBits) |
         component(to_line.x) << kDistanceBits | distance;
}

Result<EdgeMap> EdgeMap::Create(int side) {
  EdgeMap map;
  PLEINAIR_ASSIGN_OR_RETURN(map.texture_, gl::GlTexture::Create2D(GL_RG32UI, side, side));
  map.texture_.SetFilter(GL_NEAREST, GL_NEAREST);
  return map;
}

void EdgeMap::Draw(std::span<const Caster> casters) {
  const bool has_edges =
      std::ranges::any_of(casters, [](const Caster& caster) { return !caster.edges.empty(); });
  if (!has_edges && !has_lines_) return;
  const int side = texture_.width();
  std::vector<Lines> texels(static_cast<std::size_t>(side) * side, Lines{});
  for (const Caster& caster : casters) {
    for (const CasterEdge& edge : caster.edges) {
      if (!edge.IsOutline(caster.to_sun)) continue;
      AddLine(glm::dvec2(caster.texel_from_model * glm::dvec4(edge.a, 1.0)),
              glm::dvec2(caster.texel_from_model * glm::dvec4(edge.b, 1.0)), side, texels);
    }
  }
  texture_.Upload(GL_RG_INTEGER, GL_UNSIGNED_INT, texels.data());
  has_lines_ = has_edges;
}

}  // namespace pleinair::shadows
