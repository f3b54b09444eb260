// Measures the time of SURF and its peers on an image of 640x480, and of descriptor matching. The
// image is the first one named in PLEINAIR_SURF_PICTURE, or a synthetic texture.

#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/tracker/surf/surf_peers.h"
#include "tests/tracker/surf/surf_test_images.h"
#include "tracker/surf/descriptor_matcher.h"
#include "tracker/surf/surf.h"

namespace pleinair::tracker {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int kFeatures = 400;

const cv::Mat& Picture() {
  static const cv::Mat image = [] {
    cv::Mat grey;
    if (const char* file = std::getenv("PLEINAIR_SURF_PICTURE")) {
      grey = cv::imread(file, cv::IMREAD_GRAYSCALE);
    }
    if (!grey.empty()) {
      cv::resize(grey, grey, {kWidth, kHeight}, 0, 0, cv::INTER_AREA);
      return grey;
    }
    GreyImage texture = TestTexture(1, 400).Draw(kWidth, kHeight, 0, 1);
    return cv::Mat(kHeight, kWidth, CV_8U, texture.data()).clone();
  }();
  return image;
}

ImageView<const std::uint8_t> View(const cv::Mat& grey) {
  return {grey.data, grey.cols, grey.rows, 1, static_cast<std::ptrdiff_t>(grey.step[0])};
}

void DetectKeypoints(benchmark::State& state) {
  Surf surf({.max_keypoints = kFeatures, .double_size = state.range(0) != 0});
  std::vector<SurfKeypoint> keypoints;
  for (auto _ : state) surf.Detect(View(Picture()), &keypoints);
  state.counters["keypoints"] = static_cast<double>(keypoints.size());
}
BENCHMARK(DetectKeypoints)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void DescribeKeypoints(benchmark::State& state) {
  Surf surf({.max_keypoints = kFeatures, .upright = state.range(0) != 0});
  std::vector<SurfKeypoint> keypoints;
  std::vector<SurfDescriptor> descriptors;
  for (auto _ : state) {
    state.PauseTiming();
    surf.Detect(View(Picture()), &keypoints);
    state.ResumeTiming();
    surf.Describe(&keypoints, &descriptors);
  }
  state.counters["keypoints"] = static_cast<double>(keypoints.size());
}
BENCHMARK(DescribeKeypoints)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

std::vector<QuantisedDescriptor> RandomDescriptors(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<QuantisedDescriptor> descriptors;
  for (int i = 0; i < count; ++i) {
    SurfDescriptor descriptor;
    for (float& value : descriptor) value = normal(random);
    descriptors.push_back(Quantise(descriptor, random() % 2 == 0));
  }
  return descriptors;
}

void MatchDescriptors(benchmark::State& state) {
  DescriptorMatcher matcher;
  matcher.SetTemplates(RandomDescriptors(1500, 1));
  const std::vector<QuantisedDescriptor> frame = RandomDescriptors(400, 2);
  std::vector<DescriptorMatch> of_frame;
  std::vector<DescriptorMatch> of_templates;
  for (auto _ : state) {
    matcher.Match(frame, static_cast<int>(state.range(0)), &of_frame, &of_templates);
  }
}
BENCHMARK(MatchDescriptors)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond);

void DetectAndDescribe(benchmark::State& state, const Peer& peer) {
  FeatureSet set;
  for (auto _ : state) set = peer.run(Picture());
  state.counters["features"] = static_cast<double>(set.features.size());
}

}  // namespace
}  // namespace pleinair::tracker

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  for (const auto& peer : pleinair::tracker::MakePeers(pleinair::tracker::kFeatures)) {
    benchmark::RegisterBenchmark(peer.name.c_str(), [peer](benchmark::State& state) {
      pleinair::tracker::DetectAndDescribe(state, peer);
    })->Unit(benchmark::kMillisecond);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
