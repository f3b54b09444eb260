// Pure shader code compiled as C++ and compared with what it is the twin of.

#include <gtest/gtest.h>

#include "base/srgb.h"
#include "gl/glsl_as_cpp.h"

namespace glsl {
using namespace glm;  // NOLINT(google-build-using-namespace): as GLSL has it.
#include "compositor/shaders/differential.glsl"
#include "compositor/shaders/srgb_transfer.glsl"
}  // namespace glsl

namespace pleinair::compositor {
namespace {

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
  // A shadow map's rounding may claim more sun with the objects than without.
  EXPECT_EQ(glsl::DifferentialRatio(ambient, ambient, sun, 1.0F, 0.3F), glm::vec3(1.0F));
}

}  // namespace
}  // namespace pleinair::compositor
