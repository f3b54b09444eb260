#include "app/bench/shadow_bench.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "app/bench/recording_scene.h"
#include "app/bench/shadow_truth.h"
#include "base/quantile.h"
#include "gl/egl_context.h"

namespace pleinair::app {
namespace {

using shadows::BenchRenderer;
using shadows::BenchScene;
using shadows::View;
using shadows::VisibilityPicture;

constexpr double kCreepPxAFrame = 0.1;
// Samples per pixel, as in the compositor.
constexpr int kCreepSamples = 4;
constexpr int kFramesARound = 2;

Result<BenchScene> MakeScene(const std::string& name, const ShadowBenchOptions& options) {
  const double aspect = static_cast<double>(options.width) / options.height;
  if (name == "pole_and_box") return shadows::PoleAndBoxScene(aspect);
  if (name == "trees") return shadows::TreesScene(aspect);
  if (name == "wide_field") return shadows::WideFieldScene(aspect);
  if (name == "courtyard") return RecordingScene(options.recording, aspect);
  return InputError("--scenes", "there is no scene '" + name + "'",
                    "choose among pole_and_box, courtyard, trees and wide_field");
}

shadows::ShadowMapOptions MapOptions(shadows::ShadowMethod method, int resolution,
                                     const ShadowBenchOptions& bench) {
  shadows::ShadowMapOptions options = shadows::CommonOptions(method, resolution);
  options.split_weight = bench.split_weight.value_or(options.split_weight);
  // (1 + ¼ + ¼ + 1/16) N² = (5/4 N)² = 4 (5/8 N)².
  if (bench.equal_texels && !shadows::TraitsOf(method).falling_resolution) {
    options.resolutions.fill(options.partitions == 1 ? resolution * 5 / 4 : resolution * 5 / 8);
  }
  return options;
}

// Checks the map sizes of each method before the minutes of measurement.
Result<void> CheckSizes(const std::vector<shadows::ShadowMethod>& methods,
                        const ShadowBenchOptions& bench) {
  for (const shadows::ShadowMethod method : methods) {
    for (const int resolution : bench.resolutions) {
      if (shadows::CheckShadowMapOptions(MapOptions(method, resolution, bench))) continue;
      return InputError(
          "--sizes",
          fmt::format("'{}' cannot have maps of {} texels", shadows::TraitsOf(method).name,
                      resolution),
          "choose powers of two, or with --methods those without a pyramid of depths");
    }
  }
  return {};
}

// Moves the camera sideways, so that points at `depth_m` move by `pixels` in the image.
View Crept(const View& view, double pixels, double depth_m, int width) {
  View moved = view;
  const double shift = pixels * depth_m * (view.tan_left + view.tan_right) / width;
  moved.camera_from_marker[3].x -= shift;
  return moved;
}

struct TrackedPoint {
  glm::dvec3 point{0.0};
  double cosine = 0.0;  // Cosine of the sun's incidence angle.
  double sum = 0.0, squares = 0.0;
  int count = 0;
};

// Measures the variation of sunlight on static points while the camera moves slowly.
class ShimmerMeter {
 public:
  ShimmerMeter(const View& view, const VisibilityPicture& truth, const Image<float>& cosine,
               PixelWindow window) {
    const glm::dmat4 marker_from_camera = glm::inverse(view.camera_from_marker);
    const int width = truth.depth_m.width(), height = truth.depth_m.height();
    for (int y = window.y; y < window.y + window.height; ++y) {
      for (int x = window.x; x < window.x + window.width; ++x) {
        const double depth = truth.depth_m(x, y);
        if (depth <= 0.0) continue;
        const double px = -view.tan_left + (view.tan_left + view.tan_right) * (x + 0.5) / width;
        const double py = -view.tan_up + (view.tan_up + view.tan_down) * (y + 0.5) / height;
        points_.push_back(
            {glm::dvec3(marker_from_camera * glm::dvec4(px * depth, py * depth, depth, 1.0)),
             cosine(x, y)});
      }
    }
  }

  void Add(const View& view, const VisibilityPicture& picture) {
    const int width = picture.depth_m.width(), height = picture.depth_m.height();
    for (TrackedPoint& tracked : points_) {
      const glm::dvec3 p(view.camera_from_marker * glm::dvec4(tracked.point, 1.0));
      const double x = (p.x / p.z + view.tan_left) / (view.tan_left + view.tan_right) * width - 0.5;
      const double y = (p.y / p.z + view.tan_up) / (view.tan_up + view.tan_down) * height - 0.5;
      const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
      if (x0 < 0 || y0 < 0 || x0 + 1 >= width || y0 + 1 >= height) continue;
      double value = 0.0;
      bool seen = true;
      for (int i = 0; i < 4; ++i) {
        const int cx = x0 + (i & 1), cy = y0 + (i >> 1);
        seen = seen && std::abs(picture.depth_m(cx, cy) - p.z) < 0.02 * p.z;
        value += picture.visibility(cx, cy) * ((i & 1) != 0 ? x - x0 : 1.0 - (x - x0)) *
                 ((i >> 1) != 0 ? y - y0 : 1.0 - (y - y0));
      }
      if (!seen) continue;
      tracked.sum += value;
      tracked.squares += value * value;
      ++tracked.count;
    }
  }

  /// Mean over the points visible in all frames.
  Shimmer Mean(int frames) const {
    Shimmer sum;
    double count = 0.0, weight = 0.0;
    for (const TrackedPoint& p : points_) {
      if (p.count != frames) continue;
      const double mean = p.sum / frames;
      const double deviation = std::sqrt(std::max(p.squares / frames - mean * mean, 0.0));
      sum.of_visibility += deviation;
      sum.of_light += p.cosine * deviation;
      count += 1.0;
      weight += p.cosine;
    }
    return {sum.of_visibility / std::max(count, 1.0), sum.of_light / std::max(weight, 1e-9)};
  }

 private:
  std::vector<TrackedPoint> points_;
};

// Ray-traced visibility of a scene's view, and of the window during the camera motion.
struct TracedTruth {
  ShadowTruth tracer;
  VisibilityPicture picture;
  SurfacePicture surfaces;
  Shimmer shimmer;
};

// One scene with its ground truth and the renderer shared by all methods.
class SceneRun {
 public:
  static Result<SceneRun> Create(BenchScene scene, const ShadowBenchOptions& options) {
    PLEINAIR_ASSIGN_OR_RETURN(ShadowTruth truth, ShadowTruth::Create(scene, options.rays));
    PLEINAIR_ASSIGN_OR_RETURN(
        BenchRenderer creeping,
        BenchRenderer::Create(scene, options.width, options.height, kCreepSamples));
    SceneRun run(std::move(scene), std::move(truth), std::move(creeping), options);
    PLEINAIR_RETURN_IF_ERROR(run.TraceTruth());
    return run;
  }

  /// Prepares the methods at one resolution. The functions below refer to them by index.
  Result<void> Prepare(std::span<const shadows::ShadowMethod> methods, int resolution) {
    resolution_ = resolution;
    methods_.assign(methods.begin(), methods.end());
    renderers_.clear();
    for (const shadows::ShadowMethod method : methods) {
      PLEINAIR_ASSIGN_OR_RETURN(BenchRenderer renderer,
                                BenchRenderer::Create(scene_, options_.width, options_.height));
      PLEINAIR_RETURN_IF_ERROR(renderer.SetMethod(MapOptions(method, resolution, options_)));
      renderers_.push_back(std::move(renderer));
    }
    return {};
  }

  Result<ShadowBenchRow> Measure(std::size_t index) {
    BenchRenderer& renderer = renderers_[index];
    ShadowBenchRow row;
    row.scene = scene_.name;
    row.method = methods_[index];
    row.resolution = resolution_;
    const shadows::ShadowMapOptions& maps = renderer.maps().options();
    row.map_sizes.assign(maps.resolutions.begin(), maps.resolutions.begin() + maps.partitions);
    row.split_weight = maps.split_weight;
    PLEINAIR_RETURN_IF_ERROR(creeping_.SetMethod(maps));
    PLEINAIR_ASSIGN_OR_RETURN(picture_, renderer.Draw(view_));
    row.errors = CompareVisibility(picture_, truth_.picture);
    row.solid_errors = CompareVisibility(picture_, truth_.picture, &truth_.surfaces.leaves);
    if (!scene_.edges.empty()) {
      PLEINAIR_ASSIGN_OR_RETURN(row.closed_form, MeasureClosedForms(scene_, renderer));
      const glm::dvec3 at(view_.camera_from_marker *
                          glm::dvec4(scene_.contacts.front().middle, 1.0));
      row.pixel_m = at.z * (view_.tan_left + view_.tan_right) / options_.width;
    }
    row.creep.truth_shimmer = truth_.shimmer;
    ShimmerMeter meter(view_, truth_.picture, truth_.surfaces.cosine, window_);
    for (int frame = 0; frame < options_.creep_frames; ++frame) {
      int redrawn = 0;
      const View view = CreptView(frame);
      PLEINAIR_ASSIGN_OR_RETURN(const View tight, renderer.Tightened(view));
      PLEINAIR_ASSIGN_OR_RETURN(const VisibilityPicture drawn, creeping_.Draw(tight, &redrawn));
      meter.Add(view, drawn);
      if (frame > 0) row.creep.redraws += redrawn;
    }
    row.creep.shimmer = meter.Mean(options_.creep_frames);
    return row;
  }

  /// Times the methods in turn over several rounds, so that other load on the machine affects all
  /// equally. Call it after Measure(), which compiles and warms up.
  Result<std::vector<shadows::FrameTime>> Time() {
    std::vector<std::array<std::vector<double>, 3>> times(renderers_.size());
    for (int round = 0; round < options_.timed_rounds; ++round) {
      for (std::size_t i = 0; i < renderers_.size(); ++i) {
        PLEINAIR_ASSIGN_OR_RETURN(const shadows::FrameTime time,
                                  renderers_[i].Time(view_, kFramesARound));
        times[i][0].push_back(time.maps_ms);
        times[i][1].push_back(time.scene_ms);
        times[i][2].push_back(time.cpu_ms);
      }
    }
    std::vector<shadows::FrameTime> medians;
    medians.reserve(times.size());
    for (const auto& [maps, scene, cpu] : times) {
      medians.push_back({Median(maps), Median(scene), Median(cpu)});
    }
    return medians;
  }

  /// Max. difference between the rays and the closed form over twice the penumbrae.
  std::optional<double> TruthError() const {
    if (scene_.edges.empty()) return {};
    double worst = 0.0;
    for (const shadows::StraightEdge& edge : scene_.edges) {
      const double x = edge.middle.x - edge.middle.z * scene_.to_sun.x / scene_.to_sun.z;
      for (int i = -50; i <= 50; ++i) {
        const double y =
            EdgeShadowY(edge, scene_.to_sun) + i / 25.0 * EdgeHalfWidth(edge, scene_.to_sun);
        worst = std::max(worst, std::abs(truth_.tracer.At({x, y, 0.0}, {0.0, 0.0, 1.0}) -
                                         StraightEdgeTruth(edge, scene_.to_sun, y)));
      }
    }
    return worst;
  }

  ShadowBenchPictures Pictures() const {
    return {scene_.name, truth_.surfaces, truth_.picture, window_, {}, 0};
  }

  /// Requires that the method was measured last.
  Result<ShadowBenchPictures::OfMethod> PicturesOf(std::size_t index) {
    BenchRenderer& renderer = renderers_[index];
    ShadowBenchPictures::OfMethod pictures;
    pictures.method = methods_[index];
    pictures.visibility = picture_;
    PLEINAIR_ASSIGN_OR_RETURN(pictures.partitions, renderer.DrawPartitions(view_));
    for (int i = 0; i < renderer.maps().options().partitions; ++i) {
      pictures.maps.push_back(renderer.maps().ReadDepth(i));
    }
    return pictures;
  }

 private:
  SceneRun(BenchScene scene, ShadowTruth truth, BenchRenderer creeping,
           const ShadowBenchOptions& options)
      : scene_(std::move(scene)),
        truth_{std::move(truth), {}, {}, {}},
        creeping_(std::move(creeping)),
        options_(options) {}

  View CreptView(int frame) const {
    return Crept(scene_.view, kCreepPxAFrame * frame, middle_depth_m_, options_.width);
  }

  Result<void> TraceTruth() {
    PLEINAIR_ASSIGN_OR_RETURN(view_, creeping_.Tightened(scene_.view));
    const int w = options_.width, h = options_.height;
    truth_.picture = truth_.tracer.Render(view_, w, h, {0, 0, w, h});
    truth_.surfaces = truth_.tracer.Surfaces(view_, w, h);
    window_ = MostShadedWindow();
    middle_depth_m_ =
        truth_.picture.depth_m(window_.x + window_.width / 2, window_.y + window_.height / 2);
    // A border of two pixels for the camera motion and the interpolation.
    const PixelWindow traced{std::max(window_.x - 3, 0), std::max(window_.y - 1, 0),
                             std::min(window_.width + 6, w - std::max(window_.x - 3, 0)),
                             std::min(window_.height + 2, h - std::max(window_.y - 1, 0))};
    ShimmerMeter meter(view_, truth_.picture, truth_.surfaces.cosine, window_);
    for (int frame = 0; frame < options_.creep_frames; ++frame) {
      const View view = CreptView(frame);
      meter.Add(view, truth_.tracer.Render(view, w, h, traced));
    }
    truth_.shimmer = meter.Mean(options_.creep_frames);
    return {};
  }

  // A window of a fifth of the image a side, where most pixels are penumbra.
  PixelWindow MostShadedWindow() const {
    PixelWindow best{0, 0, options_.width / 5, options_.height / 5};
    int maximum = -1;
    for (int j = 0; j < 9; ++j) {
      for (int i = 0; i < 9; ++i) {
        PixelWindow window = best;
        window.x = i * (options_.width - window.width) / 8;
        window.y = j * (options_.height - window.height) / 8;
        int count = 0;
        for (int y = window.y; y < window.y + window.height; ++y) {
          for (int x = window.x; x < window.x + window.width; ++x) {
            const float v = truth_.picture.visibility(x, y);
            if (truth_.picture.depth_m(x, y) > 0.0F && v > 0.01F && v < 0.99F) ++count;
          }
        }
        if (count > maximum) {
          maximum = count;
          best = window;
        }
      }
    }
    return best;
  }

  BenchScene scene_;
  TracedTruth truth_;
  BenchRenderer creeping_;
  std::vector<BenchRenderer> renderers_;  // One per method.
  std::vector<shadows::ShadowMethod> methods_;
  int resolution_ = 0;
  ShadowBenchOptions options_;
  View view_;
  VisibilityPicture picture_;
  PixelWindow window_;
  double middle_depth_m_ = 1.0;
};

}  // namespace

Result<ShadowBenchResult> RunShadowBench(const ShadowBenchOptions& options,
                                         const std::function<void()>& advance,
                                         const std::function<void(const ShadowBenchRow&)>& on_row) {
  std::vector<shadows::ShadowMethod> methods = options.methods;
  if (methods.empty()) {
    for (const auto& traits : shadows::ShadowMethods()) methods.push_back(traits.method);
  }
  PLEINAIR_RETURN_IF_ERROR(CheckSizes(methods, options));
  PLEINAIR_ASSIGN_OR_RETURN(const gl::EglContext context, gl::EglContext::Create());
  ShadowBenchResult result;
  result.renderer = context.info().renderer;
  const int middle = options.resolutions[options.resolutions.size() / 2];
  for (const std::string& name : options.scenes) {
    PLEINAIR_ASSIGN_OR_RETURN(BenchScene scene, MakeScene(name, options));
    PLEINAIR_ASSIGN_OR_RETURN(SceneRun run, SceneRun::Create(std::move(scene), options));
    if (const auto error = run.TruthError()) result.truth_error = error;
    advance();
    if (options.pictures) {
      result.pictures.push_back(run.Pictures());
      result.pictures.back().resolution = middle;
    }
    for (const int resolution : options.resolutions) {
      std::vector<ShadowBenchRow> rows;
      PLEINAIR_RETURN_IF_ERROR(run.Prepare(methods, resolution));
      for (std::size_t i = 0; i < methods.size(); ++i) {
        PLEINAIR_ASSIGN_OR_RETURN(ShadowBenchRow row, run.Measure(i));
        if (options.pictures && resolution == middle) {
          PLEINAIR_ASSIGN_OR_RETURN(auto pictures, run.PicturesOf(i));
          result.pictures.back().methods.push_back(std::move(pictures));
        }
        rows.push_back(std::move(row));
        advance();
      }
      PLEINAIR_ASSIGN_OR_RETURN(const auto times, run.Time());
      const auto plain = std::find(methods.begin(), methods.end(), shadows::ShadowMethod::kPlain);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].time = times[i];
        if (plain != methods.end()) {
          rows[i].ratio_to_plain = times[i].cpu_ms / times[plain - methods.begin()].cpu_ms;
        }
        on_row(rows[i]);
        result.rows.push_back(std::move(rows[i]));
      }
    }
  }
  return result;
}

}  // namespace pleinair::app
