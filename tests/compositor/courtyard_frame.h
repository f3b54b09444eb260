#pragma once

// The bundled courtyard in its recorded light, as input of a Composer.

#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/camera_model.h"
#include "base/check.h"
#include "base/frames.h"
#include "compositor/composer.h"
#include "compositor/light/light_solver.h"
#include "compositor/models/animation/model_animation.h"
#include "compositor/models/model.h"
#include "compositor/models/texture_decoder.h"
#include "tests/compositor/light/light_scenes.h"
#include "tests/source_tree.h"

namespace pleinair::compositor::testing {

/// An animation that keeps the shape of a model.
class Unmoved : public ModelAnimation {
 public:
  explicit Unmoved(std::shared_ptr<const Model> model) : model_(std::move(model)) {}
  double duration_s() const override { return 1.0; }
  ModelBounds bounds() const override { return BoundsOf(*model_); }
  std::vector<MeshShape> At(double) const override {
    std::vector<MeshShape> shapes;
    for (const Mesh& mesh : model_->meshes) shapes.push_back({mesh.positions, mesh.normals});
    return shapes;
  }

 private:
  std::shared_ptr<const Model> model_;
};

/// The models and the light of recordings/courtyard_midday.
class Courtyard {
 public:
  static constexpr int kKeyFrame = 36;  ///< The frame of picture().
  static constexpr int kRays = 64;      ///< Per vertex.

  /// `rays`: per vertex, for MakeComposer().
  explicit Courtyard(int rays = kRays) : poses_(ReadPoses()) {
    for (const bool is_phantom : {true, false}) {
      scene_.push_back(
          {std::make_shared<const Model>(
               LoadModel(Folder() / (is_phantom ? "phantom.obj" : "object.obj"), {}).value()),
           Mat3{},
           {},
           is_phantom});
    }
    const auto solver = LightSolver::Create(scene_, {.rays_per_vertex = rays}).value();
    lit_ = solver->Solve(day_, Mat3{});
    from_below_ = solver->RadianceFromBelow(day_, Mat3{});
  }

  /// A composer with the courtyard's light, without unmodelled shadows. With them it would shade
  /// the whole sun window.
  std::unique_ptr<Composer> MakeComposer(const ComposerOptions& options) const {
    return MakeComposer(options, camera_);
  }
  /// The same with another camera.
  std::unique_ptr<Composer> MakeComposer(const ComposerOptions& options,
                                         const CameraModel& camera) const {
    auto composer = Composer::Create(camera, scene_, options).value();
    CHECK_EQ(composer->SetLight(lit_, day_, Mat3{}, from_below_).has_value(), true);
    composer->AssumeUnmodelledShadows(false);
    return composer;
  }

  /// As MakeComposer(), with the object as one that may change its shape but does not.
  std::unique_ptr<Composer> MakeChangingComposer(const ComposerOptions& options) const {
    std::vector<PlacedModel> scene = scene_;
    scene[1].playback.animation = std::make_shared<Unmoved>(scene[1].model);
    const auto solver = LightSolver::Create(scene, {.rays_per_vertex = kRays}).value();
    auto composer = Composer::Create(camera_, scene, options).value();
    CHECK_EQ(composer
                 ->SetLight(solver->Solve(day_, Mat3{}), day_, Mat3{},
                            solver->RadianceFromBelow(day_, Mat3{}))
                 .has_value(),
             true);
    composer->AssumeUnmodelledShadows(false);
    return composer;
  }

  const CameraModel& camera() const { return camera_; }
  /// Coverage by the object in Picture(), 0…255.
  RgbImage ObjectMask() const { return ReadTexture(Folder() / "key/0036_objmask.png").value(); }

  RgbImage Picture() const { return ReadTexture(Folder() / "key/0036_background.png").value(); }
  /// For every frame.
  const std::vector<Transform<Camera, Marker>>& poses() const { return poses_; }
  /// Paving of albedo 0.3 in full light has the linear value 0.3.
  LinearRgb ExposureScale() const {
    const LinearRgb light =
        day_.SkyHorizontalIrradiance() + day_.SunNormalIrradiance() * day_.ToSun().xyz.z;
    return {std::numbers::pi / light.r, std::numbers::pi / light.g, std::numbers::pi / light.b};
  }

 private:
  static std::filesystem::path Folder() {
    return tests::SourceTree() / "recordings/courtyard_midday";
  }

  static std::vector<Transform<Camera, Marker>> ReadPoses() {
    std::vector<Transform<Camera, Marker>> poses;
    std::ifstream file(Folder() / "truth.tum");
    std::string line;
    while (std::getline(file, line)) {
      if (line.starts_with('#')) continue;
      // x_marker = R(q) x_camera + t.
      std::istringstream numbers(line);
      double t = 0.0, w = 0.0;
      Vec3 eye, q;
      numbers >> t >> eye.x >> eye.y >> eye.z >> q.x >> q.y >> q.z >> w;
      const auto rotated = [&](Vec3 v) {
        const Vec3 across = Cross(q, v) * 2.0;
        return v + across * w + Cross(q, across);
      };
      const Vec3 x = rotated({1, 0, 0}), y = rotated({0, 1, 0}), z = rotated({0, 0, 1});
      const Transform<Marker, Camera> marker_from_camera{
          {{x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z}}, eye};
      poses.push_back(marker_from_camera.Inverse());
    }
    return poses;
  }

  CameraModel camera_{.width = 640, .height = 480, .fx = 605, .fy = 605, .cx = 319.5, .cy = 239.5};
  UniformDay day_{{3000, 4200, 6500}, {70e3, 65e3, 55e3}, {-0.2, -0.7, 0.68}};
  std::vector<Transform<Camera, Marker>> poses_;
  std::vector<PlacedModel> scene_;
  std::vector<LitMesh> lit_;
  LinearRgb from_below_;
};

}  // namespace pleinair::compositor::testing
