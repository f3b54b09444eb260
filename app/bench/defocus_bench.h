#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/bench/picture_bench.h"
#include "base/error.h"
#include "base/image.h"

namespace pleinair::app {

/// Results of one method in one scene.
struct DefocusBenchRow {
  std::string scene, method;
  double rmse = 0.0;              ///< Linear light, where 1 is display white, over the image.
  double edge_rmse = 0.0;         ///< Within a circle of confusion and a streak of a silhouette.
  double halo = 0.0;              ///< The largest error there.
  double ms = 0.0;                ///< Time to draw one image.
  double cpu_ms = 0.0;            ///< Processor time of all threads.
  double ratio_to_pinhole = 0.0;  ///< Processor time over that of an image without a lens.
  int layers = 0, peels = 0;      ///< 0: not by layers.
  int views = 0;                  ///< That were averaged over the exposure; 0: none.
};

/// The methods that are compared where none is chosen: layered, gaussian, gather and lens:32.
std::vector<std::string> DefaultDefocusMethods();
/// The same for scenes whose camera moves: moved, poses:8, layered-each:16 and pinhole.
std::vector<std::string> DefaultMotionMethods();

/// Checks the name of a method. Known are:
/// - layered: as replay;
/// - gaussian, gaussian-each: the paper's layers, in cascade and each for itself;
/// - gather: by one depth a pixel;
/// - lens:N: through N places, 1…1024;
/// - pinhole: without a lens, and at rest;
/// - moved: the camera's motion as replay;
/// - poses:N: N of its poses, 2…1024, each through its own place on the stop;
/// - layered-each:N: the mean of N images by layers, each from its pose.
///
/// Error (input): another name.
Result<void> CheckDefocusMethod(const std::string& method);

/// What receives the results.
struct DefocusBenchSink {
  std::function<void()> advance;  ///< Once a scene for its truth, and after every row.
  std::function<void(const DefocusBenchRow&)> on_row;
  /// The truth of a scene and the image of each method, from left to right. May be empty.
  std::function<Result<void>(const std::string& scene, const RgbImage& sheet)> on_sheet;
};

/// Compares methods of depth of field with TraceBoards(), and of motion blur with
/// TraceMovingCamera(). `bench`: scenes of one of the two, and
/// methods as CheckDefocusMethod() knows them; those of motion need its scenes. Errors: no
/// OpenGL 4.5 (system), those of the sink.
Result<void> RunDefocusBench(const PictureBench& bench, const DefocusBenchSink& sink);

}  // namespace pleinair::app
