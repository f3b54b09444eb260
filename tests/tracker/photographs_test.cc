// Tests three real photographs; provenance and licence in data/nasa-apriltags/README.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "base/pixel_origin.h"
#include "tests/source_tree.h"
#include "tracker/tracker.h"

namespace pleinair::tracker {
namespace {

struct GoldenTag {
  int id = 0;
  std::array<Vec2, 4> corners_px;  ///< In our pixel origin; the order is the peer library's.
};

std::vector<GoldenTag> ReadGolden(const std::string& path) {
  std::ifstream file(path);
  std::vector<GoldenTag> tags;
  for (std::string line; std::getline(file, line);) {
    GoldenTag tag;
    auto& c = tag.corners_px;
    if (std::sscanf(line.c_str(), "%d, (%lf %lf), (%lf %lf), (%lf %lf), (%lf %lf)", &tag.id,
                    &c[0].x, &c[0].y, &c[1].x, &c[1].y, &c[2].x, &c[2].y, &c[3].x, &c[3].y) != 9) {
      continue;
    }
    for (Vec2& corner : c) corner = PixelFromCornerOrigin(corner);
    tags.push_back(tag);
  }
  return tags;
}

/// Maximum distance of a reference corner from its nearest observed corner.
double Distance(const GoldenTag& tag, const MarkerObservation& observation) {
  double farthest = 0.0;
  for (const Vec2 golden : tag.corners_px) {
    double nearest = 1e9;
    for (const Vec2 corner : observation.detection.corners_px) {
      nearest = std::min(nearest, Norm(corner - golden));
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

class Photograph : public testing::TestWithParam<std::pair<const char*, std::size_t>> {};

TEST_P(Photograph, ShowsEveryTagOfTheGoldenFileWithinOnePixel) {
  const auto [name, count] = GetParam();
  const std::string stem = tests::SourceTree() / "tests/tracker/data/nasa-apriltags" / name;
  const std::vector<GoldenTag> golden = ReadGolden(stem + ".txt");
  ASSERT_EQ(golden.size(), count);
  const cv::Mat image = cv::imread(stem + ".jpg", cv::IMREAD_GRAYSCALE);
  ASSERT_FALSE(image.empty());
  // This camera is not calibrated: assumes about the field of view of a normal lens.
  const CameraModel camera{.width = image.cols,
                           .height = image.rows,
                           .fx = 800,
                           .fy = 800,
                           .cx = 0.5 * (image.cols - 1),
                           .cy = 0.5 * (image.rows - 1)};
  const auto tracker = *Tracker::Create(camera, {.marker_size_m = 0.05});
  const auto observations = tracker->Track(
      {image.data, image.cols, image.rows, 1, static_cast<std::ptrdiff_t>(image.step)});
  ASSERT_TRUE(observations.has_value());
  double farthest = 0.0;
  for (const GoldenTag& tag : golden) {
    double distance = 1e9;
    for (const MarkerObservation& observation : *observations) {
      if (observation.detection.id == tag.id)
        distance = std::min(distance, Distance(tag, observation));
    }
    EXPECT_LT(distance, 1.0) << "at " << tag.corners_px[0].x << ", " << tag.corners_px[0].y;
    farthest = std::max(farthest, distance);
  }
  std::printf("%s: %zu tags, farthest corner %.2f px from the golden file's\n", name, golden.size(),
              farthest);
  for (const MarkerObservation& observation : *observations) EXPECT_EQ(observation.detection.id, 0);
}

INSTANTIATE_TEST_SUITE_P(NasaSwarmathon, Photograph,
                         testing::Values(std::pair{"33369213973_9d9bb4cc96_c", 12},
                                         std::pair{"34085369442_304b6bafd9_c", 25},
                                         std::pair{"34139872896_defdb2f8d9_c", 10}));

}  // namespace
}  // namespace pleinair::tracker
