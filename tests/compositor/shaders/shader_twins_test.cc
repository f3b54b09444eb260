// Compares shader code, compiled as C++, with its C++ counterpart.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/srgb.h"
#include "compositor/passes/aerial_fog.h"
#include "compositor/passes/shadow_ratio_pass.h"
#include "compositor/surfaces/linear_shadow_ratio.h"
#include "compositor/surfaces/material_table.h"
#include "compositor/surfaces/visibility_buffer.h"
#include "gl/glsl_as_cpp.h"

namespace glsl {
using namespace glm;  // NOLINT(google-build-using-namespace): as GLSL has it.
#include "compositor/shaders/aerial_fog.glsl"
#include "compositor/shaders/differential.glsl"
#include "compositor/shaders/linear_shadow_ratio.glsl"
#include "compositor/shaders/plane_hit.glsl"
#include "compositor/shaders/srgb_transfer.glsl"
#include "compositor/shaders/surface_gradient.glsl"
#include "compositor/shaders/texel_code.glsl"
#include "compositor/shaders/visibility_buffer_layout.glsl"
}  // namespace glsl

namespace pleinair::compositor {
namespace {

/// Homogeneous air: transmits e^−kd of a surface's light and adds airlight for the rest.
class EvenAir : public sky::SkyModel {
 public:
  LinearRgb SkyRadiance(Direction<World>) const override { return {}; }
  LinearRgb SunNormalIrradiance() const override { return {}; }
  LinearRgb SkyHorizontalIrradiance() const override { return {}; }
  Direction<World> ToSun() const override { return {{0, 0, 1}}; }
  AirBetween AirTo(Direction<World>, Metres distance) const override {
    const auto left = [&](double k) { return std::exp(-k * distance.value()); };
    const LinearRgb t{left(kRed), left(kGreen), left(kBlue)};
    return {t, LinearRgb{1.0 - t.r, 1.0 - t.g, 1.0 - t.b} * kAirlight};
  }
  static constexpr double kRed = 0.0008, kGreen = 0.001, kBlue = 0.0015, kAirlight = 5000.0;
};

TEST(AerialFog, AddsNoMoreLightAMetreThanItSays) {
  const FogSplits fog = AerialFog(EvenAir(), Mat3{})
                            .Along({0, 1, 0}, std::vector<double>{2.0, 60.0, 250.0, 1500.0},
                                   std::vector<double>{1.0, 3.0, 0.5});
  const glm::vec3 most = fog.MaxLightPerMetre();
  EXPECT_LT(most.g, 4.0 * EvenAir::kGreen * EvenAir::kAirlight) << "nor much less";
  glm::vec3 before(0.0F);
  for (int metre = 1; metre <= 1600; ++metre) {
    const glm::vec3 light = glsl::FogUpTo(static_cast<float>(metre), fog.distance_m.data(),
                                          fog.optical_depth.data(), fog.inscattered.data())
                                .light;
    for (int c = 0; c < 3; ++c) EXPECT_LE(light[c] - before[c], 1.001F * most[c]) << metre;
    before = light;
  }
}

glm::vec3 Through(const FogSplits& fog, float distance_m) {
  const glsl::FogAir air = glsl::FogUpTo(distance_m, fog.distance_m.data(),
                                         fog.optical_depth.data(), fog.inscattered.data());
  return 1000.0F * air.left + air.light;
}

TEST(AerialFog, IsTheSkysOwnAtAndBetweenTheSplits) {
  const FogSplits fog = AerialFog(EvenAir(), Mat3{})
                            .Along({0, 1, 0}, std::vector<double>{2.0, 60.0, 250.0, 1500.0},
                                   std::vector<double>{1.0, 1.0, 1.0});
  for (const double distance : {0.0, 1.0, 2.0, 30.0, 60.0, 100.0, 250.0, 700.0, 1500.0}) {
    const double left = std::exp(-EvenAir::kGreen * distance);
    const double expected = 1000.0 * left + EvenAir::kAirlight * (1.0 - left);
    EXPECT_NEAR(Through(fog, static_cast<float>(distance)).g, expected, 0.01 * expected)
        << distance;
  }
}

TEST(AerialFog, OfDifferentPartitionsDoesNotJumpAtTheirSplits) {
  const std::vector<double> splits{2.0, 60.0, 250.0, 1500.0};
  const FogSplits fog = AerialFog(EvenAir(), Mat3{})
                            .Along({0.6, 0.8, 0}, splits, std::vector<double>{0.0, 20.0, 1.0});
  for (const double split : splits) {
    const auto at = static_cast<float>(split);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(Through(fog, at * 0.99999F)[c], Through(fog, at * 1.00001F)[c], 0.5F) << split;
    }
  }
  // No air in the first partition, twenty times the density in the second.
  EXPECT_NEAR(Through(fog, 60.0F).r, 1000.0F, 0.1F);
  const double left = std::exp(-EvenAir::kRed * 20.0 * 190.0);
  EXPECT_NEAR(Through(fog, 250.0F).r, 1000.0 * left + EvenAir::kAirlight * (1.0 - left), 60.0);
  float last = 0.0F;
  for (int distance_m = 0; distance_m < 2000; ++distance_m) {
    const float through = Through(fog, static_cast<float>(distance_m)).b;
    EXPECT_GE(through, last - 0.01F);
    last = through;
  }
}

TEST(AerialFog, FadesAVirtualShadowAsARealOne) {
  const glm::vec3 lit(0.4F), ratio(0.25F);
  for (const float distance : {5.0F, 200.0F, 3000.0F}) {
    const FogSplits fog = AerialFog(EvenAir(), Mat3{})
                              .Along({0, 1, 0}, std::vector<double>{2.0, 60.0, 4000.0},
                                     std::vector<double>{1.0, 1.0});
    const glsl::FogAir air = glsl::FogUpTo(distance, fog.distance_m.data(),
                                           fog.optical_depth.data(), fog.inscattered.data());
    const glm::vec3 air_light = air.light / 10000.0F;
    const glm::vec3 picture = lit * air.left + air_light;
    const glm::vec3 real_shadow = ratio * lit * air.left + air_light;
    const glm::vec3 shadow = ratio * picture + glsl::AirlightOverShadow(ratio, air_light, picture);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shadow[c], real_shadow[c], 1e-6) << distance;
  }
}

TEST(AerialFog, NeverLightsAShadowUpBeyondThePicture) {
  const glm::vec3 ratio(0.25F), picture(0.1F), air_light(0.7F);
  const glm::vec3 shadow = ratio * picture + glsl::AirlightOverShadow(ratio, air_light, picture);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(shadow[c], picture[c], 1e-7);
}

TEST(AerialFog, IsNoneWithoutAir) {
  const FogSplits fog =
      AerialFog().Along({0, 1, 0}, std::vector<double>{1.0, 100.0}, std::vector<double>{1.0});
  EXPECT_EQ(Through(fog, 50.0F), glm::vec3(1000.0F));
}

TEST(SrgbShader, AgreesWithTheTransferFunctionOfBase) {
  for (int code = 0; code <= 255; ++code) {
    const double encoded = code / 255.0;
    const glm::vec3 linear = glsl::LinearFromSrgb(glm::vec3(encoded));
    EXPECT_NEAR(linear.x, LinearFromSrgb(encoded), 1e-6);
    EXPECT_NEAR(glsl::SrgbFromLinear(linear).x, encoded, 1e-6);
  }
}

TEST(SrgbShader, ClipsToTheRangeOfThePicture) {
  const glm::vec3 encoded = glsl::SrgbFromLinear(glm::vec3(-0.5F, 0.0F, 3.0F));
  EXPECT_EQ(encoded.x, 0.0F);
  EXPECT_EQ(encoded.y, 0.0F);
  EXPECT_NEAR(encoded.z, 1.0F, 1e-6);
}

TEST(DifferentialRatio, IsExactlyOneWhereTheObjectsChangeNothing) {
  const glm::vec3 ambient(1234.5F, 2345.6F, 3456.7F), sun(65432.1F, 54321.0F, 43210.9F);
  for (const float visibility : {0.0F, 0.37F, 1.0F}) {
    EXPECT_EQ(glsl::DifferentialRatio(ambient, ambient, sun, visibility, visibility),
              glm::vec3(1.0F));
  }
}

TEST(DifferentialRatio, DarkensToTheSkysShareInANewShadow) {
  const glm::vec3 ratio =
      glsl::DifferentialRatio(glm::vec3(20.0F), glm::vec3(20.0F), glm::vec3(80.0F), 0.0F, 1.0F);
  EXPECT_NEAR(ratio.x, 0.2F, 1e-6);
}

TEST(DifferentialRatio, NeverDarkensARealShadowTwiceNorLightensIt) {
  const glm::vec3 ambient(20.0F), sun(80.0F);
  EXPECT_EQ(glsl::DifferentialRatio(ambient, ambient, sun, 0.0F, 0.0F), glm::vec3(1.0F));
  // Because of rounding, a shadow map may report more sun with the objects than without.
  EXPECT_EQ(glsl::DifferentialRatio(ambient, ambient, sun, 1.0F, 0.3F), glm::vec3(1.0F));
}

TEST(LinearShadowRatio, IsTheDifferentialRatioWhereObjectsTakeNothingOfTheSun) {
  const glm::vec3 with(900.0F, 800.0F, 700.0F), without(1000.0F, 1100.0F, 1200.0F),
      sun(3000.0F, 2000.0F, 1000.0F);
  for (const float visibility : {0.0F, 1.0F}) {
    const glm::vec3 ratio = glsl::DifferentialRatio(with, without, sun, visibility, visibility);
    EXPECT_LT(glm::distance(LinearShadowRatio::Between(with, without, visibility * sun), ratio),
              1e-6F);
  }
}

glm::vec3 LinearRatioSeen(const LinearShadowRatio& linear_ratio, const glm::vec3& eye_m,
                          const glm::vec3& ray) {
  return glsl::LinearRatioAlong(eye_m, ray, linear_ratio.plane, linear_ratio.channels[0],
                                linear_ratio.channels[1], linear_ratio.channels[2],
                                linear_ratio.range)
      .ratio;
}

TEST(LinearShadowRatio, IsLinearOverATriangleWhereverItLies) {
  const std::array<glm::vec3, 3> ratios{glm::vec3(0.5F, 0.6F, 0.7F), glm::vec3(0.9F, 0.8F, 1.0F),
                                        glm::vec3(1.1F, 0.95F, 0.75F)};
  // A hand's width, tilted and far from the origin, and a large distance.
  for (const glm::vec3& at : {glm::vec3(0.0F), glm::vec3(30.0F, -20.0F, 5.0F)}) {
    const std::array<glm::vec3, 3> corners{at, at + glm::vec3(0.1F, 0.02F, 0.01F),
                                           at + glm::vec3(-0.01F, 0.08F, 0.05F)};
    const LinearShadowRatio linear_ratio = LinearShadowRatio::Of(corners, ratios);
    const glm::vec3 eye_m = at + glm::vec3(0.5F, -1.0F, 1.5F);
    for (const glm::vec3& share : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1),
                                   glm::vec3(0.2F, 0.5F, 0.3F)}) {
      const glm::vec3 place = corners[0] * share.x + corners[1] * share.y + corners[2] * share.z;
      const glm::vec3 ratio = ratios[0] * share.x + ratios[1] * share.y + ratios[2] * share.z;
      EXPECT_LT(glm::distance(LinearRatioSeen(linear_ratio, eye_m, 3.0F * (place - eye_m)), ratio),
                1e-3F);
      const glsl::LinearRatioPoint seen = glsl::LinearRatioAlong(
          eye_m, place - eye_m, linear_ratio.plane, linear_ratio.channels[0],
          linear_ratio.channels[1], linear_ratio.channels[2], linear_ratio.range);
      EXPECT_LT(glm::distance(seen.position_m, place), 1e-4F);
    }
  }
}

TEST(LinearShadowRatio, KeepsWithinItsCornersBesideTheTriangle) {
  const std::array<glm::vec3, 3> corners{glm::vec3(0.0F), glm::vec3(0.1F, 0.0F, 0.0F),
                                         glm::vec3(0.0F, 0.1F, 0.0F)};
  const std::array<glm::vec3, 3> ratios{glm::vec3(0.5F), glm::vec3(0.9F), glm::vec3(0.7F)};
  const LinearShadowRatio linear_ratio = LinearShadowRatio::Of(corners, ratios);
  const glm::vec3 eye_m(0.0F, 0.0F, 1.0F);
  // Beside the triangle, along its plane, away from it, and straight up.
  for (const glm::vec3& ray : {glm::vec3(5.0F, 0.0F, -1.0F), glm::vec3(1.0F, 0.0F, 0.0F),
                               glm::vec3(-1.0F, 0.0F, 1e-9F), glm::vec3(0.0F, 0.0F, 1.0F)}) {
    const glm::vec3 seen = LinearRatioSeen(linear_ratio, eye_m, ray);
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(seen[c], 0.5F);
      EXPECT_LE(seen[c], 0.9F);
    }
  }
  // Three collinear corners.
  const LinearShadowRatio thin =
      LinearShadowRatio::Of({corners[0], corners[1], 2.0F * corners[1]}, ratios);
  EXPECT_NEAR(LinearRatioSeen(thin, eye_m, {0.0F, 0.0F, -1.0F}).x, 0.7F, 1e-6F);
}

TEST(TexelCode, KeepsRoughnessAndMetallicApart) {
  for (int i = 0; i <= 127; ++i) {
    for (int k = 0; k <= 15; ++k) {
      const float roughness = static_cast<float>(i) / 127.0F, metallic = static_cast<float>(k) / 15;
      const float code = glsl::CodeOfCoat(roughness, metallic);
      // Integers up to this value are exact in 16 bits.
      EXPECT_LT(code, 2048.0F);
      EXPECT_NEAR(glsl::CoatOfCode(code).x, roughness, 1e-6);
      EXPECT_NEAR(glsl::CoatOfCode(code).y, metallic, 1e-6);
    }
  }
}

TEST(TexelCode, KeepsTheAlphaOfBlendedSurfaces) {
  EXPECT_EQ(glsl::AlphaOfCode(glsl::CodeOfCoat(0.0F, 0.0F)), 1.0F);
  for (int i = 0; i <= 127; ++i) {
    for (const float roughness : {0.0F, 3.0F / 7.0F, 1.0F}) {
      for (const float metallic : {0.0F, 1.0F}) {
        const float alpha = static_cast<float>(i) / 127.0F;
        const float code = glsl::CodeOfBlended(roughness, metallic, alpha);
        EXPECT_GE(code, -2048.0F);
        EXPECT_NEAR(glsl::AlphaOfCode(code), alpha, 1e-6);
        EXPECT_NEAR(glsl::CoatOfCode(code).x, roughness, 1e-6);
        EXPECT_NEAR(glsl::CoatOfCode(code).y, metallic, 1e-6);
      }
    }
  }
}

TEST(SurfaceGradient, TiltsTheNormalAsTheMapSays) {
  // A surface that faces +z, seen at any scale and from any side, with u along x and v against y.
  const glm::vec3 bump = glm::normalize(glm::vec3(0.3F, 0.4F, 1.0F));
  for (const float scale : {1e-3F, 1.0F}) {
    for (const float mirror : {-1.0F, 1.0F}) {  // Image rows run up or down.
      const glm::vec3 x = scale * glm::vec3(2.0F, 0.5F, 0.0F);
      const glm::vec3 y = mirror * scale * glm::vec3(-0.5F, 1.0F, 0.0F);
      const glm::vec3 gradient =
          glsl::SurfaceGradient(bump, x, y, glm::vec2(x.x, -x.y), glm::vec2(y.x, -y.y));
      const glm::vec3 normal = glsl::BumpedNormal({0.0F, 0.0F, 1.0F}, gradient);
      EXPECT_NEAR(glm::length(normal - bump), 0.0F, 1e-5F) << scale << mirror;
      // A mirrored texture: u against x. Its right is west, its top stays north.
      const glm::vec3 mirrored = glsl::BumpedNormal(
          {0.0F, 0.0F, 1.0F},
          glsl::SurfaceGradient(bump, x, y, glm::vec2(-x.x, -x.y), glm::vec2(-y.x, -y.y)));
      EXPECT_NEAR(glm::length(mirrored - glm::vec3(-bump.x, bump.y, bump.z)), 0.0F, 1e-5F);
    }
  }
  EXPECT_EQ(glsl::SurfaceGradient(bump, {1, 0, 0}, {0, 1, 0}, glm::vec2(0.0F), glm::vec2(0.0F)),
            glm::vec3(0.0F))
      << "without texture coordinates";
}

TEST(TriangleLayout, IsReadAsItIsWritten) {
  EXPECT_EQ(glsl::kTrianglesPerRow, VisibilityBuffer::kTrianglesPerRow);
  EXPECT_EQ(glsl::kVerticesPerRow, VisibilityBuffer::kVerticesPerRow);
  EXPECT_EQ(glsl::kTexelsPerVertex, VisibilityBuffer::kTexelsPerVertex);
  EXPECT_EQ(glsl::kKindBits, static_cast<int>(VisibilityBuffer::kKindBits));
  EXPECT_EQ(glsl::kNothing, static_cast<unsigned>(AffectedTriangles::kNothing));
  EXPECT_EQ(glsl::kTexelsPerSurface, MaterialTable::kTexelsPerSurface);
  EXPECT_EQ(glsl::kSurfacesPerRow, MaterialTable::kSurfacesPerRow);
  EXPECT_EQ(glsl::kTexelsPerLinearRatio, LinearShadowRatio::kTexels);
  EXPECT_EQ(sizeof(LinearShadowRatio), LinearShadowRatio::kTexels * 4 * sizeof(float));
  EXPECT_EQ(glsl::kLinearRatiosPerRow, VisibilityBuffer::kLinearRatiosPerRow);
  for (const auto change : {AffectedTriangles::kSun, AffectedTriangles::kSunlitSky,
                            AffectedTriangles::kLinearSky, AffectedTriangles::kNothing}) {
    const glm::uvec4 triangle(0, 0, 0, change | 12345U << VisibilityBuffer::kKindBits);
    EXPECT_EQ(glsl::KindOf(triangle), static_cast<unsigned>(change));
    EXPECT_EQ(glsl::ComponentOf(triangle), 12345U);
    EXPECT_EQ(glsl::DepthOfKind(change), ShadowRatioPass::DepthOf(change));
  }
}

TEST(TriangleLayout, GivesEachTriangleAndVertexTexelsOfItsOwn) {
  EXPECT_EQ(glsl::TexelOfTriangle(0), glm::ivec2(0, 0));
  EXPECT_EQ(glsl::TexelOfTriangle(4095), glm::ivec2(4095, 0));
  EXPECT_EQ(glsl::TexelOfTriangle(4096), glm::ivec2(0, 1));
  EXPECT_EQ(glsl::TexelOfVertex(1364), glm::ivec2(4092, 0));
  EXPECT_EQ(glsl::TexelOfVertex(1365), glm::ivec2(0, 1));
  EXPECT_EQ(glsl::TexelOfSurface(511), glm::ivec2(5621, 0));
  EXPECT_EQ(glsl::TexelOfSurface(512), glm::ivec2(0, 1));
}

TEST(TriangleLayout, ReportsTheSamplesThatShowATriangle) {
  constexpr unsigned kMax = (1U << glsl::kSamplesShift) - 1U;
  for (const unsigned id : {1U, 70000U, kMax}) {
    // The first sample contributes the id; further samples of the same triangle contribute only
    // their bits.
    const unsigned seen =
        glsl::VisibleTriangle(id, {0, 0, 1, 0}) + glsl::VisibleTriangle(0U, {1, 0, 0, 1});
    EXPECT_EQ(glsl::IdOf(seen), id);
    EXPECT_EQ(glsl::SamplesOf(seen), glm::vec4(1.0F, 0.0F, 1.0F, 1.0F));
  }
  // Triangle ids never use the bit that distinguishes objects from real surfaces.
  EXPECT_LT(kMax, glsl::kObjectBit);
}

/// Level ground 1.5 m below the eye, 10 m to 20 km ahead. The camera with f = 500 looks along +y;
/// the ray is `above` pixels above the horizon.
glsl::PlaneHit HitGround(float above) {
  const glm::vec3 a(-100.0F, 10.0F, -1.5F), b(100.0F, 10.0F, -1.5F), c(0.0F, 20000.0F, -1.5F);
  return glsl::HitPlane(glm::cross(b - a, c - a), a, b, c, {0.0F, 1.0F, above / 500.0F},
                        {0.002F, 0.0F, 0.0F}, {0.0F, 0.0F, -0.002F});
}

TEST(PlaneHit, IsWhereTheRayMeetsTheGround) {
  const glsl::PlaneHit hit = HitGround(-10.0F);
  EXPECT_NEAR(hit.along, 75.0F, 1e-3F);
  // One pixel lower: 1.5 m · 500 / 11.
  const float next = HitGround(-11.0F).along;
  EXPECT_NEAR(next, 750.0F / 11.0F, 1e-3F);
  EXPECT_NEAR(hit.step_x.x, 75.0F * 0.002F, 1e-4F);
  EXPECT_NEAR(hit.step_y.y, -7.5F, 1e-3F);  // ∂/∂pixel of 750 / above.
  EXPECT_NEAR(hit.step_y.z, 0.0F, 1e-4F);
}

TEST(PlaneHit, StaysBeforeTheEyeWhereTheRayRunsAboveThePlanesHorizon) {
  for (const float above : {0.0F, 1e-6F, 0.01F, 0.4F, -1e-8F}) {
    const glsl::PlaneHit hit = HitGround(above);
    EXPECT_NEAR(hit.along, 20000.0F, 1.0F) << above;
    // Footprint of one pixel at that distance: 20 km / 500.
    EXPECT_NEAR(glm::length(hit.step_x), 40.0F, 0.1F) << above;
    EXPECT_NEAR(glm::length(hit.step_y), 40.0F, 0.1F) << above;
  }
}

}  // namespace
}  // namespace pleinair::compositor
