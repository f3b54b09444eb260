// Tests that no memory is allocated once the buffers have grown, by counting operator new.

#include <gtest/gtest.h>

#include <vector>

#include "tests/tracker/counted_memory.h"
#include "tests/tracker/quads/quad_test_markers.h"
#include "tracker/quads/quad_detector.h"

namespace pleinair::tracker {
namespace {

TEST(QuadDetector, AsksForNoMemoryAfterTheFirstPictures) {
  const CameraModel camera = Pinhole(240, 200);
  std::vector<GreyImage> images;
  for (const unsigned seed : {1U, 2U}) {
    images.push_back(RenderMarkers(camera,
                                   {MarkerAt(camera, seed, {70, 90}, 60, 20, 30, 40),
                                    MarkerAt(camera, seed + 7, {180, 90}, 20 * seed, 40, 30, 4)},
                                   {.noise_codes = 12.0, .seed = seed, .light = {}}));
  }
  QuadDetector detector;
  std::vector<Quad> quads;
  for (const GreyImage& image : images) detector.Detect(image.view(), &quads);
  const long before = Allocations();
  for (int i = 0; i < 3; ++i) {
    for (const GreyImage& image : images) {
      detector.Detect(image.view(), &quads);
      ASSERT_GE(quads.size(), 2U);
    }
  }
  EXPECT_EQ(Allocations(), before);
}

}  // namespace
}  // namespace pleinair::tracker
