// Measures every shadow method in the bench's own scenes and prints one JSON line each, in
// milliseconds. For the paper's Table 1 (ratios to the plain map) on a GPU.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "gl/egl_context.h"
#include "shadows/bench/bench_renderer.h"
#include "shadows/bench/bench_scene.h"

namespace pleinair::shadows {
namespace {

constexpr int kFrames = 50;

Result<void> Run(int width, int height) {
  PLEINAIR_ASSIGN_OR_RETURN(const gl::EglContext context, gl::EglContext::Create());
  std::fprintf(stderr, "%s\n", context.info().renderer.c_str());
  const double aspect = static_cast<double>(width) / height;
  const std::vector<BenchScene> scenes{PoleAndBoxScene(aspect), TreesScene(aspect),
                                       WideFieldScene(aspect)};
  for (const BenchScene& scene : scenes) {
    PLEINAIR_ASSIGN_OR_RETURN(BenchRenderer renderer, BenchRenderer::Create(scene, width, height));
    PLEINAIR_ASSIGN_OR_RETURN(const View view, renderer.Tightened(scene.view));
    for (const int resolution : {512, 1024, 2048}) {
      double plain_ms = 0.0;
      for (const ShadowMethodTraits& traits : ShadowMethods()) {
        PLEINAIR_RETURN_IF_ERROR(renderer.SetMethod(CommonOptions(traits.method, resolution)));
        PLEINAIR_RETURN_IF_ERROR(renderer.Draw(view));  // Compiles shaders and fills caches.
        PLEINAIR_ASSIGN_OR_RETURN(const FrameTime time, renderer.Time(view, kFrames));
        if (traits.method == ShadowMethod::kPlain) plain_ms = time.total_ms();
        std::printf(
            "{\"scene\":\"%s\",\"method\":\"%s\",\"resolution\":%d,\"maps_ms\":%.4f,"
            "\"scene_ms\":%.4f,\"ratio_to_plain\":%.3f}\n",
            scene.name.c_str(), std::string(traits.name).c_str(), resolution, time.maps_ms,
            time.scene_ms, time.total_ms() / plain_ms);
        std::fflush(stdout);
      }
    }
  }
  return {};
}

}  // namespace
}  // namespace pleinair::shadows

int main(int argc, char** argv) {
  const int width = argc > 2 ? std::atoi(argv[1]) : 1280;
  const int height = argc > 2 ? std::atoi(argv[2]) : 720;
  if (width < 16 || height < 16 || argc == 2 || argc > 3) {
    std::fprintf(stderr, "shadow_bench: give width and height of at least 16 pixels, or nothing\n");
    return 2;
  }
  const auto result = pleinair::shadows::Run(width, height);
  if (result) return 0;
  std::fprintf(stderr, "shadow_bench: %s\n", result.error().Message().c_str());
  return 1;
}
