#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/error.h"
#include "content/flow/moving_particles.h"
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

/// A particle with its trail, the newest point first; fewer points while it is young. Empty: it is
/// not yet born, or has left.
struct ParticleTrail {
  std::vector<Vec3> points;
  double speed_m_s = 0.0;  ///< At the newest point.
  Seconds age_s = 0.0;
};

/// Particles as a function of time alone: the same time gives the same particles, bit by bit,
/// whatever was shown before. Particle p is born every `life_s`, at a phase of its own, each time
/// at another point of a low-discrepancy sequence (Roberts 2018: R₂ and R₃), and is integrated from
/// there. Its integration stops at fixed times after its birth, the points of its trail. States at
/// these times are kept, so that the next frame costs its own duration alone.
class Particles {
 public:
  /// `field` must outlive the particles. Error (input, without a place): options out of range.
  static Result<Particles> Create(const VectorField& field, const ParticleOptions& options);

  /// Errors (input): those of reading.
  Result<std::vector<ParticleTrail>> At(Seconds time);

 private:
  Particles(const VectorField& field, const ParticleOptions& options);
  void Bear(std::size_t number, Seconds time);

  const VectorField* field_;
  ParticleOptions options_;
  Box births_;
  Seconds interval_s_;
  std::vector<MovingParticle> moving_;     // At its last fixed time.
  std::vector<std::int64_t> generations_;  // Of each particle; that of no birth at first.
  std::vector<std::vector<Vec3>> paths_;   // At fixed times since the birth.
};

/// The birthplace of a particle: the point with that number of the sequence, in a box.
Vec3 Birthplace(const Box& box, std::uint64_t number);

}  // namespace pleinair::content
