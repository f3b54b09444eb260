// Tests that no memory is allocated once the buffers have grown, by counting operator new.

#include <vector>

#include <gtest/gtest.h>

#include "tests/tracker/counted_memory.h"
#include "tests/tracker/surf/surf_test_images.h"
#include "tracker/surf/descriptor_matcher.h"
#include "tracker/surf/quantised_descriptor.h"
#include "tracker/surf/surf.h"

namespace pleinair::tracker {
namespace {

TEST(Surf, AsksForNoMemoryAfterTheFirstPictures) {
  const GreyImage images[] = {TestTexture(1, 170).Draw(320, 240, 0, 1),
                              TestTexture(1, 170).Draw(320, 240, 1, 1)};
  Surf surf({.double_size = true});
  DescriptorMatcher matcher;
  std::vector<SurfKeypoint> keypoints;
  std::vector<SurfDescriptor> descriptors;
  std::vector<QuantisedDescriptor> quantised;
  std::vector<DescriptorMatch> of_frame;
  std::vector<DescriptorMatch> of_templates;
  const auto process = [&](const GreyImage& image) {
    surf.Detect(image.view(), &keypoints);
    surf.Describe(&keypoints, &descriptors);
    Quantise(keypoints, descriptors, &quantised);
    matcher.Match(quantised, 3, &of_frame, &of_templates);
  };
  process(images[0]);
  ASSERT_GT(keypoints.size(), 50u);
  matcher.SetTemplates(quantised);
  for (const GreyImage& image : images) process(image);
  const long before = Allocations();
  for (int i = 0; i < 3; ++i) {
    for (const GreyImage& image : images) process(image);
  }
  EXPECT_EQ(Allocations() - before, 0);
}

}  // namespace
}  // namespace pleinair::tracker
