#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "compositor/models/model.h"

namespace pleinair::compositor {

/// Shape of a mesh at one moment.
struct MeshShape {
  std::vector<std::array<float, 3>> positions;  ///< As Mesh::positions.
  std::vector<std::array<float, 3>> normals;    ///< Unit, one per position.
  /// Other triangles than those of the mesh, three corners each, for any number of positions.
  /// Empty: the same triangles as before.
  std::vector<std::uint32_t> indices = {};
};

/// A model that changes its shape with time but keeps its triangles. Thread-safe.
class ModelAnimation {
 public:
  virtual ~ModelAnimation() = default;

  /// Length of the animation, seconds; above zero.
  virtual double duration_s() const = 0;
  /// Box around the model at all moments, model coordinates.
  virtual ModelBounds bounds() const = 0;
  /// The shape at a moment since the beginning of the animation: one entry per mesh of the model,
  /// with as many vertices. Before and after the animation it has its first and last shape. The
  /// result does not depend on the number of threads.
  virtual std::vector<MeshShape> At(double time_s) const = 0;
};

/// An animation in a scene's time.
struct Playback {
  std::shared_ptr<const ModelAnimation> animation;  ///< Null: the model stands still.
  double start_s = 0.0;                             ///< Its moment when the scene begins.
  bool loop = false;                                ///< Else it keeps its last shape.

  /// The moment of the animation `scene_s` seconds after the beginning of the scene, or before it.
  double MomentAt(double scene_s) const;
};

/// A model in the pose of its nodes, and how it moves.
struct AnimatedModel {
  Model model;
  std::shared_ptr<const ModelAnimation> animation;
};

/// Loads a glTF file with an animation by its name, else by its number from 0 on. Axes, unit and
/// origin are those of the pose without the animation. Holes of textures are not cut out. Errors as
/// LoadModel(). Further errors: the file does not have the animation; the animation is damaged, or
/// has no time between its key frames. It is also an error if the animation takes the model farther
/// than a file may extend.
Result<AnimatedModel> LoadAnimatedModel(const std::filesystem::path& file,
                                        const ModelOptions& options, const std::string& animation);

}  // namespace pleinair::compositor
