#pragma once

#include <memory>

#include "compositor/light/daylight/daylight_coefficients.h"
#include "compositor/light/light_solver.h"

namespace pleinair::compositor {

/// Daylight coefficients with the solver of their scene.
struct SolvedCoefficients {
  std::shared_ptr<const LightSolver> solver;
  std::shared_ptr<const DaylightCoefficients> coefficients;
};

/// Recomputes daylight coefficients on a background thread after a scene has changed. Nobody waits
/// for it: the last result is used until the next one is complete.
///
/// A newer request aborts the current computation, but at most twice in a row. During continuous
/// motion, the light then lags instead of never updating. All functions are thread-safe.
class CoefficientWorker {
 public:
  CoefficientWorker();
  /// Aborts the current computation.
  ~CoefficientWorker();
  CoefficientWorker(const CoefficientWorker&) = delete;
  CoefficientWorker& operator=(const CoefficientWorker&) = delete;

  /// Requests the coefficients of a scene. It replaces a request whose computation has not started.
  /// `up`: unit, marker coordinates. `options.stop` is ignored. `progress` is called on the
  /// worker's thread.
  void Want(std::shared_ptr<const LightSolver> solver, Vec3 up, const CoefficientOptions& options,
            CoefficientProgress progress = {});

  /// The last complete result; null before the first. Never waits.
  std::shared_ptr<const SolvedCoefficients> Newest() const;

  /// Progress of the current computation, 0…1; 1 if no request is open.
  double progress() const;

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace pleinair::compositor
