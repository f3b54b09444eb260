#include "compositor/canvas.h"

namespace pleinair::compositor {
namespace {

constexpr double kWarpedSupersampling = 1.5;

}  // namespace

Result<Canvas> Canvas::Create(const CameraModel& camera, const ComposerOptions& options,
                              const SceneMaterials& materials) {
  const double supersampling = options.supersampling > 0.0 ? options.supersampling
                               : camera.HasDistortion()    ? kWarpedSupersampling
                                                           : 1.0;
  Canvas canvas;
  canvas.camera = FitRenderCamera(camera, supersampling);
  PLEINAIR_ASSIGN_OR_RETURN(
      canvas.targets, RenderTargets::Create(canvas.camera.width, canvas.camera.height,
                                            {.detailed = materials.HasDetails(),
                                             .blended = materials.HasBlended(),
                                             .multisampled = options.antialiasing.HasSamples()}));
  if (const int places = options.antialiasing.CoveragePlaces(); places > 0) {
    PLEINAIR_ASSIGN_OR_RETURN(canvas.coverage,
                              CoveragePass::Create(places, materials.HasTextures()));
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      canvas.places,
      PlaceMean::Create(canvas.camera.width, canvas.camera.height, options.antialiasing));
  PLEINAIR_ASSIGN_OR_RETURN(canvas.coarse,
                            CoarseRatio::Create(canvas.camera, materials.HasBlended()));
  PLEINAIR_ASSIGN_OR_RETURN(canvas.picture, CameraPicture::Create(camera, canvas.camera,
                                                                  supersampling, options.response));
  return canvas;
}

}  // namespace pleinair::compositor
