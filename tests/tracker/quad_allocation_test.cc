// No memory is asked for once the buffers have grown: counts every operator new of this program.

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <vector>

#include "tests/tracker/quad_test_prints.h"
#include "tracker/quads/quad_detector.h"

namespace {
long allocations = 0;
}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
// The standard library takes and frees temporary buffers without exceptions.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace pleinair::tracker {
namespace {

TEST(QuadDetector, AsksForNoMemoryAfterTheFirstPictures) {
  const CameraModel camera = Pinhole(240, 200);
  std::vector<GreyImage> pictures;
  for (const unsigned seed : {1U, 2U}) {
    pictures.push_back(RenderMarkers(camera,
                                     {PrintAt(camera, seed, {70, 90}, 60, 20, 30, 40),
                                      PrintAt(camera, seed + 7, {180, 90}, 20 * seed, 40, 30, 4)},
                                     {.noise_codes = 12.0, .seed = seed, .light = {}}));
  }
  QuadDetector detector;
  std::vector<Quad> quads;
  for (const GreyImage& picture : pictures) detector.Detect(picture.view(), &quads);
  const long before = allocations;
  for (int i = 0; i < 3; ++i) {
    for (const GreyImage& picture : pictures) {
      detector.Detect(picture.view(), &quads);
      ASSERT_GE(quads.size(), 2U);
    }
  }
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace pleinair::tracker
