#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/sky/sky_moments.h"
#include "base/utc_time.h"
#include "sky/clouds/cloud_shadow.h"
#include "sky/sky_model.h"

namespace pleinair::app {

/// Skies of one source, with layers of clouds that move with the wind. Without layers: the skies of
/// the source.
class LayeredSky {
 public:
  /// `seconds`: age of the layers at `start`, or at a sun that was given without a time.
  LayeredSky(std::shared_ptr<const sky::SkySource> source,
             const std::vector<clouds::CloudLayer>& layers, double ground_albedo, double seconds,
             std::optional<UtcTime> start);

  std::unique_ptr<sky::SkyModel> At(const SkyMoment& moment) const;

  /// The sky without clouds.
  std::unique_ptr<sky::SkyModel> ClearAt(const SkyMoment& moment) const;

  const clouds::CloudFields& fields() const { return fields_; }
  /// Age of the layers.
  double SecondsAt(const SkyMoment& moment) const;

  /// Members of a JSON object about the layers, each with a comma before it; empty without layers.
  /// `sky` is that of the moment.
  std::string Json(const sky::SkyModel& sky, const SkyMoment& moment) const;

 private:
  std::shared_ptr<const sky::SkySource> source_;
  clouds::CloudFields fields_;
  double ground_albedo_, seconds_;
  std::optional<UtcTime> start_;
};

}  // namespace pleinair::app
