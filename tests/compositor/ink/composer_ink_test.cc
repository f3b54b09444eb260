// Ink in composed pictures, against what is calculated by hand or sampled at many places.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/srgb.h"
#include "compositor/composer.h"
#include "compositor/ink/ink_shape.h"
#include "tests/compositor/composer_scene.h"

namespace pleinair::compositor {
namespace {

constexpr LinearRgb kRed{0.8, 0.05, 0.02};
const LinearRgb kExposure{kExposureScale, kExposureScale, kExposureScale};

RgbImage EvenPicture(std::uint8_t code, const CameraModel& camera = kCamera) {
  RgbImage picture(camera.width, camera.height, 3);
  std::fill_n(picture.data(), picture.size(), code);
  return picture;
}

InkShape LineAlong(std::vector<glm::vec3> points, float width_m, const InkStyle& style) {
  InkShape shape{.style = style, .pen = {.width_m = width_m}};
  float way = 0.0F;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const float size = glm::length(points[i + 1] - points[i]);
    shape.segments.push_back({points[i], points[i + 1], way, way + size});
    way += size;
  }
  return shape;
}

InkShape Rectangle(glm::vec2 low, glm::vec2 high, const InkStyle& style) {
  return {.style = style, .rings = {{low, {high.x, low.y}, high, {low.x, high.y}, low}}};
}

struct InkScene {
  std::vector<PlacedModel> models = {kGround};
  CameraModel camera = kCamera;
  Transform<Camera, Marker> camera_from_marker = kFromAbove;
  double sun_lux = kSunLux;
  bool assume_unmodelled = false;
  ComposerOptions options = {};
};

RgbImage ComposeInk(const InkScene& scene, const std::vector<InkShape>& ink,
                    const RgbImage& picture) {
  const auto composer =
      LitComposer(scene.models, SouthernSun(scene.sun_lux), scene.camera, scene.options);
  composer->AssumeUnmodelledShadows(scene.assume_unmodelled);
  if (const auto set = composer->SetInk(ink, Mat3{}); !set) ADD_FAILURE() << set.error().Message();
  auto composed =
      composer->Compose(CameraImageView(picture.view()), scene.camera_from_marker, kExposure);
  if (!composed) ADD_FAILURE() << composed.error().Message();
  return *std::move(composed);
}

double Light(const RgbImage& image, int x, int y, int c) {
  return LinearFromSrgb(image(x, y, c) / 255.0);
}

TEST(ComposerInk, ChangesNothingWithoutOpacity) {
  const RgbImage picture = EvenPicture(150);
  for (const InkBlend blend : {InkBlend::kStain, InkBlend::kPaint, InkBlend::kGlow}) {
    const RgbImage composed =
        ComposeInk({}, {LineAlong({{-1, 0, 0}, {1, 0, 0}}, 0.2F, {kRed, 0.0F, blend})}, picture);
    EXPECT_TRUE(std::equal(picture.data(), picture.data() + picture.size(), composed.data()));
  }
}

TEST(ComposerInk, StainMultipliesTheCamerasLight) {
  const RgbImage picture = EvenPicture(150);
  const RgbImage composed = ComposeInk(
      {}, {LineAlong({{-1, 0, 0}, {1, 0, 0}}, 0.2F, {kRed, 0.5F, InkBlend::kStain})}, picture);
  const double before = Light(picture, 160, 120, 0);
  EXPECT_NEAR(Light(composed, 160, 120, 0), before * (0.5 + 0.5 * kRed.r), 0.002);
  EXPECT_NEAR(Light(composed, 160, 120, 1), before * (0.5 + 0.5 * kRed.g), 0.002);
  // A width of 0.2 m has 20 pixels: rows 110 to 129 and nothing beyond.
  for (int y = 0; y < kCamera.height; ++y) {
    const bool in_line = y >= 110 && y < 130;
    EXPECT_EQ(composed(160, y, 0) != picture(160, y, 0), in_line) << y;
  }
}

TEST(ComposerInk, GlowHasItsColorInAnyLight) {
  const InkStyle glow{kRed, 1.0F, InkBlend::kGlow};
  for (const std::uint8_t code : {20, 200}) {
    const RgbImage composed =
        ComposeInk({}, {LineAlong({{-1, 0, 0}, {1, 0, 0}}, 0.2F, glow)}, EvenPicture(code));
    EXPECT_NEAR(Light(composed, 160, 120, 0), kRed.r, 0.004);
    EXPECT_NEAR(Light(composed, 160, 120, 1), kRed.g, 0.004);
  }
}

TEST(ComposerInk, PaintHasTheLightOfTheSurface) {
  const InkStyle paint{{0.5, 0.4, 0.1}, 1.0F, InkBlend::kPaint};
  for (const double sun : {0.0, kSunLux}) {
    const RgbImage composed = ComposeInk(
        {.sun_lux = sun}, {LineAlong({{-1, 0, 0}, {1, 0, 0}}, 0.2F, paint)}, EvenPicture(90));
    const double lux = kSkyLux + sun * std::numbers::sqrt2 / 2;
    EXPECT_NEAR(Light(composed, 160, 120, 0), 0.5 * lux * std::numbers::inv_pi * kExposureScale,
                0.006)
        << sun;
    EXPECT_NEAR(Light(composed, 160, 120, 2), 0.1 * lux * std::numbers::inv_pi * kExposureScale,
                0.004)
        << sun;
  }
}

TEST(ComposerInk, PaintLiesInTheShadowOfARealWall) {
  // A wall in the south, 1 m high, shades the ground up to 1 m north of it.
  const PlacedModel wall = Place(MakeBox({-4, -1.0, 0}, {4, -0.9, 1.0}, 0.3F), true);
  const InkStyle paint{{0.5, 0.5, 0.5}, 1.0F, InkBlend::kPaint};
  const RgbImage composed =
      ComposeInk({.models = {kGround, wall}}, {Rectangle({-0.5F, -0.5F}, {0.5F, 0.6F}, paint)},
                 EvenPicture(90));
  const double shaded = Light(composed, 160, 150, 1), sunlit = Light(composed, 160, 80, 1);
  EXPECT_LT(shaded, 0.35 * sunlit);
  EXPECT_GT(shaded, 0.10 * sunlit);
}

TEST(ComposerInk, LiesBehindObjectsAndInTheirShadow) {
  const InkStyle stain{{0.5, 0.5, 0.5}, 1.0F, InkBlend::kStain};
  const InkShape line = LineAlong({{-1.2F, 0.3F, 0}, {1.2F, 0.3F, 0}}, 0.1F, stain);
  const InkShape through = LineAlong({{0, -1, 0}, {0, 1, 0}}, 0.1F, stain);
  const RgbImage picture = EvenPicture(150);
  const InkScene scene{.models = {kGround, kCube}};
  const RgbImage with = ComposeInk(scene, {line, through}, picture);
  const RgbImage without = ComposeInk(scene, {}, picture);
  // The cube's shadow falls to the north, onto the first line; the picture shows 100 px a metre.
  EXPECT_LT(Light(without, 160, 90, 1), 0.6 * Light(picture, 160, 90, 1)) << "in the shadow";
  EXPECT_NEAR(Light(with, 165, 90, 1), 0.5 * Light(without, 165, 90, 1), 0.006);
  for (int y = 110; y < 130; ++y) EXPECT_EQ(with(160, y, 1), without(160, y, 1)) << "on the cube";
}

TEST(ComposerInk, OfAnAreaHasHoles) {
  InkShape area = Rectangle({-0.5F, -0.4F}, {0.5F, 0.4F}, {kRed, 1.0F, InkBlend::kStain});
  area.rings.push_back(
      {{-0.2F, -0.2F}, {-0.2F, 0.2F}, {0.2F, 0.2F}, {0.2F, -0.2F}, {-0.2F, -0.2F}});
  const RgbImage picture = EvenPicture(150);
  const RgbImage composed = ComposeInk({}, {area}, picture);
  for (int y = 0; y < kCamera.height; y += 3) {
    for (int x = 0; x < kCamera.width; x += 3) {
      const double east = (x - 159.5) / 100.0, north = (119.5 - y) / 100.0;
      const double outer = std::max(std::fabs(east) - 0.5, std::fabs(north) - 0.4);
      const double inner = std::max(std::fabs(east), std::fabs(north)) - 0.2;
      if (std::min(std::fabs(outer), std::fabs(inner)) < 0.006) continue;
      EXPECT_EQ(composed(x, y, 1) != picture(x, y, 1), outer < 0.0 && inner > 0.0) << x << " " << y;
    }
  }
}

TEST(ComposerInk, LaterShapesCoverEarlierOnes) {
  const InkStyle blue{{0.02, 0.05, 0.8}, 1.0F, InkBlend::kGlow}, red{kRed, 1.0F, InkBlend::kGlow};
  const RgbImage composed =
      ComposeInk({}, {Rectangle({-1, -1}, {1, 1}, blue), Rectangle({-0.2F, -1}, {0.2F, 1}, red)},
                 EvenPicture(150));
  EXPECT_NEAR(Light(composed, 160, 120, 0), kRed.r, 0.004);
  EXPECT_NEAR(Light(composed, 100, 120, 2), 0.8, 0.004);
}

TEST(ComposerInk, DoesNotAddUpWhereALineCrossesItself) {
  const InkStyle half{{0.5, 0.5, 0.5}, 0.5F, InkBlend::kStain};
  const RgbImage picture = EvenPicture(150);
  const RgbImage composed = ComposeInk(
      {}, {LineAlong({{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, 0.2F, half)}, picture);
  EXPECT_EQ(composed(160, 120, 1), composed(120, 120, 1));
}

TEST(ComposerInk, GoesUpAStepInOneBandAndNotUpAPole) {
  // A step of 0.2 m whose face runs at 45° to the line, seen from the south-west.
  Model wedge = MakeBox({-2, -2, 0}, {2, 2, 0.2}, 0.3F);
  for (Mesh& mesh : wedge.meshes) {
    for (auto& [x, y, z] : mesh.positions) {
      const float a = 0.7071F * (x - y), b = 0.7071F * (x + y);
      x = a + 1.5F;
      y = b;
    }
    for (auto& [x, y, z] : mesh.normals) {
      const float a = 0.7071F * (x - y), b = 0.7071F * (x + y);
      x = a;
      y = b;
    }
  }
  const PlacedModel pole = Place(MakeBox({-1.04, -0.04, 0}, {-0.96, 0.04, 1.0}, 0.3F), true);
  // From the ground onto the step, whose corner at the line is at x = −1.33.
  InkShape line;
  line.style = {{0, 0, 0}, 1.0F, InkBlend::kStain};
  line.pen.width_m = 0.3F;
  line.segments = {{{-2.5F, 0.5F, 0.0F}, {-0.828F, 0.5F, 0.0F}, 0.0F, 1.672F},
                   {{-0.828F, 0.5F, 0.0F}, {-0.828F, 0.5F, 0.2F}, 1.672F, 1.872F},
                   {{-0.828F, 0.5F, 0.2F}, {0.5F, 0.5F, 0.2F}, 1.872F, 3.2F}};
  InkScene scene{.models = {kGround, Place(wedge, true)}};
  const RgbImage picture = EvenPicture(150);
  const RgbImage composed = ComposeInk(scene, {line}, picture);
  // From above, the band has no gap where it climbs: the middle of the line and 0.1 m to its sides.
  for (const double y : {0.4, 0.5, 0.6}) {
    for (int step = 0; step < 180; ++step) {
      const double x = -1.4 + 0.01 * step;
      const double z = x - y > -1.328 ? 0.2 : 0.0;
      const int u = static_cast<int>(std::lround(159.5 + 300.0 * x / (3.0 - z)));
      const int v = static_cast<int>(std::lround(119.5 - 300.0 * y / (3.0 - z)));
      EXPECT_EQ(composed(u, v, 1), 0) << x << " " << y;
    }
  }
  line.segments = {{{-1.5F, 0.0F, 0.0F}, {-0.5F, 0.0F, 0.0F}, 0.0F, 1.0F}};
  scene.models = {kGround, pole};
  const RgbImage at_pole = ComposeInk(scene, {line}, picture);
  EXPECT_EQ(at_pole(10, 119, 1), picture(10, 119, 1)) << "on the pole's top";
  EXPECT_EQ(at_pole(90, 119, 1), 0) << "on the ground";
}

TEST(ComposerInk, StaysOffSurfacesAboveTheLine) {
  const PlacedModel table = Place(MakeBox({-0.3, -0.3, 0.7}, {0.3, 0.3, 0.75}, 0.3F), true);
  const RgbImage picture = EvenPicture(150);
  const RgbImage composed = ComposeInk(
      {.models = {kGround, table}},
      {LineAlong({{-1.2F, 0, 0}, {1.2F, 0, 0}}, 0.2F, {kRed, 1.0F, InkBlend::kStain})}, picture);
  EXPECT_EQ(composed(160, 120, 1), picture(160, 120, 1));
  EXPECT_NE(composed(60, 120, 1), picture(60, 120, 1));
}

/// A camera that looks at the marker from an elevation and a bearing.
Transform<Camera, Marker> LookingFrom(double elevation, double bearing, double distance_m) {
  const Vec3 back{std::cos(elevation) * std::sin(bearing), std::cos(elevation) * std::cos(bearing),
                  std::sin(elevation)};
  const Vec3 forward = back * -1.0;
  const Vec3 right = Normalized(Cross(forward, {0, 0, 1}));
  const Vec3 down = Cross(forward, right);
  return {{{right.x, right.y, right.z, down.x, down.y, down.z, forward.x, forward.y, forward.z}},
          {0, 0, distance_m}};
}

/// Whether a pixel's center may show ground within half a metre of the line, or the horizon.
struct GroundBelow {
  explicit GroundBelow(const Transform<Marker, Camera>& from_camera)
      : marker_from_camera(from_camera) {}
  bool IsNear(int x, int y) const {
    const Vec3 way = marker_from_camera.rotation *
                     Vec3{(x - kCamera.cx) / kCamera.fx, (y - kCamera.cy) / kCamera.fy, 1.0};
    const Vec3 eye = marker_from_camera.translation_m;
    return way.z > -0.02 || std::fabs(eye.y - way.y * eye.z / way.z) < 0.5;
  }
  Transform<Marker, Camera> marker_from_camera;
};

/// Share of a pixel on a line through the marker along x, at 8 by 8 places.
double ShareOnLine(const Transform<Camera, Marker>& camera_from_marker, int x, int y,
                   double half_width_m, double half_length_m) {
  const Transform<Marker, Camera> marker_from_camera = camera_from_marker.Inverse();
  const Vec3 eye = marker_from_camera.translation_m;
  int on_line = 0;
  for (int i = 0; i < 64; ++i) {
    const int column = i % 8, row = i / 8;
    const Vec3 ray{(x - kCamera.cx + (column + 0.5) / 8 - 0.5) / kCamera.fx,
                   (y - kCamera.cy + (row + 0.5) / 8 - 0.5) / kCamera.fy, 1.0};
    const Vec3 way = marker_from_camera.rotation * ray;
    if (way.z >= 0.0) continue;
    const Vec3 at = eye + way * (-eye.z / way.z);
    const double beyond = std::max(std::fabs(at.x) - half_length_m, 0.0);
    if (std::hypot(beyond, at.y) < half_width_m) ++on_line;
  }
  return on_line / 64.0;
}

TEST(ComposerInk, HasTheEdgesOfAHundredViewsDownToFiveDegrees) {
  constexpr double kWidth_m = 0.15, kLength_m = 3.0;
  const InkStyle black{{0.0, 0.0, 0.0}, 1.0F, InkBlend::kStain};
  const PlacedModel ground = Place(MakeBox({-40, -40, 0}, {40, 40, 0}, 0.3F), true);
  const auto composer = LitComposer({ground}, SouthernSun());
  ASSERT_TRUE(composer->SetInk(
      std::vector{LineAlong({{-1.5F, 0, 0}, {1.5F, 0, 0}}, kWidth_m, black)}, Mat3{}));
  const RgbImage picture = EvenPicture(180);
  const double before = Light(picture, 0, 0, 1);
  double squares = 0.0;
  int edges = 0, center = 0, shown = 0;
  for (int view = 0; view < 100; ++view) {
    const double elevation = (5.0 + 0.8 * view) * std::numbers::pi / 180.0;
    const auto pose = LookingFrom(elevation, 0.37 * view, 4.0);
    const auto composed = composer->Compose(CameraImageView(picture.view()), pose, kExposure);
    ASSERT_TRUE(composed);
    const GroundBelow ground_below(pose.Inverse());
    for (int y = 0; y < kCamera.height; ++y) {
      for (int x = 0; x < kCamera.width; ++x) {
        const double ink = 1.0 - Light(*composed, x, y, 1) / before;
        if (ink == 0.0 && !ground_below.IsNear(x, y)) continue;
        const double truth = ShareOnLine(pose, x, y, 0.5 * kWidth_m, 0.5 * kLength_m);
        if (truth == 0.0 && ink < 1e-3) continue;
        // A share of a pixel is the position of the edge in it.
        squares += (ink - truth) * (ink - truth);
        ++edges;
        if (ShareOnLine(pose, x, y, 0.75 * kWidth_m, 0.5 * kLength_m) == 0.0) {
          EXPECT_LT(ink, 0.02) << "outside 1.5 widths, view " << view << " at " << x << " " << y;
        }
        if (ShareOnLine(pose, x, y, 0.01, 0.49 * kLength_m) > 0.0) {
          ++center;
          shown += ink > 0.0 ? 1 : 0;
        }
      }
    }
  }
  EXPECT_LT(std::sqrt(squares / edges), 0.03);
  EXPECT_GE(shown, 0.999 * center);
  EXPECT_GT(center, 10'000);
}

TEST(ComposerInk, IsTheSameWithADistortedLensAndByPlaces) {
  CameraModel lens = kCamera;
  lens.distortion = {-0.1, 0.02};
  ComposerOptions reference;
  reference.antialiasing = {AntialiasingMethod::kReference, 4};
  const InkShape line =
      LineAlong({{-1, 0.1F, 0}, {1, -0.1F, 0}}, 0.2F, {kRed, 1.0F, InkBlend::kStain});
  const RgbImage picture = EvenPicture(150);
  const RgbImage plain = ComposeInk({}, {line}, picture);
  for (const InkScene& scene : {InkScene{.camera = lens}, InkScene{.options = reference}}) {
    const RgbImage other = ComposeInk(scene, {line}, picture);
    EXPECT_EQ(other(160, 120, 1), plain(160, 120, 1));
    EXPECT_EQ(other(160, 20, 1), picture(160, 20, 1));
  }
}

TEST(ComposerInk, TakesPensInPixels) {
  InkShape line = LineAlong({{-1, 0, 0}, {1, 0, 0}}, 0.0F, {{0, 0, 0}, 1.0F, InkBlend::kStain});
  line.pen = {.width_px = 6.0F};
  const RgbImage picture = EvenPicture(150);
  for (const double height_m : {2.0, 3.0, 4.5}) {
    InkScene scene;
    scene.camera_from_marker.translation_m.z = height_m;
    const RgbImage composed = ComposeInk(scene, {line}, picture);
    double covered = 0.0;
    for (int y = 0; y < kCamera.height; ++y) {
      covered += 1.0 - Light(composed, 160, y, 1) / Light(picture, 160, y, 1);
    }
    EXPECT_NEAR(covered, 6.0, 0.1) << height_m;
  }
}

}  // namespace
}  // namespace pleinair::compositor
