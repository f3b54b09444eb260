#include "content/flow/line_integrator.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "base/parallel_for.h"
#include "content/flow/grid_field.h"
#include "content/flow/line_tracer.h"
#include "content/flow/moving_particles.h"

namespace pleinair::content {
namespace {

constexpr double kDiagonals = 4.0;
constexpr std::size_t kChunk = 8;  // Lines that a thread takes at once.
constexpr int kStreakParticles = 128;

/// Appends the vertices behind the first, which both ways share.
void AppendDownstream(const LineVertices& vertices, FlowLine* line) {
  const auto skip = line->points.empty() ? 0 : 1;
  line->points.insert(line->points.end(), vertices.points.begin() + skip, vertices.points.end());
  line->times_s.insert(line->times_s.end(), vertices.times_s.begin() + skip,
                       vertices.times_s.end());
  line->speeds_m_s.insert(line->speeds_m_s.end(), vertices.speeds_m_s.begin() + skip,
                          vertices.speeds_m_s.end());
}

void Reverse(FlowLine* line) {
  std::reverse(line->points.begin(), line->points.end());
  std::reverse(line->times_s.begin(), line->times_s.end());
  std::reverse(line->speeds_m_s.begin(), line->speeds_m_s.end());
}

/// The streamline of a seed; empty where there is no flow.
FlowLine StreamLine(const Seed& seed, const TraceOptions& options, LineTracer* tracer,
                    LineVertices* scratch) {
  FlowLine line;
  const Seed start{seed.point, 0.0};
  const auto follow = [&](double sign, std::optional<LineEnd>* end) {
    scratch->Clear();
    LineState state;
    if (!tracer->Begin(start, &state, scratch)) return;
    *end = tracer->Advance(&state, sign * options.duration_s, nullptr, scratch)
               .value_or(LineEnd::kDuration);
    line.field_reads += state.field_reads;
    AppendDownstream(*scratch, &line);
  };
  if (options.direction != LineDirection::kForward) {
    follow(-1.0, &line.upstream_end);
    if (options.direction == LineDirection::kBoth) Reverse(&line);
  }
  // A closed line has been followed as a whole.
  if (options.direction == LineDirection::kForward ||
      (options.direction == LineDirection::kBoth && line.upstream_end &&
       line.upstream_end != LineEnd::kClosed)) {
    follow(1.0, &line.downstream_end);
  }
  return line;
}

std::vector<FlowLine> WithoutEmpty(std::vector<FlowLine> lines) {
  std::erase_if(lines, [](const FlowLine& line) { return line.points.size() < 2; });
  return lines;
}

LineLimits LimitsOf(const VectorField& field, const TraceOptions& options,
                    const FieldWindow& window) {
  LineLimits limits;
  limits.tolerance_cells = options.tolerance_cells;
  limits.length_m = LengthOf(field, options);
  limits.max_speed_m_s = MaxSpeed(field, window);
  limits.may_close = options.kind == LineKind::kStream;
  limits.steady = limits.may_close || field.times().size() < 2;
  limits.step_s = options.kind == LineKind::kStreak ? 0.0 : options.step_s;
  return limits;
}

Result<std::vector<FlowLine>> StreamLines(const VectorField& field, std::span<const Seed> seeds,
                                          const TraceOptions& options) {
  std::unique_ptr<LineTracer> tracer;
  if (const auto* grid = dynamic_cast<const GridField*>(&field)) {
    PLEINAIR_ASSIGN_OR_RETURN(const FieldWindow window, grid->FrozenAt(options.frozen_at_s));
    tracer = MakeTracer(*grid, window, LimitsOf(field, options, window));
  } else {
    FieldWindow window;
    window.first_s = options.frozen_at_s;
    tracer = MakeTracer(field, options.frozen_at_s, LimitsOf(field, options, window));
  }
  std::vector<FlowLine> lines(seeds.size());
  std::mutex mutex;
  ParallelFor((seeds.size() + kChunk - 1) / kChunk, options.threads, [&](std::size_t chunk) {
    const std::unique_ptr<LineTracer> own = tracer->Copy();
    LineVertices scratch;
    for (std::size_t i = chunk * kChunk; i < std::min(seeds.size(), (chunk + 1) * kChunk); ++i) {
      lines[i] = StreamLine(seeds[i], options, own.get(), &scratch);
      lines[i].seed = i;
      if (options.progress) {
        const std::lock_guard lock(mutex);
        options.progress();
      }
    }
  });
  return WithoutEmpty(std::move(lines));
}

Seconds EndOfTimes(const VectorField& field, double sign) {
  const std::span<const Seconds> times = field.times();
  if (times.size() < 2) return sign * std::numeric_limits<double>::infinity();
  return sign > 0.0 ? times.back() : times.front();
}

/// Pathlines one way. Lines that have no flow stay empty.
Result<std::vector<FlowLine>> PathLinesOneWay(const VectorField& field, std::span<const Seed> seeds,
                                              const TraceOptions& options, double sign) {
  std::vector<MovingParticle> particles(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    particles[i].seed = seeds[i];
    const Seconds stop_s = seeds[i].time + sign * options.duration_s;
    const Seconds end_s = EndOfTimes(field, sign);
    particles[i].stop_s = sign > 0.0 ? std::min(stop_s, end_s) : std::max(stop_s, end_s);
    particles[i].keeps_vertices = true;
  }
  PLEINAIR_RETURN_IF_ERROR(MoveParticles(
      field, sign, options.threads,
      [&](const FieldWindow& window) { return LimitsOf(field, options, window); }, &particles));
  std::vector<FlowLine> lines(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    lines[i].seed = i;
    lines[i].field_reads = particles[i].line.field_reads;
    if (!particles[i].begun) continue;
    lines[i].points = std::move(particles[i].vertices.points);
    lines[i].times_s = std::move(particles[i].vertices.times_s);
    lines[i].speeds_m_s = std::move(particles[i].vertices.speeds_m_s);
    (sign > 0.0 ? lines[i].downstream_end : lines[i].upstream_end) = particles[i].end;
    if (options.progress) options.progress();
  }
  return lines;
}

Result<std::vector<FlowLine>> PathLines(const VectorField& field, std::span<const Seed> seeds,
                                        const TraceOptions& options) {
  std::vector<FlowLine> lines;
  if (options.direction != LineDirection::kForward) {
    PLEINAIR_ASSIGN_OR_RETURN(lines, PathLinesOneWay(field, seeds, options, -1.0));
    if (options.direction == LineDirection::kBackward) return WithoutEmpty(std::move(lines));
    for (FlowLine& line : lines) Reverse(&line);
  }
  PLEINAIR_ASSIGN_OR_RETURN(std::vector<FlowLine> later, PathLinesOneWay(field, seeds, options, 1));
  if (lines.empty()) return WithoutEmpty(std::move(later));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    AppendDownstream(
        {std::move(later[i].points), std::move(later[i].times_s), std::move(later[i].speeds_m_s)},
        &lines[i]);
    lines[i].downstream_end = later[i].downstream_end;
    lines[i].field_reads += later[i].field_reads;
  }
  return WithoutEmpty(std::move(lines));
}

/// All particles of a seed have one end time; the newest is the seed itself.
Result<std::vector<FlowLine>> StreakLines(const VectorField& field, std::span<const Seed> seeds,
                                          const TraceOptions& options) {
  const Seconds last_s = EndOfTimes(field, 1.0);
  std::vector<MovingParticle> particles;
  std::vector<std::size_t> first(seeds.size() + 1, 0);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    first[i] = particles.size();
    const Seconds end_s = std::min(last_s, seeds[i].time + options.duration_s);
    if (!std::isfinite(end_s)) {
      return InputError("", "streaklines of a steady field have no end",
                        "give --duration, for example 60");
    }
    const Seconds duration_s = end_s - seeds[i].time;
    const Seconds interval_s =
        options.step_s > 0.0 ? options.step_s : duration_s / kStreakParticles;
    const auto count =
        duration_s > 0.0 ? static_cast<std::size_t>(std::floor(duration_s / interval_s + 1e-9)) + 1
                         : std::size_t{0};
    for (std::size_t n = 0; n < count; ++n) {
      MovingParticle particle;
      particle.seed = {seeds[i].point, end_s - static_cast<double>(n) * interval_s};
      particle.stop_s = end_s;
      particles.push_back(particle);
    }
  }
  first[seeds.size()] = particles.size();
  PLEINAIR_RETURN_IF_ERROR(MoveParticles(
      field, 1.0, options.threads,
      [&](const FieldWindow& window) { return LimitsOf(field, options, window); }, &particles));
  std::vector<FlowLine> lines(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    FlowLine& line = lines[i];
    line.seed = i;
    line.downstream_end = LineEnd::kDuration;
    for (std::size_t n = first[i]; n < first[i + 1]; ++n) {
      const MovingParticle& particle = particles[n];
      line.field_reads += particle.line.field_reads;
      // Older particles than one that is gone are gone, or belong to another piece.
      if (!particle.begun || particle.end != LineEnd::kDuration) {
        line.downstream_end = particle.begun ? particle.end : LineEnd::kWall;
        break;
      }
      line.points.push_back(particle.line.point);
      line.times_s.push_back(particle.seed.time);
      line.speeds_m_s.push_back(particle.speed_m_s);
    }
    if (options.progress) options.progress();
  }
  return WithoutEmpty(std::move(lines));
}

}  // namespace

double LengthOf(const VectorField& field, const TraceOptions& options) {
  return options.length_m > 0.0 ? options.length_m : kDiagonals * Diagonal(field.bounds());
}

Result<std::vector<FlowLine>> TraceLines(const VectorField& field, std::span<const Seed> seeds,
                                         const TraceOptions& options) {
  switch (options.kind) {
    case LineKind::kPath:
      return PathLines(field, seeds, options);
    case LineKind::kStreak:
      return StreakLines(field, seeds, options);
    case LineKind::kStream:
      break;
  }
  return StreamLines(field, seeds, options);
}

}  // namespace pleinair::content
