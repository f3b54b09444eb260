#pragma once

// Internal: one step of Dormand and Prince's method of order 5(4) with dense output.

#include <array>

#include "base/vector.h"

namespace pleinair::content {

/// The solution within a step, of order 4. Hairer, Nørsett, Wanner 1993: Solving Ordinary
/// Differential Equations I, II.6, as in DOPRI5:
/// y(θ) = r₀ + θ (r₁ + (1 − θ) (r₂ + θ (r₃ + (1 − θ) r₄))).
struct DenseStep {
  std::array<Vec3, 5> r;

  Vec3 At(double theta) const {
    const double rest = 1.0 - theta;
    return r[0] + (r[1] + (r[2] + (r[3] + r[4] * rest) * theta) * rest) * theta;
  }
};

/// Stages of a step. `first` is the velocity at its start, `last` that at its end, which is the
/// first of the next step.
struct DormandPrinceStep {
  Vec3 end, error;
  std::array<Vec3, 7> k;  ///< k[1] does not enter the result.

  DenseStep Dense(const Vec3& start, double h) const {
    const Vec3 difference = end - start;
    const Vec3 bend = k[0] * h - difference;
    DenseStep dense;
    dense.r = {start, difference, bend, difference - k[6] * h - bend,
               (k[0] * (-12715105075.0 / 11282082432.0) + k[2] * (87487479700.0 / 32700410799.0) +
                k[3] * (-10690763975.0 / 1880347072.0) + k[4] * (701980252875.0 / 199316789632.0) +
                k[5] * (-1453857185.0 / 822651844.0) + k[6] * (69997945.0 / 29380423.0)) *
                   h};
    return dense;
  }
};

/// Steps from `start` with the velocity k[0] over `h`, which may be negative. `velocity` is called
/// as velocity(point, share of h, &result) and returns false where there is none; then the step
/// fails. Coefficients: Dormand, Prince 1980.
template <typename VelocityAt>
bool TakeStep(const Vec3& start, double h, const VelocityAt& velocity, DormandPrinceStep* step) {
  std::array<Vec3, 7>& k = step->k;
  if (!velocity(start + k[0] * (h * 0.2), 0.2, &k[1])) return false;
  if (!velocity(start + (k[0] * (3.0 / 40.0) + k[1] * (9.0 / 40.0)) * h, 0.3, &k[2])) return false;
  if (!velocity(start + (k[0] * (44.0 / 45.0) + k[1] * (-56.0 / 15.0) + k[2] * (32.0 / 9.0)) * h,
                0.8, &k[3])) {
    return false;
  }
  if (!velocity(start + (k[0] * (19372.0 / 6561.0) + k[1] * (-25360.0 / 2187.0) +
                         k[2] * (64448.0 / 6561.0) + k[3] * (-212.0 / 729.0)) *
                            h,
                8.0 / 9.0, &k[4])) {
    return false;
  }
  if (!velocity(
          start + (k[0] * (9017.0 / 3168.0) + k[1] * (-355.0 / 33.0) + k[2] * (46732.0 / 5247.0) +
                   k[3] * (49.0 / 176.0) + k[4] * (-5103.0 / 18656.0)) *
                      h,
          1.0, &k[5])) {
    return false;
  }
  step->end = start + (k[0] * (35.0 / 384.0) + k[2] * (500.0 / 1113.0) + k[3] * (125.0 / 192.0) +
                       k[4] * (-2187.0 / 6784.0) + k[5] * (11.0 / 84.0)) *
                          h;
  if (!velocity(step->end, 1.0, &k[6])) return false;
  step->error = (k[0] * (71.0 / 57600.0) + k[2] * (-71.0 / 16695.0) + k[3] * (71.0 / 1920.0) +
                 k[4] * (-17253.0 / 339200.0) + k[5] * (22.0 / 525.0) + k[6] * (-1.0 / 40.0)) *
                h;
  return true;
}

}  // namespace pleinair::content
