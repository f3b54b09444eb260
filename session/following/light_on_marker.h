#pragma once

#include "base/vector.h"
#include "compositor/photometry/changes/light_changes.h"
#include "compositor/photometry/changes/light_probes.h"

namespace pleinair::session {

/// Light of the sun and of the sky on the marker: sums over its probes, lux.
class LightOnMarker {
 public:
  /// Adds a probe. Those of other surfaces do not count.
  void Add(const compositor::LightProbe& probe, const compositor::ProbeLight& light) {
    if (probe.surface != compositor::kMarkerWhite && probe.surface != compositor::kMarkerBlack) {
      return;
    }
    sun_ = sun_ + light.direct * light.sun_visibility + light.reflected;
    sky_ = sky_ + light.sky;
  }

  /// Light on the marker in a frame with these factors on sun and sky, over that without them. 1 if
  /// no probe lies on the marker.
  LinearRgb Factor(LinearRgb sun, LinearRgb sky) const {
    const LinearRgb none{1e-9, 1e-9, 1e-9};
    return (sun_ * sun + sky_ * sky + none) / (sun_ + sky_ + none);
  }

 private:
  LinearRgb sun_, sky_;
};

}  // namespace pleinair::session
