#pragma once

#include <memory>

#include "compositor/light/daylight/daylight_coefficients.h"
#include "compositor/light/light_solver.h"

namespace pleinair::compositor {

/// Daylight coefficients that belong to a scene as a solver knows it.
struct SolvedCoefficients {
  std::shared_ptr<const LightSolver> solver;
  std::shared_ptr<const DaylightCoefficients> coefficients;
};

/// Recomputes daylight coefficients on a thread of its own when something of a scene has moved.
/// Nobody waits for it: what was there last stays in use until the next is whole.
///
/// A newer wish ends the computation in hand, but not more than twice in a row: in a motion without
/// a rest the light then follows some way behind instead of never. All functions from any thread.
class CoefficientWorker {
 public:
  CoefficientWorker();
  /// Ends what is being computed.
  ~CoefficientWorker();
  CoefficientWorker(const CoefficientWorker&) = delete;
  CoefficientWorker& operator=(const CoefficientWorker&) = delete;

  /// Wants the coefficients of a scene; of several that were not begun yet the last counts. `up`:
  /// unit, marker coordinates. `options.stop` is not looked at. `progress` is called on the
  /// worker's thread.
  void Want(std::shared_ptr<const LightSolver> solver, Vec3 up, const CoefficientOptions& options,
            CoefficientProgress progress = {});

  /// The last ones that were completed; null before the first. Never waits for any.
  std::shared_ptr<const SolvedCoefficients> Newest() const;

  /// Share of the present computation, 0…1; 1 where all that was wanted is there.
  double progress() const;

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace pleinair::compositor
