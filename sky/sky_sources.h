#pragma once

// Internal: between the .cc files of this module; not installed.

#include <memory>

#include "sky/sky_model.h"

namespace pleinair::sky::internal {

// What SkySource::Create() chooses from; the conditions are valid, without clouds.
std::shared_ptr<const SkySource> MakePerezSource(const SkyConditions& conditions);
std::shared_ptr<const SkySource> MakeCieSource(int type, const SkyConditions& conditions);
std::shared_ptr<const SkySource> MakeAtmosphereSource(const SkyConditions& conditions);

/// `clear` behind clouds, sky/cloud_cover.h; `cover` above 0.
std::shared_ptr<const SkySource> MakeCloudySource(std::shared_ptr<const SkySource> clear,
                                                  double cover);

}  // namespace pleinair::sky::internal
