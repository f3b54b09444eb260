#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/bench/shadow_metrics.h"
#include "app/bench/shadow_truth.h"
#include "base/error.h"
#include "shadows/bench/bench_renderer.h"
#include "shadows/shadow_method.h"

namespace pleinair::app {

struct ShadowBenchOptions {
  std::vector<std::string> scenes{"pole_and_box", "courtyard", "trees", "wide_field"};
  std::vector<shadows::ShadowMethod> methods;  ///< Empty: all.
  std::vector<int> resolutions{512, 1024, 2048};
  /// If true, every method gets as many texels in total as one with maps of N, N/2, N/2, N/4. This
  /// is one map of 5/4 N a side, or four of 5/8 N.
  bool equal_texels = false;
  std::optional<double> split_weight;  ///< λ of Eq. 11 for all methods; else each uses its own.
  std::filesystem::path recording = "recordings/courtyard_midday";
  int width = 480, height = 270;
  int rays = 256;         ///< Per pixel of the ground truth.
  int timed_rounds = 5;   ///< All methods in turn; the median counts.
  int creep_frames = 11;  ///< Camera moves by 0.1 px a frame.
  bool pictures = false;  ///< Keep the images.
};

/// Mean standard deviation of V at a point during slow camera motion, with four samples a pixel as
/// in the compositor.
struct Shimmer {
  double of_visibility = 0.0;  ///< All points with equal weight.
  /// Weighted by the cosine of the sun's incidence, like the light.
  double of_light = 0.0;
};

/// Results of the frames with slow camera motion.
struct Creep {
  Shimmer shimmer, truth_shimmer;
  int redraws = 0;  ///< Maps redrawn after the first frame.
};

/// Results of one method at one resolution in one scene.
struct ShadowBenchRow {
  std::string scene;
  shadows::ShadowMethod method = shadows::ShadowMethod::kSunDisc;
  int resolution = 0;
  std::vector<int> map_sizes;  ///< Texels a side, one per partition.
  double split_weight = 0.0;   ///< λ of Eq. 11.
  ShadowErrors errors;
  ShadowErrors solid_errors;                    ///< Without the visible tree crowns.
  std::optional<ClosedFormErrors> closed_form;  ///< If the scene has closed forms.
  double pixel_m = 0.0;                         ///< Size of a pixel at the closed forms' distance.
  shadows::FrameTime time;
  double ratio_to_plain = 0.0;  ///< Processor time over that of a plain map, same size; 0: unknown.
  Creep creep;
};

/// Images of one scene's run.
struct ShadowBenchPictures {
  std::string scene;
  SurfacePicture surfaces;
  shadows::VisibilityPicture truth;
  PixelWindow window;  ///< Where most pixels are penumbra.
  struct OfMethod {
    shadows::ShadowMethod method = shadows::ShadowMethod::kSunDisc;
    shadows::VisibilityPicture visibility, partitions;
    std::vector<Image<float>> maps;  ///< Depth maps, one per partition.
  };
  std::vector<OfMethod> methods;  ///< At the middle resolution.
  int resolution = 0;
};

struct ShadowBenchResult {
  std::string renderer;  ///< GL_RENDERER.
  std::vector<ShadowBenchRow> rows;
  std::vector<ShadowBenchPictures> pictures;  ///< One per scene.
  /// Max. difference between the ray-traced ground truth and the closed form (pole_and_box).
  std::optional<double> truth_error;
};

/// Runs the benchmark. Calls `advance` after every ground truth and every row, and `on_row` with
/// each row. Errors: no OpenGL 4.5 (system), a recording that cannot be read (input).
Result<ShadowBenchResult> RunShadowBench(const ShadowBenchOptions& options,
                                         const std::function<void()>& advance,
                                         const std::function<void(const ShadowBenchRow&)>& on_row);

}  // namespace pleinair::app
