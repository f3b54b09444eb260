#include "content/flow/particles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "content/flow/grid_field.h"
#include "content/flow/moving_particles.h"

namespace pleinair::content {
namespace {

constexpr std::size_t kMaxParticles = 1'000'000;
constexpr int kMaxTrailPoints = 1024;
constexpr double kParticleTolerance_cells = 0.01;  // A tenth of a pixel and less.

// Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences": the roots of
// x³ = x + 1 (in the plane) and x⁴ = x + 1.
constexpr double kPlastic = 1.32471795724474602596;
constexpr double kPlastic3 = 1.22074408460575947536;
constexpr double kGolden = 0.61803398874989484820;

double Fraction(double x) { return x - std::floor(x); }

/// A multiple of an irrational number, without the loss of digits of large products.
double Weyl(std::uint64_t number, double step) {
  const auto bits = static_cast<std::uint64_t>(step * 18446744073709551616.0);
  return static_cast<double>(number * bits >> 11U) * 0x1p-53;
}

}  // namespace

Vec3 Birthplace(const Box& box, std::uint64_t number) {
  const Vec3 size = box.max - box.min;
  std::uint64_t n = number + 1;
  double a = 1.0 / kPlastic, b = a / kPlastic, c = 0.0;
  if (size.x > 0.0 && size.y > 0.0 && size.z > 0.0) {
    a = 1.0 / kPlastic3;
    b = a / kPlastic3;
    c = b / kPlastic3;
  }
  const double first = Weyl(n, a), second = Weyl(n, b), third = c > 0.0 ? Weyl(n, c) : 0.0;
  // In a plane along z, its second axis is the one that has an extent.
  return {box.min.x + size.x * first, box.min.y + size.y * second,
          box.min.z + size.z * (c > 0.0 ? third : (size.y > 0.0 ? first : second))};
}

Result<std::vector<ParticleTrail>> ParticlesAt(const VectorField& field, Seconds time,
                                               const ParticleOptions& options) {
  if (options.count > kMaxParticles || !(options.life_s > 0.0) || !(options.trail_s >= 0.0) ||
      options.trail_points < 2 || options.trail_points > kMaxTrailPoints) {
    return InputError("", "the options of particles are out of range",
                      "give at most 1,000,000 particles, a positive life and 2 to 1024 points");
  }
  Box box = field.bounds();
  const auto* grid = dynamic_cast<const GridField*>(&field);
  if (grid != nullptr && grid->axes().size() == 2 && !grid->grid().cells.empty()) {
    box.max.z = box.min.z;
  }
  std::vector<MovingParticle> moving(options.count);
  std::vector<Seconds> ages(options.count);
  for (std::size_t p = 0; p < options.count; ++p) {
    // Births are spread over the life, so that as many die as are born at any time.
    const double phase = Fraction(static_cast<double>(p) * kGolden);
    const double lives = time / options.life_s + phase;
    const auto generation = static_cast<std::int64_t>(std::floor(lives));
    ages[p] = (lives - static_cast<double>(generation)) * options.life_s;
    const std::uint64_t number =
        static_cast<std::uint64_t>(generation) * options.count + static_cast<std::uint64_t>(p);
    moving[p].seed = {Birthplace(box, number), time - ages[p]};
    moving[p].stop_s = time;
    moving[p].keeps_vertices = true;
  }
  const double interval_s = options.trail_s / (options.trail_points - 1);
  PLEINAIR_RETURN_IF_ERROR(MoveParticles(
      field, 1.0, options.threads,
      [](const FieldWindow&) {
        LineLimits limits;
        limits.tolerance_cells = kParticleTolerance_cells;
        limits.length_m = 1e30;
        limits.max_speed_m_s = 0.0;
        limits.steady = false;
        return limits;
      },
      &moving));
  std::vector<ParticleTrail> trails(options.count);
  for (std::size_t p = 0; p < options.count; ++p) {
    const LineVertices& path = moving[p].vertices;
    if (!moving[p].begun || moving[p].end != LineEnd::kDuration) continue;
    ParticleTrail& trail = trails[p];
    trail.age_s = ages[p];
    trail.speed_m_s = moving[p].speed_m_s;
    // Points at equal times back from now, between the steps of the path.
    std::size_t n = path.points.size() - 1;
    for (int i = 0; i < options.trail_points; ++i) {
      const Seconds at = std::max(time - i * interval_s, path.times_s.front());
      while (n > 0 && path.times_s[n - 1] > at) --n;
      const std::size_t before = n > 0 ? n - 1 : 0;
      const double span = path.times_s[n] - path.times_s[before];
      const double share =
          span > 0.0 ? std::clamp((at - path.times_s[before]) / span, 0.0, 1.0) : 1.0;
      trail.points.push_back(path.points[before] + (path.points[n] - path.points[before]) * share);
      if (at <= path.times_s.front() || interval_s == 0.0) break;
    }
  }
  return trails;
}

}  // namespace pleinair::content
