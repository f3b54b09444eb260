#include "app/flow/level_lines.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "content/flow/flow_levels.h"
#include "content/flow/nearest_levels.h"

namespace pleinair::app {
namespace {

using content::FlowLine;
using content::LineDirection;
using content::LineEnd;

/// One way of all lines: points after 0…steps steps, until they leave.
template <typename Levels>
std::vector<std::vector<Vec3>> PointsOf(const Levels& levels, std::span<const content::Seed> seeds,
                                        int steps) {
  std::vector<std::vector<Vec3>> lines(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    for (int n = 0; n <= steps; ++n) {
      const Vec3 point = levels.After(seeds[i].point, static_cast<std::uint32_t>(n));
      if (std::isnan(point.x)) break;
      lines[i].push_back(point);
    }
  }
  return lines;
}

/// Appends one way to a line; the first vertex is the seed.
void AppendWay(const std::vector<Vec3>& points, const content::VectorField& field,
               const content::TraceOptions& options, double sign, FlowLine* line) {
  for (std::size_t n = line->points.empty() ? 0 : 1; n < points.size(); ++n) {
    const Vec3 v = field.At(points[n], options.frozen_at_s), s = field.Stretch(points[n]);
    line->points.push_back(points[n]);
    line->times_s.push_back(sign * static_cast<double>(n) * options.step_s);
    line->speeds_m_s.push_back(Norm(Vec3{v.x / s.x, v.y / s.y, v.z / s.z}));
  }
}

}  // namespace

Result<LevelLines> FollowLevels(const content::VectorField& field,
                                std::span<const content::Seed> seeds,
                                const content::TraceOptions& options, int steps, bool nearest) {
  LevelLines result;
  result.lines.resize(seeds.size());
  const int levels = std::countr_zero(static_cast<unsigned>(steps));
  for (const double sign : {-1.0, 1.0}) {
    const auto unused = sign < 0.0 ? LineDirection::kForward : LineDirection::kBackward;
    if (options.direction == unused) continue;
    const auto start = std::chrono::steady_clock::now();
    std::vector<std::vector<Vec3>> points;
    const auto follow = [&](const auto& built) {
      result.build_ms +=
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
              .count();
      result.field_reads += built.field_reads();
      result.levels += built.levels();
      points = PointsOf(built, seeds, steps);
    };
    if (nearest) {
      PLEINAIR_ASSIGN_OR_RETURN(
          const auto built,
          content::NearestLevels::Build(field, options.frozen_at_s, sign * options.step_s, levels));
      follow(built);
    } else {
      PLEINAIR_ASSIGN_OR_RETURN(
          const auto built,
          content::FlowLevels::Build(field, options.frozen_at_s, sign * options.step_s, levels,
                                     options.threads));
      follow(built);
    }
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      FlowLine& line = result.lines[i];
      line.seed = i;
      AppendWay(points[i], field, options, sign, &line);
      const LineEnd end = points[i].size() == static_cast<std::size_t>(steps) + 1
                              ? LineEnd::kDuration
                              : LineEnd::kLeft;
      (sign < 0.0 ? line.upstream_end : line.downstream_end) = end;
      if (sign > 0.0 || options.direction == LineDirection::kBackward) {
        if (options.progress) options.progress();
        continue;
      }
      std::reverse(line.points.begin(), line.points.end());
      std::reverse(line.times_s.begin(), line.times_s.end());
      std::reverse(line.speeds_m_s.begin(), line.speeds_m_s.end());
    }
  }
  std::erase_if(result.lines, [](const FlowLine& line) { return line.points.size() < 2; });
  return result;
}

}  // namespace pleinair::app
