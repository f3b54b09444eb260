#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/error.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// Particles that drift with a flow.
struct ParticleOptions {
  std::size_t count = 2000;
  Seconds life_s = 10.0;  ///< From a birth to the next one of the same particle.
  Seconds trail_s = 1.5;  ///< What a trail shows.
  int trail_points = 16;  ///< At least 2.
  int threads = 0;        ///< 0: one for each processor.
};

/// A particle with its trail, the newest point first. Empty: it is not yet born, or has left.
struct ParticleTrail {
  std::vector<Vec3> points;
  double speed_m_s = 0.0;  ///< At the newest point.
  Seconds age_s = 0.0;
};

/// Where particles are at a time. Stateless: the same time gives the same particles, whatever was
/// shown before. Particle p is born every `life_s`, at a phase of its own, each time at another
/// point of a low-discrepancy sequence (Roberts 2018: R₂ and R₃), and moves from there through the
/// field. Errors (input): those of reading; options out of range.
Result<std::vector<ParticleTrail>> ParticlesAt(const VectorField& field, Seconds time,
                                               const ParticleOptions& options);

/// The birthplace of a particle: the point with that number of the sequence, in a box.
Vec3 Birthplace(const Box& box, std::uint64_t number);

}  // namespace pleinair::content
