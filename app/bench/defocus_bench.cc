#include "app/bench/defocus_bench.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "app/bench/bench_composer.h"
#include "app/bench/defocus_rivals.h"
#include "app/bench/defocus_scenes.h"
#include "app/bench/traced_boards.h"
#include "app/options/defocus_options.h"
#include "base/quantile.h"
#include "base/srgb.h"
#include "compositor/composer.h"
#include "compositor/lens/exposure_views.h"
#include "files/csv.h"
#include "session/motion/frame_exposure.h"

namespace pleinair::app {
namespace {

using compositor::Composer;

constexpr std::string_view kPoses = "poses:", kEach = "layered-each:";
constexpr int kMaxViews = session::MotionBlurOptions{}.max_views;

/// The number after a method's prefix.
std::optional<int> CountAfter(std::string_view prefix, std::string_view method) {
  constexpr int kMost = 1024;
  if (!method.starts_with(prefix)) return std::nullopt;
  const std::optional<double> count = files::ParseNumber(std::string(method.substr(prefix.size())));
  if (!count || *count != std::floor(*count) || *count < 2 || *count > kMost) return std::nullopt;
  return static_cast<int>(*count);
}

bool IsOfMotion(std::string_view method) {
  return method == "moved" || CountAfter(kPoses, method) || CountAfter(kEach, method);
}

Image<float> LightOf(const RgbImage& image) {
  Image<float> light(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) light(x, y) = LinearFromSrgb8()[image(x, y, 1)];
  }
  return light;
}

/// Length of a board's streak, pixels.
double StreakOf(const DefocusScene& scene, const CameraModel& camera, const BenchBoard& board) {
  if (!scene.motion) return 0.0;
  const auto dioptres = static_cast<float>(1.0 / board.distance_m);
  const compositor::RenderCamera render{camera.width, camera.height, camera.fx,
                                        camera.fy,    camera.cx,     camera.cy};
  const compositor::PixelRect all{0, 0, camera.width, camera.height};
  return LongestStreak_px(render, scene.motion, std::span(&all, 1), {dioptres, dioptres});
}

/// Pixels within a circle of confusion, and half a streak, of a board's edge.
Image<std::uint8_t> EdgePixels(const DefocusScene& scene, const CameraModel& camera) {
  const int width = camera.width, height = camera.height;
  Image<std::uint8_t> near(width, height);
  for (const BenchBoard& board : scene.boards) {
    const double around = std::fabs(board.circle_px) + 0.5 * StreakOf(scene, camera, board) + 1.0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double u = x + 0.5, v = y + 0.5;
        const double inside =
            std::min({u - board.left, board.right - u, v - board.top, board.bottom - v});
        if (std::fabs(inside) <= around) near(x, y) = 1;
      }
    }
  }
  return near;
}

/// One scene with its truth.
class DefocusRun {
 public:
  static Result<DefocusRun> Create(const std::string& name, const PictureBench& options) {
    DefocusRun run(name, options);
    run.truth_ = run.scene_.motion ? TraceMovingCamera(run.scene_, run.camera_)
                                   : TraceBoards(run.scene_, run.camera_.width, run.camera_.height);
    run.edges_ = EdgePixels(run.scene_, run.camera_);
    // With the antialiasing of replay.
    PLEINAIR_ASSIGN_OR_RETURN(run.pinhole_, MakeBenchComposer(run.camera_, run.scene_.models, {}));
    return run;
  }

  Result<DefocusBenchRow> Measure(const std::string& method) {
    DefocusBenchRow row;
    row.scene = scene_.name;
    row.method = method;
    PLEINAIR_ASSIGN_OR_RETURN(Image<float> light, Draw(method, &row));
    double squares = 0.0, edge_squares = 0.0, edges = 0.0;
    for (int y = 0; y < light.height(); ++y) {
      for (int x = 0; x < light.width(); ++x) {
        const double off = light(x, y) - truth_(x, y);
        squares += off * off;
        if (edges_(x, y) == 0) continue;
        edge_squares += off * off;
        edges += 1.0;
        row.halo = std::max(row.halo, std::fabs(off));
      }
    }
    row.rmse = std::sqrt(squares / static_cast<double>(light.size()));
    row.edge_rmse = std::sqrt(edge_squares / std::max(1.0, edges));
    drawn_.push_back(std::move(light));
    return row;
  }

  /// The truth and what was measured, side by side.
  RgbImage Sheet() const {
    RgbImage sheet(truth_.width() * static_cast<int>(1 + drawn_.size()), truth_.height(), 3);
    int left = 0;
    const auto add = [&](const Image<float>& light) {
      for (int y = 0; y < light.height(); ++y) {
        for (int x = 0; x < light.width(); ++x) {
          for (int c = 0; c < 3; ++c) sheet(left + x, y, c) = Srgb8FromLinear(light(x, y));
        }
      }
      left += light.width();
    };
    add(truth_);
    for (const Image<float>& light : drawn_) add(light);
    return sheet;
  }

  /// Times the methods in turn, so that other load on the machine affects all equally.
  Result<void> Time(std::vector<DefocusBenchRow>* rows) {
    std::vector<std::array<std::vector<double>, 2>> times(rows->size() + 1);
    for (int round = 0; round < options_.rounds; ++round) {
      for (std::size_t i = 0; i <= rows->size(); ++i) {
        DefocusBenchRow unused;
        const std::clock_t cpu_start = std::clock();
        const auto start = std::chrono::steady_clock::now();
        PLEINAIR_RETURN_IF_ERROR(Draw(i < rows->size() ? (*rows)[i].method : "pinhole", &unused));
        const std::chrono::duration<double, std::milli> wall =
            std::chrono::steady_clock::now() - start;
        times[i][0].push_back(wall.count());
        times[i][1].push_back(1e3 * static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC);
      }
    }
    const double pinhole_ms = Median(times.back()[1]);
    for (std::size_t i = 0; i < rows->size(); ++i) {
      DefocusBenchRow& row = (*rows)[i];
      row.ms = Median(times[i][0]);
      row.cpu_ms = Median(times[i][1]);
      if (pinhole_ms > 0.0) row.ratio_to_pinhole = row.cpu_ms / pinhole_ms;
    }
    return {};
  }

 private:
  DefocusRun(const std::string& name, const PictureBench& options)
      : options_(options),
        camera_(BenchCamera(options.width, options.height)),
        scene_(MakeDefocusScene(name, camera_)),
        peeled_(scene_, options.width, options.height),
        black_(options.width, options.height, 3) {
    std::fill_n(black_.data(), black_.size(), std::uint8_t{0});
  }

  Result<RgbImage> Compose(Composer& composer) const {
    return composer.Compose(black_.view(), scene_.camera_from_marker, BenchExposure());
  }

  std::optional<compositor::ThinLens> Lens() const {
    return scene_.lens.aperture_m > 0.0 ? std::optional(scene_.lens) : std::nullopt;
  }

  /// The image of each pose by layers of depth.
  Result<Image<float>> DrawEachByLayers(int poses) {
    pinhole_->SetLens(Lens(), compositor::kByLayers);
    Image<float> mean(black_.width(), black_.height());
    for (int i = 0; i < poses; ++i) {
      PLEINAIR_ASSIGN_OR_RETURN(
          const RgbImage image,
          pinhole_->Compose(black_.view(), scene_.motion((i + 0.5) / poses - 0.5),
                            BenchExposure()));
      const Image<float> light = LightOf(image);
      for (std::size_t k = 0; k < mean.size(); ++k) {
        mean.data()[k] += light.data()[k] / static_cast<float>(poses);
      }
    }
    return mean;
  }

  /// The image of the moving camera.
  Result<Image<float>> DrawMoved(const std::string& method, DefocusBenchRow* row) {
    pinhole_->SetMotion({}, kMaxViews);
    if (const auto poses = CountAfter(kEach, method)) return DrawEachByLayers(*poses);
    const std::optional<int> poses = CountAfter(kPoses, method);
    pinhole_->SetLens(Lens(), poses.value_or(compositor::kByLayers));
    pinhole_->SetMotion(scene_.motion, poses.value_or(kMaxViews));
    PLEINAIR_ASSIGN_OR_RETURN(const RgbImage image, Compose(*pinhole_));
    row->views = pinhole_->DrawnLens().views;
    pinhole_->SetMotion({}, kMaxViews);
    return LightOf(image);
  }

  /// Rivals draw the pinhole image, too, which they blur.
  Result<Image<float>> Draw(const std::string& method, DefocusBenchRow* row) {
    if (IsOfMotion(method)) return DrawMoved(method, row);
    session::DefocusOptions drawn;
    const bool by_composer = method == "layered" || method.starts_with("lens:");
    if (by_composer) {
      DefocusArguments chosen;
      chosen.method = method;
      PLEINAIR_RETURN_IF_ERROR(ParseDefocus(chosen, &drawn));
      pinhole_->SetLens(scene_.lens, drawn.places);
    } else {
      pinhole_->SetLens({}, 1);
    }
    PLEINAIR_ASSIGN_OR_RETURN(const RgbImage image, Compose(*pinhole_));
    if (method == "gather") return DrawGathered(scene_, peeled_);
    if (method.starts_with("gaussian")) {
      GaussianLayers layers = DrawGaussianLayers(scene_, peeled_, method == "gaussian");
      row->layers = layers.layers;
      row->peels = PeeledBoards::kPeels;
      return std::move(layers.light);
    }
    if (by_composer) {
      row->layers = pinhole_->DrawnLens().layers;
      row->peels = pinhole_->DrawnLens().peels;
    }
    return LightOf(image);
  }

  PictureBench options_;
  CameraModel camera_;
  DefocusScene scene_;
  PeeledBoards peeled_;
  RgbImage black_;
  Image<float> truth_;
  Image<std::uint8_t> edges_;
  std::unique_ptr<Composer> pinhole_;
  std::vector<Image<float>> drawn_;  // By the measured methods.
};

}  // namespace

std::vector<std::string> DefaultDefocusMethods() {
  return {"layered", "gaussian", "gather", "lens:32"};
}

std::vector<std::string> DefaultMotionMethods() {
  return {"moved", "poses:8", "layered-each:16", "pinhole"};
}

Result<void> CheckDefocusMethod(const std::string& method) {
  for (const char* name : {"gaussian", "gaussian-each", "gather", "pinhole"}) {
    if (method == name) return {};
  }
  if (IsOfMotion(method)) return {};
  DefocusArguments chosen;
  chosen.method = method;
  session::DefocusOptions unused;
  if (!method.empty() && ParseDefocus(chosen, &unused)) return {};
  return InputError("--methods", "is unknown: " + method.substr(0, 64),
                    "write layered, gaussian, gaussian-each, gather, pinhole, moved, or lens:N, "
                    "poses:N and layered-each:N with N from 2 to 1024");
}

Result<void> RunDefocusBench(const PictureBench& bench, const DefocusBenchSink& sink) {
  const std::vector<std::string>& methods = bench.methods;
  for (const std::string& scene : bench.scenes) {
    PLEINAIR_ASSIGN_OR_RETURN(DefocusRun run, DefocusRun::Create(scene, bench));
    sink.advance();
    std::vector<DefocusBenchRow> rows;
    rows.reserve(methods.size());
    for (const std::string& method : methods) {
      PLEINAIR_ASSIGN_OR_RETURN(DefocusBenchRow row, run.Measure(method));
      rows.push_back(std::move(row));
      sink.advance();
    }
    if (sink.on_sheet) PLEINAIR_RETURN_IF_ERROR(sink.on_sheet(scene, run.Sheet()));
    PLEINAIR_RETURN_IF_ERROR(run.Time(&rows));
    for (const DefocusBenchRow& row : rows) sink.on_row(row);
  }
  return {};
}

}  // namespace pleinair::app
