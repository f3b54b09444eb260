#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <memory>

#include "sky/sky_model.h"

namespace pleinair::sky::internal {

// Sources for SkySource::Create(). The conditions are valid and without clouds.
std::shared_ptr<const SkySource> MakePerezSource(const SkyConditions& conditions);
std::shared_ptr<const SkySource> MakeCieSource(int type, const SkyConditions& conditions);
std::shared_ptr<const SkySource> MakeAtmosphereSource(const SkyConditions& conditions);

/// `clear` with clouds in front of it (sky/cloud_cover.h); `cover` is above 0.
std::shared_ptr<const SkySource> MakeCloudySource(std::shared_ptr<const SkySource> clear,
                                                  double cover);

}  // namespace pleinair::sky::internal
