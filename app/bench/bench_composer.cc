#include "app/bench/bench_composer.h"

#include <numbers>

#include "compositor/light/light_solver.h"

namespace pleinair::app {
namespace {

/// An even sky and a sun in the south-west, 37° high.
class BenchDaylight : public sky::SkyModel {
 public:
  LinearRgb SkyRadiance(Direction<World> /*from*/) const override {
    return SkyHorizontalIrradiance() * std::numbers::inv_pi;
  }
  LinearRgb SunNormalIrradiance() const override { return {80000, 80000, 80000}; }
  LinearRgb SkyHorizontalIrradiance() const override { return {20000, 20000, 20000}; }
  Direction<World> ToSun() const override { return {Normalized({-0.6, -0.53, 0.6})}; }
};

// White ground in sun and sky has a linear value of 0.9.
constexpr double kExposureScale = 0.9 * std::numbers::pi / 68000.0;

}  // namespace

Result<std::unique_ptr<compositor::Composer>> MakeBenchComposer(
    const CameraModel& camera, const std::vector<compositor::PlacedModel>& models,
    const compositor::Antialiasing& antialiasing) {
  const BenchDaylight daylight;
  PLEINAIR_ASSIGN_OR_RETURN(const auto solver,
                            compositor::LightSolver::Create(models, {.rays_per_vertex = 64}));
  compositor::ComposerOptions options;
  options.antialiasing = antialiasing;
  PLEINAIR_ASSIGN_OR_RETURN(auto composer, compositor::Composer::Create(camera, models, options));
  composer->AssumeUnmodelledShadows(false);
  PLEINAIR_RETURN_IF_ERROR(composer->SetLight(solver->Solve(daylight, Mat3{}), daylight, Mat3{},
                                              solver->RadianceFromBelow(daylight, Mat3{})));
  return composer;
}

LinearRgb BenchExposure() { return {kExposureScale, kExposureScale, kExposureScale}; }

CameraModel BenchCamera(int width, int height) {
  CameraModel camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = 0.9 * width;
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  return camera;
}

}  // namespace pleinair::app
