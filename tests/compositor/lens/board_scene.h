#pragma once

// Boards that face the camera, composed through a lens and by a moving camera.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "tests/compositor/composer_scene.h"

namespace pleinair::compositor {

/// A level rectangle, seen from above.
struct Board {
  double x0, y0, x1, y1;  // Marker, metres.
  double distance_m;      // From the camera.
  float light;
  bool is_real = false;

  bool Covers(double x, double y) const { return x >= x0 && x <= x1 && y >= y0 && y <= y1; }
  PlacedModel Placed() const {
    const double height = 3.0 - distance_m;
    Model model = MakeBox({x0, y0, height}, {x1, y1, height}, light);
    if (!is_real) model.materials.front().detail.unlit = true;
    return Place(model, is_real);
  }
};

struct Drawing {
  int places = 1;  // On the stop, or kByLayers.
  ComposerOptions options;
  CameraMotion motion = {};  // While the image is exposed.
};

inline RgbImage ComposeThrough(const std::vector<Board>& boards, const RgbImage& picture,
                               const CameraModel& camera, const std::optional<ThinLens>& lens,
                               const Drawing& drawn, double* largest_px = nullptr,
                               LensFigures* figures = nullptr) {
  std::vector<PlacedModel> scene;
  scene.reserve(boards.size());
  for (const Board& board : boards) scene.push_back(board.Placed());
  const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 64});
  auto created = Composer::Create(camera, scene, drawn.options);
  if (!created) ADD_FAILURE() << created.error().Message();
  const std::unique_ptr<Composer> composer = *std::move(created);
  composer->AssumeUnmodelledShadows(false);
  const SouthernSun light(0.0);
  EXPECT_TRUE(composer->SetLight(solver.value()->Solve(light, Mat3{}), light, Mat3{},
                                 solver.value()->RadianceFromBelow(light, Mat3{})));
  composer->SetLens(lens, drawn.places);
  composer->SetMotion(drawn.motion, 64);
  auto image = composer->Compose(picture.view(), kFromAbove,
                                 {kExposureScale, kExposureScale, kExposureScale});
  if (!image) ADD_FAILURE() << image.error().Message();
  if (figures != nullptr) *figures = composer->DrawnLens();
  if (largest_px != nullptr) *largest_px = composer->DrawnLens().largest_circle_px;
  return *std::move(image);
}

inline RgbImage Even(const CameraModel& camera, std::uint8_t code) {
  RgbImage picture(camera.width, camera.height, 3);
  std::fill_n(picture.data(), picture.size(), code);
  return picture;
}

inline const CameraModel kSmall{
    .width = 128, .height = 96, .fx = 300, .fy = 300, .cx = 63.5, .cy = 47.5};

}  // namespace pleinair::compositor
