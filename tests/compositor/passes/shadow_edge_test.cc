// Edges of virtual shadows on the ground against rays to the sun's disc.
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "compositor/surfaces/sample_places.h"
#include "tests/compositor/composer_scene.h"

namespace pleinair::compositor {
namespace {

/// A sun that stands as one likes, without any sky worth mentioning: the ratio of light is then the
/// sun's visibility.
class SunAlone : public SouthernSun {
 public:
  SunAlone(double azimuth_rad, double elevation_rad)
      : to_sun_{{std::sin(azimuth_rad) * std::cos(elevation_rad),
                 std::cos(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad)}} {}
  LinearRgb SkyRadiance(Direction<World>) const override { return {1.0, 1.0, 1.0}; }
  LinearRgb SkyHorizontalIrradiance() const override {
    return LinearRgb{1.0, 1.0, 1.0} * std::numbers::pi;
  }
  Direction<World> ToSun() const override { return to_sun_; }

 private:
  Direction<World> to_sun_;
};

/// A level board whose shadow falls on the marker.
struct Board {
  static constexpr double kHalfLength_m = 0.4, kHalfWidth_m = 0.3;
  double height_m = 0.0, turn_rad = 0.0;
  Vec3 to_sun = {0.0, 0.0, 1.0};

  Vec3 Centre() const { return to_sun * (height_m / to_sun.z); }
  PlacedModel Placed() const {
    PlacedModel placed = Place(
        MakeBox({-kHalfLength_m, -kHalfWidth_m, 0}, {kHalfLength_m, kHalfWidth_m, 0}, 0.0F), false);
    const double c = std::cos(turn_rad), s = std::sin(turn_rad);
    placed.linear = Mat3{c, -s, 0, s, c, 0, 0, 0, 1};
    placed.translation_m = Centre();
    return placed;
  }
  /// Whether a point of the board's plane, widened by `margin_m`, belongs to it.
  bool Holds(double x, double y, double margin_m = 0.0) const {
    const double c = std::cos(turn_rad), s = std::sin(turn_rad);
    const double dx = x - Centre().x, dy = y - Centre().y;
    return std::abs(c * dx + s * dy) < kHalfLength_m + margin_m &&
           std::abs(c * dy - s * dx) < kHalfWidth_m + margin_m;
  }
  /// Share of the sun's disc that a point of the ground sees, by rays.
  double Visibility(double x, double y) const {
    constexpr int kRays = 64;
    const Vec3 u = Normalized(Cross(to_sun, Vec3{0, 0, 1})), v = Cross(u, to_sun);
    int lit = 0;
    for (int i = 0; i < kRays; ++i) {
      const double radius =
          std::tan(0.2665 * std::numbers::pi / 180.0) * std::sqrt((i + 0.5) / kRays);
      const double angle = 2.399963229728653 * i;
      const Vec3 ray = to_sun + u * (radius * std::cos(angle)) + v * (radius * std::sin(angle));
      const double along = height_m / ray.z;
      lit += Holds(x + along * ray.x, y + along * ray.y) ? 0 : 1;
    }
    return static_cast<double>(lit) / kRays;
  }
};

/// Root mean square of the error of visibility, over pixels with an edge of the board's shadow.
double EdgeError(const Board& board, const RgbImage& image, std::uint8_t code) {
  const auto places = SamplePlaces(64);
  const double pixel_m = 3.0 / kCamera.fx;
  double squares = 0.0;
  int edges = 0;
  for (int row = 50; row < 190; ++row) {
    for (int column = 90; column < 230; ++column) {
      const double x = (column - kCamera.cx) * pixel_m, y = (kCamera.cy - row) * pixel_m;
      const double nearer = 1.0 - board.height_m / 3.0;
      if (board.Holds(x * nearer, y * nearer, 0.03)) continue;  // The board itself.
      double truth = 0.0;
      for (const glm::vec2 place : places) {
        truth += board.Visibility(x + place.x * pixel_m, y - place.y * pixel_m) / 64.0;
      }
      if (truth < 0.01 || truth > 0.99) continue;
      const double seen = LinearFromSrgb8()[image(column, row, 1)] / LinearFromSrgb8()[code];
      squares += (seen - truth) * (seen - truth);
      ++edges;
    }
  }
  EXPECT_GT(edges, 150);
  return std::sqrt(squares / edges);
}

// An object far away makes texels of the shadow map larger: 0.15, 0.4, 0.9 and 1.4 pixels. A pixel
// is a centimetre of ground. Texels hold two lines, so that corners of the largest are less exact.
TEST(ComposerShadowEdges, AreWhereTheCasterEndsHoweverLargeTheTexels) {
  struct Case {
    double far_object_m, height_m, turn_rad, azimuth_rad, elevation_rad, largest_error;
  };
  constexpr std::uint8_t kCode = 230;
  for (const Case& at :
       {Case{0.0, 0.7, 0.4, 2.0, 0.9, 0.03}, Case{3.0, 0.3, 1.9, 5.0, 0.7, 0.03},
        Case{6.0, 0.7, 3.1, 0.6, 1.0, 0.03}, Case{10.0, 0.7, 0.9, 3.6, 0.8, 0.05}}) {
    const SunAlone light(at.azimuth_rad, at.elevation_rad);
    const Board board{at.height_m, at.turn_rad, light.ToSun().xyz};
    std::vector<PlacedModel> scene{kGround, board.Placed()};
    if (at.far_object_m > 0.0) {
      scene.push_back(Place(MakeBox({-0.1, -0.1, 0.001}, {0.1, 0.1, 0.2}, 0.0F), false));
      scene.back().translation_m = {at.far_object_m, at.far_object_m, 0.0};
    }
    const auto composer = LitComposer(scene, light);
    composer->AssumeUnmodelledShadows(false);
    const auto image = composer->Compose(EvenPicture(kCode).view(), kFromAbove, {1, 1, 1});
    ASSERT_TRUE(image);
    EXPECT_LT(EdgeError(board, *image, kCode), at.largest_error) << at.far_object_m;
  }
}

}  // namespace
}  // namespace pleinair::compositor
