// Measures the tracker's time per image, and AprilTag 3's (quad_decimate 2, one thread) on the same
// image in the same run. `apriltag_d2` is that library's time in ms, `ratio` ours over it.

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
}
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "base/check.h"
#include "tests/tracker/marker_rendering.h"
#include "tracker/surf_golay/sg_marker_pattern.h"
#include "tracker/tracker.h"

namespace pleinair::tracker {
namespace {

/// Of this thread: both sides of the comparison use one, and other load must not count.
double CpuSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

CameraModel CameraOf(int height) {
  CameraModel camera;
  camera.width = height == 480 ? 640 : height * 16 / 9;
  camera.height = height;
  camera.fx = camera.fy = 1.25 * height;
  camera.cx = 0.5 * camera.width - 0.5;
  camera.cy = 0.5 * camera.height - 0.5;
  return camera;
}

double Hash(int x, int y, int octave) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343U ^
                    static_cast<std::uint32_t>(y) * 0xd8163841U ^
                    static_cast<std::uint32_t>(octave) * 0xcb1ab31fU;
  h = (h ^ (h >> 15)) * 0x2c1b3c6dU;
  h = (h ^ (h >> 12)) * 0x297a2d39U;
  return static_cast<double>(h ^ (h >> 15)) / 4294967296.0;
}

/// Surroundings with structure at every scale, like gravel and leaves: 1/f noise.
double Texture(int x, int y) {
  double sum = 0.0;
  for (int octave = 0; octave < 6; ++octave) {
    const int cell = 2 << octave;
    const double u = static_cast<double>(x % cell) / cell, v = static_cast<double>(y % cell) / cell;
    const int i = x / cell, j = y / cell;
    const double top = Hash(i, j, octave) * (1 - u) + Hash(i + 1, j, octave) * u;
    const double bottom = Hash(i, j + 1, octave) * (1 - u) + Hash(i + 1, j + 1, octave) * u;
    sum += (top * (1 - v) + bottom * v - 0.5) * (1 << octave) / 16.0;
  }
  return std::clamp(120.0 + 60.0 * sum, 5.0, 250.0);
}

struct Placed {
  Vec2 centre_px;
  double side_px;
  int number;
  bool covered;
};

GreyImage Picture(const CameraModel& camera, const std::vector<Placed>& places) {
  std::vector<RenderedMarker> markers;
  for (const Placed& place : places) {
    RenderedMarker marker;
    marker.pattern = std::make_shared<MarkerPattern>(SgMarkerPattern(place.number));
    marker.camera_from_marker =
        PoseAtPixel(camera, place.centre_px, place.side_px, marker.size, Radians(0.35),
                    Radians(0.7 + 0.3 * place.number), Radians(0.2 * place.number));
    // Two corners and what lies between them.
    if (place.covered) marker.cover = [](Vec2 at) { return at.y > 0.62 ? 0.3 : -1.0; };
    markers.push_back(marker);
  }
  GreyImage picture = RenderMarkers(camera, markers, {.blur_px = 0.55, .noise_codes = 1.5});
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const bool beside = std::all_of(places.begin(), places.end(), [&](const Placed& place) {
        return Norm(place.centre_px - Vec2{x * 1.0, y * 1.0}) > 1.25 * place.side_px;
      });
      if (beside) picture(x, y) = static_cast<std::uint8_t>(Texture(x, y));
    }
  }
  return picture;
}

std::vector<Placed> Grid(const CameraModel& camera, int count) {
  std::vector<Placed> places;
  const int columns = static_cast<int>(std::ceil(std::sqrt(count * 4.0 / 3.0)));
  const int rows = (count + columns - 1) / columns;
  const double step = std::min(camera.width / columns, camera.height / rows);
  for (int i = 0; i < count; ++i) {
    places.push_back({{(i % columns + 0.5) * camera.width / columns,
                       (static_cast<double>(i / columns) + 0.5) * camera.height / rows},
                      0.5 * step,
                      81 * i + 7,
                      false});
  }
  return places;
}

class Peer {
 public:
  explicit Peer(int threads) {
    apriltag_detector_add_family(detector_, family_);
    detector_->quad_decimate = 2.0F;
    detector_->nthreads = threads;
  }
  ~Peer() {
    apriltag_detector_destroy(detector_);
    tag36h11_destroy(family_);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  void Detect(GreyImage* picture) {
    image_u8_t image{picture->width(), picture->height(), picture->width(), picture->data()};
    apriltag_detections_destroy(apriltag_detector_detect(detector_, &image));
  }

 private:
  apriltag_family_t* family_ = tag36h11_create();
  apriltag_detector_t* detector_ = apriltag_detector_create();
};

/// Images that the tracker processes forwards and backwards; each must show `expected` markers.
void Run(benchmark::State& state, std::vector<GreyImage> pictures, const CameraModel& camera,
         SgStrategy strategy, bool consecutive, std::size_t expected) {
  TrackerOptions options;
  options.families = {"sg"};
  options.marker_size_m = 0.1;
  options.consecutive_frames = consecutive;
  options.sg.strategy = strategy;
  auto made = Tracker::Create(camera, options);
  CHECK_EQ(made.has_value(), true);
  Tracker& tracker = **made;
  Peer peer(1);
  const std::size_t count = pictures.size();
  double ours = 0.0, theirs = 0.0;
  std::size_t frame = 0, found = 0, frames = 0;
  for (std::size_t i = 0; i < 2 * count; ++i) {  // Buffers grow and the first frames search.
    CHECK_EQ(tracker.Track(pictures[i < count ? i : 2 * count - 1 - i].view()).has_value(), true);
  }
  for (auto _ : state) {
    const std::size_t at = frame++ % (2 * count);
    GreyImage& picture = pictures[at < count ? at : 2 * count - 1 - at];
    double start = CpuSeconds();
    peer.Detect(&picture);
    theirs += CpuSeconds() - start;
    start = CpuSeconds();
    const auto observed = tracker.Track(picture.view());
    const double took = CpuSeconds() - start;
    ours += took;
    state.SetIterationTime(took);
    found += observed.has_value() ? observed->size() : 0;
    ++frames;
  }
  if (found < expected * frames) state.SkipWithError("not all markers were found");
  state.counters["apriltag_d2"] = benchmark::Counter(theirs / static_cast<double>(frames) * 1e3);
  state.counters["markers"] =
      benchmark::Counter(static_cast<double>(found) / static_cast<double>(frames));
  state.counters["ratio"] = benchmark::Counter(ours / theirs);
}

void BM_FastOneMarker(benchmark::State& state) {
  const CameraModel camera = CameraOf(static_cast<int>(state.range(0)));
  const double side = 0.2 * camera.height;
  std::vector<GreyImage> pictures;
  pictures.push_back(
      Picture(camera, {{{0.4 * camera.width, 0.5 * camera.height}, side, 7, false}}));
  Run(state, std::move(pictures), camera, SgStrategy::kFast, false, 1);
}

void FiftyMarkers(benchmark::State& state, SgStrategy strategy) {
  const CameraModel camera = CameraOf(static_cast<int>(state.range(0)));
  std::vector<GreyImage> pictures;
  pictures.push_back(Picture(camera, Grid(camera, 50)));
  Run(state, std::move(pictures), camera, strategy, false, 50);
}
void BM_FastFiftyMarkers(benchmark::State& state) { FiftyMarkers(state, SgStrategy::kFast); }
void BM_HybridFiftyMarkers(benchmark::State& state) { FiftyMarkers(state, SgStrategy::kHybrid); }

void BM_SurfGolayCoveredMarker(benchmark::State& state) {
  const CameraModel camera = CameraOf(static_cast<int>(state.range(0)));
  const double side = 0.25 * camera.height;
  std::vector<GreyImage> pictures;
  pictures.push_back(Picture(camera, {{{0.4 * camera.width, 0.5 * camera.height}, side, 7, true}}));
  Run(state, std::move(pictures), camera, SgStrategy::kSurfGolay, false, 1);
}

void BM_HybridOneMarker(benchmark::State& state) {
  const CameraModel camera = CameraOf(static_cast<int>(state.range(0)));
  const double side = 0.2 * camera.height;
  std::vector<GreyImage> pictures;
  pictures.push_back(
      Picture(camera, {{{0.4 * camera.width, 0.5 * camera.height}, side, 7, false}}));
  Run(state, std::move(pictures), camera, SgStrategy::kHybrid, false, 1);
}

void BM_TrackedMarkers(benchmark::State& state) {
  const CameraModel camera = CameraOf(static_cast<int>(state.range(0)));
  const int markers = static_cast<int>(state.range(1));
  std::vector<GreyImage> pictures;
  for (int i = 0; i < 8; ++i) {
    std::vector<Placed> places =
        markers == 1 ? std::vector<Placed>{{{0.4 * camera.width, 0.5 * camera.height},
                                            0.2 * camera.height,
                                            7,
                                            false}}
                     : Grid(camera, markers);
    for (Placed& place : places) place.centre_px = place.centre_px + Vec2{1.4 * i, -0.6 * i};
    pictures.push_back(Picture(camera, places));
  }
  Run(state, std::move(pictures), camera, SgStrategy::kHybrid, true,
      static_cast<std::size_t>(markers));
}

double ResidentMebibytes() {
  std::ifstream file("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

/// Consecutive frames in which a marker moves forwards and backwards, is covered and disappears for
/// a while. Reports the process's memory after the first thousand frames and after all.
void BM_MemoryOverFrames(benchmark::State& state) {
  const CameraModel camera = CameraOf(480);
  std::vector<GreyImage> pictures;
  for (int i = 0; i < 24; ++i) {
    std::vector<Placed> places;
    if (i < 20) places.push_back({{250.0 + 1.4 * i, 240.0 - 0.6 * i}, 96.0, 7, i >= 10});
    pictures.push_back(Picture(camera, places));
  }
  TrackerOptions options;
  options.families = {"sg"};
  options.marker_size_m = 0.1;
  options.consecutive_frames = true;
  auto made = Tracker::Create(camera, options);
  CHECK_EQ(made.has_value(), true);
  constexpr int kFirst = 1000;
  double first = 0.0;
  std::int64_t found = 0;
  for (auto _ : state) {
    for (int frame = 0; frame < state.range(0); ++frame) {
      if (frame == kFirst) first = ResidentMebibytes();
      // Forwards and backwards.
      const int at = frame % 48;
      const auto observed = (*made)->Track(pictures[at < 24 ? at : 47 - at].view());
      found += observed.has_value() ? static_cast<std::int64_t>(observed->size()) : 0;
    }
  }
  state.counters["mib_first"] = benchmark::Counter(first);
  state.counters["mib_last"] = benchmark::Counter(ResidentMebibytes());
  state.counters["markers"] =
      benchmark::Counter(static_cast<double>(found) / static_cast<double>(state.range(0)));
}

void BM_AprilTag(benchmark::State& state) {
  const CameraModel camera = CameraOf(static_cast<int>(state.range(0)));
  GreyImage picture =
      Picture(camera, {{{0.4 * camera.width, 0.5 * camera.height}, 0.2 * camera.height, 7, false}});
  Peer peer(static_cast<int>(state.range(1)));
  for (auto _ : state) peer.Detect(&picture);
}

#define PLEINAIR_HEIGHTS \
  ArgName("height")->Arg(480)->Arg(720)->Arg(1080)->UseManualTime()->Unit(benchmark::kMillisecond)
BENCHMARK(BM_FastOneMarker)->PLEINAIR_HEIGHTS;
BENCHMARK(BM_HybridOneMarker)->PLEINAIR_HEIGHTS;
BENCHMARK(BM_SurfGolayCoveredMarker)->PLEINAIR_HEIGHTS;
BENCHMARK(BM_FastFiftyMarkers)->PLEINAIR_HEIGHTS;
BENCHMARK(BM_HybridFiftyMarkers)->PLEINAIR_HEIGHTS;
BENCHMARK(BM_TrackedMarkers)
    ->ArgNames({"height", "markers"})
    ->ArgsProduct({{480, 720, 1080}, {1}})
    ->Args({480, 10})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_MemoryOverFrames)
    ->ArgName("frames")
    ->Arg(100'000)
    ->Iterations(1)
    ->Unit(benchmark::kSecond);
BENCHMARK(BM_AprilTag)
    ->ArgNames({"height", "threads"})
    ->ArgsProduct({{480, 720, 1080}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pleinair::tracker

BENCHMARK_MAIN();
