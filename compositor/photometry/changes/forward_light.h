#pragma once

#include <memory>

#include "compositor/photometry/changes/light_changes.h"
#include "compositor/photometry/changes/light_probes.h"

namespace pleinair::compositor {

/// Temporal light filter for live sessions: estimates sun and sky of each frame from this frame and
/// those before. The model is that of FitLightChanges(), but for the error κ of the modelled sun
/// over sky. This error makes a reading less certain, and is not estimated.
///
/// Cost: proportional to the frame's readings, about 1 ms for 450.
class ForwardLight {
 public:
  ForwardLight();
  ~ForwardLight();

  /// Restarts the filter and removes all probes. `next` is the light of the next frame with its
  /// uncertainty. At first, and without `next`, the next frame is the reference.
  void Start();
  void Start(const FrameLight& next);

  /// Adds the next probe, in the order of LightProbes.
  void AddProbe(const ProbeLight& light);

  /// Estimates the light of the next frame. Readings of probes that were not added yet are skipped.
  FrameLight Add(const ProbedFrame& frame);

  /// True once sun over sky has changed since Start(), by strong evidence: a sequential test of
  /// steady against changing light (A. Wald: Sequential tests of statistical hypotheses, 1945).
  bool changes() const;

 private:
  std::unique_ptr<class ForwardFilter> filter_;
};

}  // namespace pleinair::compositor
