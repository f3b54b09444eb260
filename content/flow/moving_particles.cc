#include "content/flow/moving_particles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/parallel_for.h"

namespace pleinair::content {
namespace {

constexpr std::size_t kChunk = 16;  // Particles that a thread takes at once.
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The state of a particle beyond what it itself states.
enum class Stage : char { kWaiting, kMoving, kDone };

void Move(MovingParticle* particle, Stage* stage, Seconds until_s, double sign,
          LineTracer* tracer) {
  LineVertices* const vertices = particle->keeps_vertices ? &particle->vertices : nullptr;
  if (*stage == Stage::kWaiting) {
    if (sign * (particle->seed.time - until_s) >= 0.0 && std::isfinite(until_s)) return;
    // A seed before the first time of the field starts in its first state.
    particle->begun = tracer->Begin(particle->seed, &particle->line, vertices);
    *stage = particle->begun ? Stage::kMoving : Stage::kDone;
  }
  if (*stage != Stage::kMoving) return;
  const Seconds stop_s =
      sign > 0.0 ? std::min(particle->stop_s, until_s) : std::max(particle->stop_s, until_s);
  const auto end = sign * (stop_s - particle->line.time) > 0.0
                       ? tracer->Advance(&particle->line, stop_s, nullptr, vertices)
                       : std::nullopt;
  if (end) particle->end = *end;
  if (end || stop_s == particle->stop_s) *stage = Stage::kDone;
}

}  // namespace

Result<void> MoveParticles(const VectorField& field, double sign, int threads,
                           const std::function<LineLimits(const FieldWindow&)>& limits,
                           std::vector<MovingParticle>* particles) {
  if (particles->empty()) return {};
  std::vector<Stage> stages(particles->size(), Stage::kWaiting);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const MovingParticle& particle = (*particles)[i];
    if (particle.begun) stages[i] = Stage::kMoving;
    if (particle.end != LineEnd::kDuration) stages[i] = Stage::kDone;
  }
  const auto* grid = dynamic_cast<const GridField*>(&field);
  Seconds from_s = sign * kInfinity;
  Seconds last_s = -sign * kInfinity;
  for (const MovingParticle& particle : *particles) {
    const Seconds at_s = particle.begun ? particle.line.time : particle.seed.time;
    from_s = sign > 0.0 ? std::min(from_s, at_s) : std::max(from_s, at_s);
    last_s = sign > 0.0 ? std::max(last_s, particle.stop_s) : std::min(last_s, particle.stop_s);
  }
  for (bool more = true; more;) {
    FieldWindow window;
    std::unique_ptr<LineTracer> tracer;
    Seconds until_s = sign * kInfinity;
    if (grid != nullptr) {
      PLEINAIR_ASSIGN_OR_RETURN(window, grid->WindowAt(from_s, sign < 0.0));
      tracer = MakeTracer(*grid, window, limits(window));
      if (window.second) {
        until_s = sign > 0.0 ? window.second_s : window.first_s;
      } else if (grid->times().size() > 1) {
        const Seconds border_s = sign > 0.0 ? grid->times().front() : grid->times().back();
        if (sign * (border_s - from_s) > 0.0) until_s = border_s;
      }
    } else {
      tracer = MakeTracer(field, std::nullopt, limits(window));
    }
    ParallelFor((particles->size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
      const std::unique_ptr<LineTracer> own = tracer->Copy();
      for (std::size_t i = chunk * kChunk; i < std::min(particles->size(), (chunk + 1) * kChunk);
           ++i) {
        Move(&(*particles)[i], &stages[i], until_s, sign, own.get());
      }
    });
    more = std::isfinite(until_s) && sign * (last_s - until_s) >= 0.0 &&
           std::any_of(stages.begin(), stages.end(),
                       [](Stage stage) { return stage != Stage::kDone; });
    from_s = until_s;
  }
  for (MovingParticle& particle : *particles) {
    const Vec3 stretch = field.Stretch(particle.line.point), v = particle.line.velocity;
    particle.speed_m_s = Norm(Vec3{v.x / stretch.x, v.y / stretch.y, v.z / stretch.z});
  }
  return {};
}

}  // namespace pleinair::content
