#pragma once

#include <filesystem>

#include "base/error.h"
#include "shadows/bench/bench_scene.h"

namespace pleinair::app {

/// The phantoms and virtual objects of a recording, under the sun of its first frame, seen from
/// three metres in the south-west of the objects at a standing person's height.
Result<shadows::BenchScene> RecordingScene(const std::filesystem::path& recording, double aspect);

}  // namespace pleinair::app
