#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/bench/antialiasing_errors.h"
#include "app/bench/picture_bench.h"
#include "base/error.h"
#include "compositor/antialiasing.h"

namespace pleinair::app {

/// A method by its name in options and tables.
struct AntialiasingBenchMethod {
  std::string_view name;
  compositor::Antialiasing antialiasing;
};

/// none, msaa, subpixel, ssaa16 (16 shaded places a pixel) and reference (64).
std::span<const AntialiasingBenchMethod> AntialiasingBenchMethods();

/// What a run of the benchmark compares, and how long.
struct AntialiasingBenchOptions : PictureBench {
  int creep_frames = 6;  ///< The camera moves by 0.1 px a frame.
};

/// Results of one method in one scene.
struct AntialiasingBenchRow {
  std::string scene, method;
  AntialiasingErrors errors;
  double shimmer = 0.0, truth_shimmer = 0.0;
  double ms = 0.0;             ///< Time to compose one image.
  double cpu_ms = 0.0;         ///< Processor time of all threads.
  double ratio_to_none = 0.0;  ///< Processor time over that of `none`; 0 if that is not measured.
};

/// Compares methods of antialiasing with `reference`. Calls `advance` once a scene for its truth
/// and after every row, and `on_row` with each row. Errors: no OpenGL 4.5 (system).
Result<void> RunAntialiasingBench(const AntialiasingBenchOptions& options,
                                  const std::function<void()>& advance,
                                  const std::function<void(const AntialiasingBenchRow&)>& on_row);

}  // namespace pleinair::app
