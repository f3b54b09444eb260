// Compiles every program from source and expects no driver messages. This needs its own test
// program: Mesa reports warnings only for shaders that its disk cache lacks. It reads once per
// process whether to use that cache.
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "compositor/embedded_shaders.h"
#include "compositor/lens/lens_views.h"
#include "compositor/lens/real_occluders.h"
#include "compositor/passes/coverage_pass.h"
#include "compositor/passes/object_pass.h"
#include "compositor/passes/place_mean.h"
#include "compositor/passes/shadow_debug_view.h"
#include "compositor/passes/shadow_ratio_pass.h"
#include "compositor/passes/surface_programs.h"
#include "compositor/picture/camera_picture.h"
#include "shadows/embedded_shaders.h"
#include "shadows/fading_shadow_maps.h"
#include "shadows/shadow_method.h"
#include "tests/gl/gl_fixture.h"

namespace pleinair::compositor {
namespace {

using shadows::ShadowMapOptions;
using shadows::SunDiscFilter;

class ShaderWarnings : public gl::GlTest {
 protected:
  static void SetUpTestSuite() {
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    RegisterShaders();
    shadows::RegisterShaders();
  }
};

// The smallest valid maps: only their programs matter.
ShadowMapOptions SmallMaps(shadows::ShadowMethod method) {
  return shadows::CommonOptions(method, 64);
}

template <typename T>
void ExpectCreated(const Result<T>& result) {
  EXPECT_TRUE(result.has_value()) << result.error().Message();
}

TEST_F(ShaderWarnings, AreNoneOfShadowMethods) {
  for (const shadows::ShadowMethodTraits& traits : shadows::ShadowMethods()) {
    SCOPED_TRACE(traits.name);
    const ShadowMapOptions options = SmallMaps(traits.method);
    ExpectCreated(shadows::FadingShadowMaps::Create(options));
    for (const bool fades : {false, true}) {
      ExpectCreated(SurfacePrograms::Create(options, {.fades = fades, .needs_airlight = true}));
    }
  }
}

TEST_F(ShaderWarnings, AreNoneOfTheLens) {
  ExpectCreated(LensViews::Create(16, 16));
  ExpectCreated(RealOccluders::Create(16, 16));
}

TEST_F(ShaderWarnings, AreNoneOfSurfaces) {
  ShadowMapOptions options = SmallMaps(shadows::ShadowMethod::kSunDisc);
  for (const SunDiscFilter filter :
       {SunDiscFilter::kFull, SunDiscFilter::kBox, SunDiscFilter::kSample}) {
    options.sun_disc_filter = filter;
    ExpectCreated(shadows::ShadowMaps::Create(options));
    for (const bool needs_airlight : {false, true}) {
      for (const bool textured : {false, true}) {
        for (const bool glossy : {false, true}) {
          ExpectCreated(SurfacePrograms::Create(options, {.needs_airlight = needs_airlight,
                                                          .textured = textured,
                                                          .blended = textured && glossy,
                                                          .glossy = glossy}));
        }
      }
      ExpectCreated(SurfacePrograms::Create(options, {.needs_airlight = needs_airlight,
                                                      .textured = true,
                                                      .blended = needs_airlight,
                                                      .detailed = true,
                                                      .translucent = true,
                                                      .glossy = true}));
    }
  }
}

TEST_F(ShaderWarnings, AreNoneOfPassesAndPicture) {
  for (const bool detailed : {false, true}) {
    for (const bool by_places : {false, true}) {
      ExpectCreated(ObjectPass::Create(detailed, by_places));
    }
  }
  for (const bool textured : {false, true}) ExpectCreated(CoveragePass::Create(4, textured));
  ExpectCreated(PlaceMean::Create(32, 24, {AntialiasingMethod::kReference, 4}));
  for (const bool blended : {false, true}) ExpectCreated(ShadowRatioPass::Create(blended));
  ExpectCreated(ShadowDebugView::Create(SmallMaps(shadows::ShadowMethod::kSunDisc), 32, 24));
  const CameraModel camera{.width = 32, .height = 24, .fx = 30, .fy = 30, .cx = 15.5, .cy = 11.5};
  const RenderCamera render = FitRenderCamera(camera, 1.0);
  for (const bool stated : {false, true}) {
    const std::vector<double> ends{0.0, 1.0};
    const CameraResponse response =
        stated ? CameraResponse::FromSamples(ends, {ends, ends, ends}).value() : CameraResponse();
    ExpectCreated(CameraPicture::Create(camera, render, 1.0, response));
  }
}

// Control: the tests above must not pass because nothing is reported.
TEST_F(ShaderWarnings, AreReported) {
  ExpectCreated(
      gl::GlProgram::FromText({{GL_FRAGMENT_SHADER,
                                "#version 450 core\n"
                                "layout(location = 0) out vec2 bounds;\n"
                                "void Include(vec2 v) { bounds = min(bounds, v); }\n"
                                "void main() { bounds = vec2(1); Include(gl_FragCoord.xy); }\n",
                                "warned"}}));
  EXPECT_FALSE(context_->TakeErrors().empty());
}

}  // namespace
}  // namespace pleinair::compositor
