// The skies' shader twins on the graphics processor (or Mesa's software one) against the C++.

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/shader_library.h"
#include "sky/atmosphere/aerial_perspective.h"
#include "sky/atmosphere/atmosphere.h"
#include "sky/cie_sky.h"
#include "sky/perez.h"
#include "tests/gl/gl_fixture.h"
#include "tests/sky/sky_twin_cases.h"
#include "tests/source_tree.h"

namespace pleinair::sky {
namespace {

std::string ReadSource(const std::string& name) {
  std::ifstream file(tests::SourceTree() / name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

glm::vec3 ToGlm(Vec3 v) { return {v.x, v.y, v.z}; }
glm::vec3 ToGlm(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

using Vec4 = std::array<float, 4>;
Vec4 Padded(const std::array<float, 3>& a) { return {a[0], a[1], a[2], 0.0F}; }

class SkyOnTheGpu : public gl::GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    static const std::array<std::string, 7> kNames = {
        "tests/sky/sky_twins.comp",        "sky/shaders/sky_angles.glsl",
        "sky/shaders/sky_color.glsl",      "sky/shaders/sky_perez.glsl",
        "sky/shaders/sky_atmosphere.glsl", "sky/shaders/sky_cie.glsl",
        "sky/shaders/sky_clouds.glsl"};
    static const auto kTexts = [] {
      std::array<std::string, kNames.size()> texts;
      for (std::size_t i = 0; i < kNames.size(); ++i) texts[i] = ReadSource(kNames[i]);
      return texts;
    }();
    std::vector<gl::EmbeddedShader> shaders;
    for (std::size_t i = 0; i < kNames.size(); ++i) shaders.push_back({kNames[i], kTexts[i]});
    gl::ShaderLibrary::Register(shaders);
    auto program = gl::GlProgram::Create({.compute = kNames[0]});
    ASSERT_TRUE(program.has_value()) << program.error().Message();
    program_ = std::move(*program);
    SetNodes(2, {});
    SetNodes(3, {});
  }

  void SetNodes(int binding, std::vector<Vec4> nodes) {
    if (nodes.empty()) nodes.resize(1);
    auto buffer = gl::GlBuffer::FromSpan(std::span<const Vec4>(nodes));
    ASSERT_TRUE(buffer.has_value());
    buffer->BindBase(GL_SHADER_STORAGE_BUFFER, binding);
    buffers_.push_back(std::move(*buffer));
  }

  template <typename Node, typename First, typename Second>
  static std::vector<Vec4> Interleaved(const std::vector<Node>& nodes, First first, Second second) {
    std::vector<Vec4> result;
    for (const Node& node : nodes) {
      result.push_back(Padded(node.*first));
      result.push_back(Padded(node.*second));
    }
    return result;
  }

  std::vector<Vec4> Ask(int model, Vec3 to_sun, const std::vector<Vec3>& directions,
                        float distance = 0.0F) {
    std::vector<Vec4> queries;
    queries.reserve(directions.size());
    for (const Vec3& d : directions) {
      queries.push_back(
          {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z), distance});
    }
    auto in = gl::GlBuffer::FromSpan(std::span<const Vec4>(queries));
    auto out = gl::GlBuffer::FromSpan(std::span<const Vec4>(queries));
    EXPECT_TRUE(in.has_value() && out.has_value());
    in->BindBase(GL_SHADER_STORAGE_BUFFER, 0);
    out->BindBase(GL_SHADER_STORAGE_BUFFER, 1);
    program_.Set("count", static_cast<int>(queries.size()));
    program_.Set("model", model);
    program_.Set("to_sun", ToGlm(to_sun));
    program_.Use();
    glDispatchCompute(static_cast<GLuint>(queries.size() + 63) / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    out->Download(queries.data(), queries.size() * sizeof(Vec4));
    return queries;
  }

  gl::GlProgram program_;
  std::vector<gl::GlBuffer> buffers_;
};

TEST_F(SkyOnTheGpu, EqualsPerezWithinOneInTenThousand) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<float> turbidities(1.0F, 11.0F);
  for (int i = 0; i < 60; ++i) {
    const float turbidity = turbidities(random);
    const Vec3 to_sun = RoundedToFloat(RandomDirection(random, -0.3));
    const std::vector<Vec3> directions = DirectionsAbout(to_sun, 200, random);
    program_.Set("turbidity", turbidity);
    const std::vector<Vec4> got = Ask(0, to_sun, directions);
    const PerezSky sky(turbidity, {to_sun});
    for (std::size_t j = 0; j < got.size(); ++j) {
      ASSERT_LT(RelativeDifference(sky.Radiance({directions[j]}), got[j][0], got[j][1], got[j][2]),
                1e-4)
          << "turbidity " << turbidity << " sun z " << to_sun.z << " view z " << directions[j].z;
    }
  }
}

TEST_F(SkyOnTheGpu, EqualsTheCieSkiesWithinOneInTenThousand) {
  std::mt19937_64 random(22);
  for (int type = 1; type <= 15; ++type) {
    for (int i = 0; i < 4; ++i) {
      const Vec3 to_sun = RoundedToFloat(RandomDirection(random, -0.3));
      const std::vector<Vec3> directions = DirectionsAbout(to_sun, 200, random);
      const std::vector<Vec4> got = Ask(type, to_sun, directions);
      const CieSky sky(type, {to_sun});
      for (std::size_t j = 0; j < got.size(); ++j) {
        ASSERT_NEAR(got[j][0] / sky.RelativeLuminance({directions[j]}), 1.0, 1e-4)
            << "type " << type << " sun z " << to_sun.z << " view z " << directions[j].z;
      }
    }
  }
}

TEST_F(SkyOnTheGpu, EqualsTheAtmosphereWithinOneInTenThousand) {
  std::mt19937_64 random(23);
  for (const double turbidity : {1.5, 8.0}) {
    const auto tables =
        std::make_shared<const AtmosphereTables>(AerosolOfTurbidity(turbidity), 0.15);
    for (int i = 0; i < 10; ++i) {
      const Vec3 to_sun = RoundedToFloat(RandomDirection(random, -0.3));
      const AtmosphereSky sky(tables, {to_sun}, 1.0);
      SetNodes(2, Interleaved(sky.nodes(), &AtmosphereSky::Node::scattered,
                              &AtmosphereSky::Node::aerosol));
      program_.Set("asymmetry", static_cast<float>(sky.asymmetry()));
      const std::vector<Vec3> directions = DirectionsAbout(to_sun, 400, random);
      const std::vector<Vec4> got = Ask(16, to_sun, directions);
      for (std::size_t j = 0; j < got.size(); ++j) {
        const LinearRgb expected = RgbFromXyY(XyYFromXyz(sky.Xyz({directions[j]})));
        ASSERT_LT(RelativeDifference(expected, got[j][0], got[j][1], got[j][2]), 1e-4)
            << "turbidity " << turbidity << " sun z " << to_sun.z << " view z " << directions[j].z;
      }
    }
  }
}

TEST_F(SkyOnTheGpu, EqualsTheAirWithinOneInTenThousand) {
  std::mt19937_64 random(24);
  const AtmosphereTables tables(AerosolOfTurbidity(3.0), 0.15);
  for (int i = 0; i < 10; ++i) {
    const Vec3 to_sun = RoundedToFloat(RandomDirection(random, 0.0));
    const AerialPerspective air(tables, {to_sun}, 1.0);
    const AerialPerspective::Constants& c = air.constants();
    SetNodes(3, Interleaved(air.nodes(), &AerialPerspective::Node::molecules,
                            &AerialPerspective::Node::aerosol));
    program_.Set("asymmetry", c.asymmetry);
    program_.Set("sun_on_aerosol", ToGlm(c.sun_on_aerosol));
    program_.Set("molecule_extinction", ToGlm(c.molecule_extinction));
    program_.Set("aerosol_extinction", ToGlm(c.aerosol_extinction));
    program_.Set("aerosol_scale_height", c.aerosol_scale_height);
    for (const float distance : {30.0F, 1'000.0F, 30'000.0F}) {
      const std::vector<Vec3> directions = DirectionsAbout(to_sun, 200, random);
      const std::vector<Vec4> got = Ask(17, to_sun, directions, distance);
      for (std::size_t j = 0; j < got.size(); ++j) {
        ASSERT_LT(RelativeDifference(air.Inscattered({directions[j]}, Metres(distance)), got[j][0],
                                     got[j][1], got[j][2]),
                  1e-4)
            << distance << " m, sun z " << to_sun.z << " view z " << directions[j].z;
      }
    }
  }
}

TEST_F(SkyOnTheGpu, EqualsTheCloudsWithinOneInTenThousand) {
  std::mt19937_64 random(25);
  for (int i = 0; i < 60; ++i) {
    const CloudCase c = RandomCloudCase(random, i);
    const Clouds clouds = c.Create();
    program_.Set("cover", static_cast<float>(c.cover));
    program_.Set("clear_lux", glm::vec2(c.clear_sky.g, c.clear_sun.g));
    program_.Set("illuminance_over_zenith", glm::vec2(clouds.lower().IlluminanceOverZenith(),
                                                      clouds.upper().IlluminanceOverZenith()));
    const std::vector<Vec3> directions = DirectionsAbout(c.to_sun, 200, random);
    const std::vector<Vec4> got = Ask(18, c.to_sun, directions);
    for (std::size_t j = 0; j < got.size(); ++j) {
      const LinearRgb expected = clouds.Radiance({directions[j]}, ClearBehindClouds(directions[j]));
      ASSERT_LT(RelativeDifference(expected, got[j][0], got[j][1], got[j][2]), 1e-4)
          << "cover " << c.cover << " sun z " << c.to_sun.z << " view z " << directions[j].z;
    }
  }
}

}  // namespace
}  // namespace pleinair::sky
