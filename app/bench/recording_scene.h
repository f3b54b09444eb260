#pragma once

#include <filesystem>

#include "base/error.h"
#include "shadows/bench/bench_scene.h"

namespace pleinair::app {

/// Phantoms and virtual objects of a recording, with the sun of its first frame. The view is from 3
/// m south-west of the objects, at a standing person's eye height.
Result<shadows::BenchScene> RecordingScene(const std::filesystem::path& recording, double aspect);

}  // namespace pleinair::app
