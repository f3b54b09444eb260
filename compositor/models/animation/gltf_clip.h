#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/models/gltf_placement.h"

namespace tinygltf {
class Model;
}

namespace pleinair::compositor {

/// The nodes of a glTF file at one moment.
struct GltfPose {
  std::vector<GltfPlacement> local;         ///< By node: parent from node coordinates.
  std::vector<std::vector<float>> weights;  ///< Morph target weights by node; empty: its mesh's.
};

/// An animation of a glTF file with its key frames in memory (glTF 2.0, 3.11 and appendix C). It
/// interpolates by steps, linearly (rotations spherically), or by cubic splines.
class GltfClip {
 public:
  /// Reads an animation by its name, else by its number from 0 on. An empty name selects none: the
  /// nodes keep their pose. Errors: no such animation, a property that moves twice, or too many
  /// keys for the memory. Further errors: times that are not finite or do not increase, and counts
  /// that do not match. `where` names the file.
  static Result<GltfClip> Read(const tinygltf::Model& gltf, const std::string& animation,
                               const std::string& where);

  /// Time of the last key frame, seconds; 0 if nothing moves.
  double duration_s() const { return duration_s_; }

  /// The nodes at one moment. Before the first and after the last key frame they have its pose.
  GltfPose At(double time_s) const;

 private:
  /// Keys of one property: `width` numbers each, three times as many for splines.
  struct Keys {
    /// A key's value; of splines part 0 the tangent before it, 1 its value, 2 the tangent after it.
    const double* At(std::size_t key, std::size_t part = 1) const {
      return kind == Kind::kCubic ? &values[(3 * key + part) * width] : &values[key * width];
    }

    std::vector<double> times_s;
    std::vector<double> values;
    std::size_t width = 0;
    enum class Kind { kStep, kLinear, kCubic } kind = Kind::kLinear;
    bool is_rotation = false;
  };
  enum class Property { kTranslation, kRotation, kScale, kWeights };
  struct Channel {
    std::size_t node = 0;
    Property property = Property::kTranslation;
    Keys keys;
  };

  Result<void> ReadChannels(const tinygltf::Model& gltf, std::size_t animation,
                            const std::string& where);
  static Result<Keys> ReadKeys(const tinygltf::Model& gltf, std::size_t animation, int sampler,
                               std::size_t width, Property property, const std::string& where);
  static std::vector<double> Spline(const Keys& keys, std::size_t key, double t, double span_s);
  static std::vector<double> Evaluate(const Keys& keys, double time_s);

  std::vector<GltfTransform> nodes_;         // Without the animation.
  std::vector<std::vector<float>> weights_;  // The same, as GltfPose::weights.
  std::vector<Channel> channels_;
  double duration_s_ = 0.0;
};

}  // namespace pleinair::compositor
