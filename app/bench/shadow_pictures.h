#pragma once

#include <filesystem>

#include "app/bench/shadow_bench.h"
#include "base/error.h"

namespace pleinair::app {

/// Writes into a folder that exists, for each scene:
/// `SCENE.jpg`, the view with the truth's shadows; `SCENE_methods.jpg`, the truth and all methods
/// side by side where most is penumbra; `SCENE_errors.jpg`, where and how much each is too light
/// (red) or too dark (blue) over the whole view; `SCENE_METHOD_partitions.jpg` for methods with
/// several partitions: where each is looked up, tinted, and its maps in the corner. Errors as
/// WriteError.
Result<void> WriteShadowPictures(const ShadowBenchResult& result,
                                 const std::filesystem::path& folder);

/// Writes `SCENE_error_over_time.svg`: error of the whole picture over processor time, a line a
/// method through its resolutions, both axes logarithmic.
Result<void> WriteShadowCharts(const ShadowBenchResult& result,
                               const std::filesystem::path& folder);

}  // namespace pleinair::app
