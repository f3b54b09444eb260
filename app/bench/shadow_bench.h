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
  /// Every method gets as many texels in all as one with maps of N, N/2, N/2, N/4: one map of 5/4 N
  /// a side, or four of 5/8 N.
  bool equal_texels = false;
  std::optional<double> split_weight;  ///< λ of Eq. 11 for all methods in place of each one's own.
  std::filesystem::path recording = "recordings/courtyard_midday";
  int width = 480, height = 270;
  int rays = 256;         ///< A pixel of the truth.
  int timed_rounds = 5;   ///< Of all methods in turn; the median counts.
  int creep_frames = 11;  ///< Of the creeping camera, 0.1 px a frame.
  bool pictures = false;  ///< Keep them.
};

/// Mean standard deviation of V at a point while the camera creeps, four samples a pixel as the
/// compositor takes.
struct Shimmer {
  double of_visibility = 0.0;  ///< All points alike.
  /// Weighed by how squarely the sun falls on a point, as its light is.
  double of_light = 0.0;
};

/// What frames of a creeping camera show.
struct Creep {
  Shimmer shimmer, truth_shimmer;
  int redraws = 0;  ///< Maps redrawn in its frames after the first.
};

/// One method at one resolution in one scene.
struct ShadowBenchRow {
  std::string scene;
  shadows::ShadowMethod method = shadows::ShadowMethod::kSunDisc;
  int resolution = 0;
  std::vector<int> map_sizes;  ///< Texels a side, one a partition.
  double split_weight = 0.0;   ///< λ of Eq. 11.
  ShadowErrors errors;
  ShadowErrors solid_errors;                    ///< Without what is seen of trees' crowns.
  std::optional<ClosedFormErrors> closed_form;  ///< Where the scene has closed forms.
  double pixel_m = 0.0;                         ///< Of the picture, at the closed forms' distance.
  shadows::FrameTime time;
  double ratio_to_plain = 0.0;  ///< Processor time over the plain map's, same size; 0: unknown.
  Creep creep;
};

/// What a scene's run leaves for pictures.
struct ShadowBenchPictures {
  std::string scene;
  SurfacePicture surfaces;
  shadows::VisibilityPicture truth;
  PixelWindow window;  ///< Where most pixels are penumbra.
  struct OfMethod {
    shadows::ShadowMethod method = shadows::ShadowMethod::kSunDisc;
    shadows::VisibilityPicture visibility, partitions;
    std::vector<Image<float>> maps;  ///< Depths of each partition.
  };
  std::vector<OfMethod> methods;  ///< At the middle resolution.
  int resolution = 0;
};

struct ShadowBenchResult {
  std::string renderer;  ///< GL_RENDERER.
  std::vector<ShadowBenchRow> rows;
  std::vector<ShadowBenchPictures> pictures;  ///< One a scene.
  /// Largest difference of the traced truth from the closed form (pole_and_box).
  std::optional<double> truth_error;
};

/// Runs the bench; `advance` is called after every truth and every row, `on_row` with each row.
/// Errors: no OpenGL 4.5 (system), a recording that cannot be read (input).
Result<ShadowBenchResult> RunShadowBench(const ShadowBenchOptions& options,
                                         const std::function<void()>& advance,
                                         const std::function<void(const ShadowBenchRow&)>& on_row);

}  // namespace pleinair::app
