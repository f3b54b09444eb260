// Coverage at places of a pixel, against exact areas.
#include "compositor/coverage/scene_coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/compositor/coverage/flat_camera.h"

namespace pleinair::compositor {
namespace {

/// Uniform random numbers, the same with every standard library.
class Uniform {
 public:
  explicit Uniform(unsigned seed) : random_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
  }

 private:
  std::mt19937 random_;
};

/// A bar along a direction around a point.
std::vector<glm::dvec2> Bar(glm::dvec2 middle, double angle, double length, double width) {
  const glm::dvec2 along = glm::dvec2(std::cos(angle), std::sin(angle)) * (length / 2);
  const glm::dvec2 across = glm::dvec2(-std::sin(angle), std::cos(angle)) * (width / 2);
  return {middle - along - across, middle + along - across, middle + along + across,
          middle - along + across};
}

struct Errors {
  double rms = 0.0, worst = 0.0;
};

/// Errors of random straight edges that cross a pixel, at most `max_angle` from an axis.
Errors ErrorsOfEdges(int edges, double max_angle) {
  Uniform uniform(1);
  Errors errors;
  constexpr int kSide = 9, kMiddle = 4;
  for (int i = 0; i < edges; ++i) {
    const double angle =
        std::floor(uniform(0, 4)) * std::numbers::pi / 2 + uniform(-1, 1) * max_angle;
    const glm::dvec2 normal(-std::sin(angle), std::cos(angle));
    const double reach = (std::abs(normal.x) + std::abs(normal.y)) / 2;
    // The edge is one side of a bar that is as wide as the image.
    const glm::dvec2 middle = glm::dvec2(kMiddle + 0.5) + normal * (20 + uniform(-reach, reach));
    const std::vector<glm::dvec2> corners = Bar(middle, angle, 60, 40);
    TestMesh mesh;
    mesh.Add(corners, 2.0);
    const MeasuredImage image(kSide, kSide, {mesh.Drawn(true)});
    const PixelPieces* pieces = image.At(kMiddle, kMiddle);
    if (pieces == nullptr) {
      ADD_FAILURE() << "an edge was missed";
      continue;
    }
    const double error = SumOf(pieces->object_weights) / 64.0 - AreaIn(corners, kMiddle, kMiddle);
    errors.rms += error * error / edges;
    errors.worst = std::max(errors.worst, std::abs(error));
  }
  errors.rms = std::sqrt(errors.rms);
  return errors;
}

TEST(SceneCoverage, OfStraightEdgesIsTheirArea) {
  const Errors any = ErrorsOfEdges(2000, std::numbers::pi / 4);
  EXPECT_LE(any.rms, 0.020);
  EXPECT_LE(any.worst, 0.10);
  EXPECT_GT(any.rms, 0.001) << "something is measured";
  EXPECT_LE(ErrorsOfEdges(500, 3 * std::numbers::pi / 180).rms, 0.025);
}

TEST(SceneCoverage, OfThinBarsIsEvenAlongThem) {
  Uniform uniform(2);
  for (const double width : {0.15, 0.2, 0.28, 0.5, 0.75, 1.0}) {
    for (int i = 0; i < 6; ++i) {
      constexpr int kSide = 216;
      const std::vector<glm::dvec2> corners = Bar({108 + uniform(-1, 1), 108 + uniform(-1, 1)},
                                                  uniform(0, std::numbers::pi), 200, width);
      TestMesh mesh;
      mesh.Add(corners, 3.0);
      const MeasuredImage image(kSide, kSide, {mesh.Drawn(true)});
      double drawn = 0.0, area = 0.0, squares = 0.0;
      int pixels = 0;
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const double exact = AreaIn(corners, x, y);
          const PixelPieces* pieces = image.At(x, y);
          if (pieces == nullptr) {
            EXPECT_TRUE(exact < 1e-9 || exact > 1 - 1e-9) << x << ' ' << y;
            drawn += exact;
          } else {
            const double covered = SumOf(pieces->object_weights) / 64.0;
            drawn += covered;
            squares += (covered - exact) * (covered - exact);
            ++pixels;
          }
          area += exact;
        }
      }
      EXPECT_NEAR(drawn / area, 1.0, 0.02) << width;
      EXPECT_LE(std::sqrt(squares / pixels), 0.03) << width;
    }
  }
}

TEST(SceneCoverage, SumsToThePixelExactly) {
  Uniform uniform(3);
  TestMesh ground, objects;
  ground.Add(Rectangle(-10, -10, 60, 60), 20.0);
  for (int i = 0; i < 30; ++i) {
    objects.Add(
        Bar({uniform(0, 48), uniform(0, 48)}, uniform(0, 3), uniform(2, 30), uniform(0.1, 6)),
        uniform(1, 10));
  }
  for (const int places : {4, 8, 16, 32, 64}) {
    const MeasuredImage image(48, 48, {ground.Drawn(false), objects.Drawn(true)}, places);
    EXPECT_GT(image.pieces().size(), 300U);
    for (const PixelPieces& pieces : image.pieces()) {
      ASSERT_EQ(SumOf(pieces.object_weights) + SumOf(pieces.real_weights), 64);
      EXPECT_EQ(pieces.objects[0] == 0, pieces.object_kind == PixelPieces::kNoKind);
    }
  }
}

TEST(SceneCoverage, OfAFanOfSliversHasNoHoles) {
  // Many triangles with a common corner, among them slivers, some without area.
  Uniform uniform(4);
  TestMesh mesh;
  const glm::dvec2 middle(12.3, 11.7);
  std::vector<double> angles(60);
  for (double& angle : angles) angle = uniform(0, 2 * std::numbers::pi);
  angles[1] = angles[0];
  std::sort(angles.begin(), angles.end());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double a = angles[i], b = angles[(i + 1) % angles.size()];
    const auto at = [&](double angle) {
      return middle + 30.0 * glm::dvec2(std::cos(angle), std::sin(angle));
    };
    mesh.Add({middle, at(a), at(b)}, {2.0, 3.0, 3.0});
    mesh.Add({middle, at(a), at(a) * 1e-9 + middle * (1 - 1e-9)}, 2.0);
  }
  const MeasuredImage image(24, 24, {mesh.Drawn(true, 1, true)});
  for (const PixelPieces& pieces : image.pieces()) ASSERT_EQ(SumOf(pieces.object_weights), 64);
  EXPECT_GT(image.pieces().size(), 100U);
}

TEST(SceneCoverage, LeavesOutWhatIsNoTriangle) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  TestMesh board, hostile;
  const std::vector<glm::dvec2> corners = Bar({8, 8}, 0.4, 9, 7);
  board.Add(corners, 2.0);
  const DrawnMesh alone = board.Drawn(true);
  hostile.Add({{1, 1}, {1, 1}, {1, 1}}, 1.0);
  hostile.Add({{1, 1}, {9, 9}, {14, 14}}, 1.0);
  hostile.Add({{1, 1}, {9, kNaN}, {2, 9}}, 1.0);
  hostile.Add({{1, kInfinity}, {9, 3}, {2, 9}}, 1.0);
  hostile.Add({{1, 1}, {9, 3}, {2, 9}}, {1.0, kNaN, 1.0});
  hostile.Add({{2, 9}, {9, 3}, {1, 1}}, {-1.0, -1.0, -1.0});  // Behind the camera.
  hostile.Add({{8, 8}, {8, 8}, {8, 8}}, {1.0, 2.0, 1.5});     // Seen edge-on.
  const MeasuredImage expected(16, 16, {alone});
  const MeasuredImage image(16, 16, {alone, hostile.Drawn(true, 100)});
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      if (expected.At(x, y) == nullptr) continue;
      ASSERT_EQ(image.At(x, y)->object_weights, expected.At(x, y)->object_weights);
      ASSERT_EQ(image.At(x, y)->objects, expected.At(x, y)->objects);
    }
  }
}

TEST(SceneCoverage, OfSheetsInOnePlaneIsThatOfTheFirst) {
  // Another division into triangles of the same plane, which is tilted.
  for (int frame = 0; frame < 20; ++frame) {
    const double shift = 0.1 * frame;
    const auto depth = [&](glm::dvec2 at) { return 1.0 / (0.02 + 0.003 * at.x + 0.001 * at.y); };
    const auto add = [&](const std::vector<glm::dvec2>& corners, TestMesh* mesh) {
      std::vector<double> depths;
      for (const glm::dvec2 corner : corners) depths.push_back(depth(corner));
      mesh->Add(corners, depths);
    };
    TestMesh first, second;
    add(Bar({32 + shift, 32}, 0.3, 40, 31), &first);
    for (int i = 0; i < 8; ++i) {
      add(Rectangle(4.0 * i + shift, 3, 4.0 * (i + 1) + shift, 60), &second);
    }
    const DrawnMesh alone = first.Drawn(true);
    const MeasuredImage expected(64, 64, {alone});
    const MeasuredImage image(64, 64, {alone, second.Drawn(true, 1000)});
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        if (expected.At(x, y) == nullptr) continue;
        const PixelPieces& pieces = *image.At(x, y);
        int of_first = 0;
        for (int k = 0; k < 4; ++k) {
          const std::uint32_t id = pieces.objects[static_cast<std::size_t>(k)];
          if (id != 0 && id < 1000)
            of_first += static_cast<int>(pieces.object_weights >> (8 * k) & 255);
        }
        ASSERT_EQ(of_first, SumOf(expected.At(x, y)->object_weights)) << x << ' ' << y;
      }
    }
  }
}

TEST(SceneCoverage, CountsManyPiecesOfAPixelTogether) {
  TestMesh mesh;
  for (int i = 0; i < 10; ++i) mesh.Add(Rectangle(1 + 0.1 * i, 0, 1.1 + 0.1 * i, 3), 2.0 + 0.1 * i);
  const MeasuredImage image(3, 3, {mesh.Drawn(true)});
  const PixelPieces& pieces = *image.At(1, 1);
  EXPECT_EQ(SumOf(pieces.object_weights), 64);
  for (const std::uint32_t id : pieces.objects) EXPECT_NE(id, 0U);
}

TEST(SceneCoverage, KnowsTheRenderersSamplesOfAPiece) {
  TestMesh mesh;
  mesh.Add(Rectangle(0.2, 0, 1.5, 3), 2.0);  // The left half of the second pixel.
  const MeasuredImage image(3, 3, {mesh.Drawn(true)}, 64, true);
  // Samples at 0.375, 0.875, 0.125 and 0.625 of the pixel's width.
  EXPECT_EQ(image.At(1, 1)->objects[0] >> 28, 0b0101U);
  EXPECT_EQ(image.At(1, 1)->objects[0] & 0xFFFFFFF, 1U) << "the triangle with more places";
}

TEST(SceneCoverage, CutsTrianglesAtTheCamera) {
  // Ground that reaches behind the camera, with its far edge in the image.
  TestMesh ground;
  ground.positions = {{-900, -10, -5}, {900, -10, -5}, {900, 90, 10}, {-900, 90, 10}};
  for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) ground.indices.push_back(k);
  ground.components.assign(4, 0);
  const MeasuredImage forwards(16, 16, {ground.Drawn(true)});
  std::swap(ground.indices[1], ground.indices[2]);
  std::swap(ground.indices[4], ground.indices[5]);
  const MeasuredImage backwards(16, 16, {ground.Drawn(true)});
  const MeasuredImage& image = forwards.marks().Count() > 0 ? forwards : backwards;
  ASSERT_EQ(image.marks().Count(), 16 + 16) << "a level line between two rows touches both";
  for (int x = 0; x < 16; ++x) {
    EXPECT_EQ(SumOf(image.At(x, 8)->object_weights) + SumOf(image.At(x, 9)->object_weights), 64);
  }
}

TEST(SceneCoverage, LeavesPixelsWithHolesToTheRenderer) {
  TestMesh leaf, board;
  leaf.Add(Rectangle(1.3, 1.3, 2.7, 2.7), 2.0);
  board.Add(Rectangle(4.3, 1.3, 6.7, 2.7), 2.0);
  DrawnMesh with_holes = leaf.Drawn(true);
  with_holes.has_holes = true;
  const MeasuredImage image(8, 4, {with_holes, board.Drawn(true, 50)});
  EXPECT_EQ(image.At(1, 1)->object_kind, PixelPieces::kKeepSamples);
  EXPECT_EQ(image.At(4, 1)->object_kind, 0U);
}

TEST(PlaceKernels, AgreeWithOneByOne) {
  Uniform uniform(5);
  int drawn = 0;
  for (int i = 0; i < 500; ++i) {
    TriangleAtPixel triangle;
    for (std::size_t e = 0; e < 3; ++e) {
      for (float& value : triangle.edges[e]) value = static_cast<float>(uniform(-1, 1));
      triangle.is_tested[e] = uniform(0, 1) < 0.7;
      triangle.has_edge[e] = uniform(0, 1) < 0.5;
    }
    triangle.nearness = {0.5F, static_cast<float>(uniform(-0.1, 0.1)), 0.02F};
    triangle.nearest = 0.55F;
    triangle.farthest = 0.45F;
    triangle.limit = 0.54F;
    triangle.number = 7;
    std::vector<float> x(32), y(32), nearness(32), expected;
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] = static_cast<float>(uniform(-0.5, 0.5));
      y[k] = static_cast<float>(uniform(-0.5, 0.5));
      nearness[k] = uniform(0, 1) < 0.5 ? 0.0F : static_cast<float>(uniform(0.4, 0.6));
    }
    expected = nearness;
    std::vector<std::uint32_t> numbers(32, kNoTriangle), expected_numbers = numbers;
    ScalarDrawAtPlaces()(triangle, {x, y, expected, expected_numbers});
    FastestDrawAtPlaces()(triangle, {x, y, nearness, numbers});
    EXPECT_EQ(numbers, expected_numbers);
    for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(nearness[k], expected[k], 1e-6F);
    drawn += static_cast<int>(std::count(numbers.begin(), numbers.end(), 7U));
  }
  EXPECT_GT(drawn, 500);
}

}  // namespace
}  // namespace pleinair::compositor
