#include "content/flow/particles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "content/flow/grid_field.h"
#include "content/flow/moving_particles.h"

namespace pleinair::content {
namespace {

constexpr std::size_t kMaxParticles = 1'000'000;
constexpr int kMaxTrailPoints = 1024;
constexpr double kMaxTrails = 1e4;                 // Of a life.
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

Particles::Particles(const VectorField& field, const ParticleOptions& options)
    : field_(&field),
      options_(options),
      births_(field.bounds()),
      interval_s_(options.trail_s / (options.trail_points - 1)),
      moving_(options.count),
      generations_(options.count, std::numeric_limits<std::int64_t>::min()),
      paths_(options.count) {
  const auto* grid = dynamic_cast<const GridField*>(&field);
  if (grid != nullptr && grid->axes().size() == 2 && !grid->grid().cells.empty()) {
    births_.max.z = births_.min.z;
  }
}

Result<Particles> Particles::Create(const VectorField& field, const ParticleOptions& options) {
  if (options.count > kMaxParticles || !(options.life_s > 0.0) || !(options.trail_s > 0.0) ||
      options.trail_points < 2 || options.trail_points > kMaxTrailPoints ||
      options.life_s / options.trail_s > kMaxTrails) {
    return InputError("", "the options of particles are out of range",
                      "give at most 1,000,000 particles, positive times and 2 to 1024 points");
  }
  return Particles(field, options);
}

/// The state of a particle at its last birth, unless it lives since then and is not yet older.
void Particles::Bear(std::size_t number, Seconds time) {
  // Births are spread over the life, so that as many die as are born at any time.
  const double phase = Fraction(static_cast<double>(number) * kGolden);
  const auto generation = static_cast<std::int64_t>(std::floor(time / options_.life_s + phase));
  MovingParticle& particle = moving_[number];
  if (generation == generations_[number] && particle.stop_s <= time) return;
  generations_[number] = generation;
  const std::uint64_t birth =
      static_cast<std::uint64_t>(generation) * options_.count + static_cast<std::uint64_t>(number);
  const Seconds born_s = (static_cast<double>(generation) - phase) * options_.life_s;
  particle = {};
  particle.seed = {Birthplace(births_, birth), born_s};
  particle.stop_s = born_s;
  paths_[number] = {particle.seed.point};
}

Result<std::vector<ParticleTrail>> Particles::At(Seconds time) {
  for (std::size_t p = 0; p < moving_.size(); ++p) Bear(p, time);
  const auto limits = [](const FieldWindow&) {
    LineLimits all;
    all.tolerance_cells = kParticleTolerance_cells;
    all.length_m = std::numeric_limits<double>::max();
    all.steady = false;
    return all;
  };
  // One interval a round, for all that are not there yet.
  for (;;) {
    std::vector<std::size_t> numbers;
    std::vector<MovingParticle> round;
    for (std::size_t p = 0; p < moving_.size(); ++p) {
      const Seconds next_s =
          moving_[p].seed.time + static_cast<double>(paths_[p].size()) * interval_s_;
      if (next_s > time || moving_[p].end != LineEnd::kDuration) continue;
      numbers.push_back(p);
      round.push_back(moving_[p]);
      round.back().stop_s = next_s;
    }
    if (numbers.empty()) break;
    PLEINAIR_RETURN_IF_ERROR(MoveParticles(*field_, 1.0, options_.threads, limits, &round));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      // Without flow at its birth it has left.
      if (!round[i].begun) round[i].end = LineEnd::kWall;
      moving_[numbers[i]] = round[i];
      paths_[numbers[i]].push_back(round[i].line.point);
    }
  }
  std::vector<MovingParticle> heads = moving_;
  for (MovingParticle& head : heads) head.stop_s = time;
  PLEINAIR_RETURN_IF_ERROR(MoveParticles(*field_, 1.0, options_.threads, limits, &heads));
  std::vector<ParticleTrail> trails(moving_.size());
  for (std::size_t p = 0; p < moving_.size(); ++p) {
    const bool lives = moving_[p].end == LineEnd::kDuration && heads[p].end == LineEnd::kDuration &&
                       heads[p].begun;
    if (!lives) continue;
    ParticleTrail& trail = trails[p];
    trail.age_s = time - moving_[p].seed.time;
    trail.speed_m_s = heads[p].speed_m_s;
    trail.points.push_back(heads[p].line.point);
    const auto most = static_cast<std::size_t>(options_.trail_points) - 1;
    const std::size_t count = std::min(paths_[p].size(), most);
    trail.points.insert(trail.points.end(), paths_[p].rbegin(),
                        paths_[p].rbegin() + static_cast<std::ptrdiff_t>(count));
  }
  return trails;
}

}  // namespace pleinair::content
