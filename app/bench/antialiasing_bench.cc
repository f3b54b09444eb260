#include "app/bench/antialiasing_bench.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <memory>
#include <utility>

#include "app/bench/antialiasing_scenes.h"
#include "app/bench/bench_composer.h"
#include "base/quantile.h"
#include "compositor/composer.h"

namespace pleinair::app {
namespace {

using compositor::AntialiasingMethod;
using compositor::Composer;

constexpr std::array<AntialiasingBenchMethod, 5> kMethods{{
    {"none", {AntialiasingMethod::kNone}},
    {"msaa", {AntialiasingMethod::kMultisample}},
    {"subpixel", {AntialiasingMethod::kSubpixel}},
    {"ssaa16", {AntialiasingMethod::kReference, 16}},
    {"reference", {AntialiasingMethod::kReference, 64}},
}};
constexpr compositor::Antialiasing kTruth = kMethods.back().antialiasing;

/// One scene with its truth.
class AntialiasingRun {
 public:
  static Result<AntialiasingRun> Create(const std::string& scene,
                                        const AntialiasingBenchOptions& options) {
    AntialiasingRun run(scene, options);
    const std::vector<compositor::PlacedModel> objects = CoverageModels(run.scene_);
    PLEINAIR_ASSIGN_OR_RETURN(const auto coverage, MakeBenchComposer(run.camera_, objects, kTruth));
    RgbImage black(run.camera_.width, run.camera_.height, 3);
    std::fill_n(black.data(), black.size(), std::uint8_t{0});
    PLEINAIR_ASSIGN_OR_RETURN(
        const RgbImage covered,
        coverage->Compose(black.view(), run.scene_.camera_from_marker, BenchExposure()));
    PLEINAIR_ASSIGN_OR_RETURN(const auto truth,
                              MakeBenchComposer(run.camera_, run.scene_.models, kTruth));
    PLEINAIR_ASSIGN_OR_RETURN(run.truth_, run.Creep(*truth));
    run.classes_ = ClassifyPixels(run.truth_.front(), covered);
    return run;
  }

  Result<AntialiasingBenchRow> Measure(const AntialiasingBenchMethod& method) {
    PLEINAIR_ASSIGN_OR_RETURN(auto composer,
                              MakeBenchComposer(camera_, scene_.models, method.antialiasing));
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<RgbImage> frames, Creep(*composer));
    composers_.push_back(std::move(composer));
    AntialiasingBenchRow row;
    row.scene = scene_.name;
    row.method = method.name;
    row.errors = CompareToTruth(frames.front(), truth_.front(), classes_);
    row.shimmer = ShimmerOf(frames, classes_);
    row.truth_shimmer = ShimmerOf(truth_, classes_);
    return row;
  }

  /// Times the measured methods in turn, so that other load on the machine affects all equally.
  Result<void> Time(std::span<AntialiasingBenchRow> rows) {
    std::vector<std::array<std::vector<double>, 2>> times(rows.size());
    for (int round = 0; round < options_.rounds; ++round) {
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::clock_t cpu_start = std::clock();
        const auto start = std::chrono::steady_clock::now();
        PLEINAIR_RETURN_IF_ERROR(
            composers_[i]->Compose(background_.view(), scene_.camera_from_marker, BenchExposure()));
        const std::chrono::duration<double, std::milli> wall =
            std::chrono::steady_clock::now() - start;
        times[i][0].push_back(wall.count());
        times[i][1].push_back(1e3 * static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC);
      }
    }
    double none_ms = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].ms = Median(times[i][0]);
      rows[i].cpu_ms = Median(times[i][1]);
      if (rows[i].method == "none") none_ms = rows[i].cpu_ms;
    }
    for (AntialiasingBenchRow& row : rows) {
      if (none_ms > 0.0) row.ratio_to_none = row.cpu_ms / none_ms;
    }
    return {};
  }

 private:
  AntialiasingRun(const std::string& scene, const AntialiasingBenchOptions& options)
      : options_(options) {
    camera_ = BenchCamera(options.width, options.height);
    scene_ = MakeAntialiasingScene(scene, camera_);
    background_ = RgbImage(camera_.width, camera_.height, 3);
    std::fill_n(background_.data(), background_.size(), scene_.background);
  }

  /// Images of a camera that moves sideways by 0.1 px a frame.
  Result<std::vector<RgbImage>> Creep(Composer& composer) const {
    std::vector<RgbImage> frames;
    for (int frame = 0; frame < options_.creep_frames; ++frame) {
      Transform<Camera, Marker> moved = scene_.camera_from_marker;
      moved.translation_m.x -= frame * scene_.creep_m;
      PLEINAIR_ASSIGN_OR_RETURN(RgbImage image,
                                composer.Compose(background_.view(), moved, BenchExposure()));
      frames.push_back(std::move(image));
    }
    return frames;
  }

  AntialiasingBenchOptions options_;
  CameraModel camera_;
  AntialiasingScene scene_;
  RgbImage background_;
  std::vector<RgbImage> truth_;  // One a frame.
  Image<unsigned char> classes_;
  std::vector<std::unique_ptr<Composer>> composers_;  // One a measured method.
};

template <typename Names>
std::vector<std::string> AllIfNone(const std::vector<std::string>& chosen, const Names& names) {
  if (!chosen.empty()) return chosen;
  return std::vector<std::string>(names.begin(), names.end());
}

}  // namespace

std::span<const AntialiasingBenchMethod> AntialiasingBenchMethods() { return kMethods; }

Result<void> RunAntialiasingBench(const AntialiasingBenchOptions& options,
                                  const std::function<void()>& advance,
                                  const std::function<void(const AntialiasingBenchRow&)>& on_row) {
  for (const std::string& scene : AllIfNone(options.scenes, AntialiasingSceneNames())) {
    PLEINAIR_ASSIGN_OR_RETURN(AntialiasingRun run, AntialiasingRun::Create(scene, options));
    advance();
    std::vector<AntialiasingBenchRow> rows;
    for (const AntialiasingBenchMethod& method : kMethods) {
      const bool is_chosen = std::find(options.methods.begin(), options.methods.end(),
                                       method.name) != options.methods.end();
      if (!options.methods.empty() && !is_chosen) continue;
      PLEINAIR_ASSIGN_OR_RETURN(AntialiasingBenchRow row, run.Measure(method));
      rows.push_back(std::move(row));
      advance();
    }
    PLEINAIR_RETURN_IF_ERROR(run.Time(rows));
    for (const AntialiasingBenchRow& row : rows) on_row(row);
  }
  return {};
}

}  // namespace pleinair::app
