#include "compositor/models/gltf_pose.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <set>
#include <string_view>
#include <utility>

#include "compositor/models/gltf_accessor.h"
#include "compositor/models/gltf_error.h"
#include "compositor/models/model_limits.h"

namespace pleinair::compositor {
namespace {

/// Keys of one channel: `width` numbers each, three times as many for splines.
struct Keys {
  std::vector<double> times_s;
  std::vector<double> values;
  std::size_t width = 0;
  enum class Kind { kStep, kLinear, kCubic } kind = Kind::kLinear;
  bool is_rotation = false;

  /// A key's value; of splines part 0 the tangent before it, 1 its value, 2 the tangent after it.
  const double* At(std::size_t key, std::size_t part = 1) const {
    return kind == Kind::kCubic ? &values[(3 * key + part) * width] : &values[key * width];
  }
};

void Normalize(std::vector<double>* quaternion) {
  double sum = 0.0;
  for (const double value : *quaternion) sum += value * value;
  if (!(sum > 0.0)) return;
  for (double& value : *quaternion) value /= std::sqrt(sum);
}

/// Spherical interpolation along the shorter arc (Shoemake 1985; glTF 2.0, C.3).
std::vector<double> Slerp(const double* a, const double* b, double t) {
  double dot = 0.0;
  for (int i = 0; i < 4; ++i) dot += a[i] * b[i];
  const double sign = dot < 0.0 ? -1.0 : 1.0;
  const double angle = std::acos(std::min(std::abs(dot), 1.0));
  const double sine = std::sin(angle);
  const bool nearly_equal = sine < 1e-6;
  const double from = nearly_equal ? 1.0 - t : std::sin((1.0 - t) * angle) / sine;
  const double to = sign * (nearly_equal ? t : std::sin(t * angle) / sine);
  std::vector<double> result(4);
  for (std::size_t i = 0; i < 4; ++i) result[i] = from * a[i] + to * b[i];
  return result;
}

/// Cubic Hermite spline (glTF 2.0, C.5); `span_s` is the time between both keys.
std::vector<double> Spline(const Keys& keys, std::size_t key, double t, double span_s) {
  const double t2 = t * t, t3 = t2 * t;
  const double* from = keys.At(key);
  const double* out = keys.At(key, 2);
  const double* to = keys.At(key + 1);
  const double* in = keys.At(key + 1, 0);
  std::vector<double> result(keys.width);
  for (std::size_t i = 0; i < keys.width; ++i) {
    result[i] = (2 * t3 - 3 * t2 + 1) * from[i] + span_s * (t3 - 2 * t2 + t) * out[i] +
                (3 * t2 - 2 * t3) * to[i] + span_s * (t3 - t2) * in[i];
  }
  return result;
}

std::vector<double> Evaluate(const Keys& keys, double time_s) {
  const auto after = std::ranges::upper_bound(keys.times_s, time_s);
  const auto copy = [&](std::size_t key) {
    return std::vector<double>(keys.At(key), keys.At(key) + keys.width);
  };
  std::vector<double> value;
  if (after == keys.times_s.begin()) {
    value = copy(0);
  } else if (after == keys.times_s.end()) {
    value = copy(keys.times_s.size() - 1);
  } else {
    const auto key = static_cast<std::size_t>(after - keys.times_s.begin()) - 1;
    const double span_s = keys.times_s[key + 1] - keys.times_s[key];
    const double t = (time_s - keys.times_s[key]) / span_s;
    if (keys.kind == Keys::Kind::kStep) {
      value = copy(key);
    } else if (keys.kind == Keys::Kind::kCubic) {
      value = Spline(keys, key, t, span_s);
    } else if (keys.is_rotation) {
      value = Slerp(keys.At(key), keys.At(key + 1), t);
    } else {
      value = copy(key);
      const double* to = keys.At(key + 1);
      for (std::size_t i = 0; i < keys.width; ++i) value[i] += t * (to[i] - value[i]);
    }
  }
  if (keys.is_rotation) Normalize(&value);
  return value;
}

/// Reads an accessor of `width` numbers an element as one list.
Result<std::vector<double>> Numbers(const tinygltf::Model& gltf, int accessor, std::size_t width,
                                    const std::string& where) {
  std::vector<double> numbers;
  const auto append = [&](const auto& elements) {
    numbers.reserve(elements.size() * width);
    for (const auto& element : elements) {
      for (const float value : element) numbers.push_back(value);
    }
  };
  if (width == 3) {
    PLEINAIR_ASSIGN_OR_RETURN(const auto elements, ReadGltfFloats<3>(gltf, accessor, where));
    append(elements);
  } else if (width == 4) {
    PLEINAIR_ASSIGN_OR_RETURN(const auto elements, ReadGltfFloats<4>(gltf, accessor, where));
    append(elements);
  } else {
    PLEINAIR_ASSIGN_OR_RETURN(const auto elements, ReadGltfFloats<1>(gltf, accessor, where));
    append(elements);
  }
  return numbers;
}

/// Number of a node's morph targets.
std::size_t TargetsOf(const tinygltf::Model& gltf, const tinygltf::Node& node) {
  if (!IsGltfIndex(node.mesh, gltf.meshes.size())) return 0;
  const tinygltf::Mesh& mesh = gltf.meshes[static_cast<std::size_t>(node.mesh)];
  return mesh.primitives.empty() ? 0 : mesh.primitives[0].targets.size();
}

Result<Keys> ReadKeys(const tinygltf::Model& gltf, const tinygltf::AnimationSampler& sampler,
                      std::size_t width, bool is_rotation, const std::string& where) {
  Keys keys;
  keys.width = width;
  keys.is_rotation = is_rotation;
  keys.kind = sampler.interpolation == "STEP"          ? Keys::Kind::kStep
              : sampler.interpolation == "CUBICSPLINE" ? Keys::Kind::kCubic
                                                       : Keys::Kind::kLinear;
  PLEINAIR_ASSIGN_OR_RETURN(keys.times_s, Numbers(gltf, sampler.input, 1, where));
  // Weights of morph targets come one by one.
  const std::size_t element = is_rotation ? 4 : width == 3 ? 3 : 1;
  PLEINAIR_ASSIGN_OR_RETURN(keys.values, Numbers(gltf, sampler.output, element, where));
  const std::size_t each = width * (keys.kind == Keys::Kind::kCubic ? 3 : 1);
  if (keys.times_s.empty() || keys.values.size() != keys.times_s.size() * each) {
    return GltfError(where, "an animation has more or fewer values than key frames");
  }
  for (std::size_t i = 1; i < keys.times_s.size(); ++i) {
    if (!(keys.times_s[i] > keys.times_s[i - 1])) {
      return GltfError(where, "the key frames of an animation are not in order");
    }
  }
  return keys;
}

/// Finds an animation by its name, else by its number.
Result<const tinygltf::Animation*> FindAnimation(const tinygltf::Model& gltf,
                                                 const std::string& name,
                                                 const std::string& where) {
  const auto found = std::ranges::find(gltf.animations, name, &tinygltf::Animation::name);
  if (found != gltf.animations.end()) return &*found;
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error == std::errc() && end == name.data() + name.size() && number < gltf.animations.size()) {
    return &gltf.animations[number];
  }
  std::string names;
  for (const tinygltf::Animation& animation : gltf.animations) {
    if (names.size() > 200) break;
    names += (names.empty() ? "" : ", ") + animation.name.substr(0, 64);
  }
  return InputError(
      where, "has no animation \"" + name.substr(0, 64) + "\"",
      gltf.animations.empty() ? "it has none: leave animation out" : "it has " + names);
}

/// Sets one property of a node's pose.
Result<void> Apply(const tinygltf::Model& gltf, const tinygltf::Animation& animation,
                   const tinygltf::AnimationChannel& channel, double time_s,
                   const std::string& where, std::vector<tinygltf::Node>* nodes, GltfPose* pose) {
  if (channel.target_node < 0) return {};  // Of an extension.
  if (!IsGltfIndex(channel.target_node, gltf.nodes.size()) ||
      !IsGltfIndex(channel.sampler, animation.samplers.size())) {
    return GltfError(where, "an animation refers to a node or a sampler out of range");
  }
  const auto index = static_cast<std::size_t>(channel.target_node);
  const bool is_rotation = channel.target_path == "rotation";
  const bool is_weights = channel.target_path == "weights";
  std::size_t width = is_rotation ? 4 : 3;
  if (is_weights) {
    width = TargetsOf(gltf, gltf.nodes[index]);
    if (width == 0 || width > kMaxMorphTargets) return {};  // ApplyMorphTargets() refuses them.
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      const Keys keys, ReadKeys(gltf, animation.samplers[static_cast<std::size_t>(channel.sampler)],
                                width, is_rotation, where));
  std::vector<double> value = Evaluate(keys, time_s);
  tinygltf::Node& node = (*nodes)[index];
  if (is_weights) {
    pose->weights[index].assign(value.begin(), value.end());
  } else if (is_rotation) {
    node.rotation = std::move(value);
  } else if (channel.target_path == "translation") {
    node.translation = std::move(value);
  } else if (channel.target_path == "scale") {
    node.scale = std::move(value);
  }
  return {};
}

}  // namespace

Result<GltfPose> PoseOf(const tinygltf::Model& gltf, const ModelPose& pose,
                        const std::string& where) {
  GltfPose result;
  result.weights.resize(gltf.nodes.size());
  std::vector<tinygltf::Node> nodes(gltf.nodes.size());  // Their placements only.
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const tinygltf::Node& node = gltf.nodes[i];
    nodes[i].matrix = node.matrix;
    nodes[i].rotation = node.rotation;
    nodes[i].translation = node.translation;
    nodes[i].scale = node.scale;
    result.weights[i].assign(node.weights.begin(), node.weights.end());
  }
  if (!pose.animation.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(const tinygltf::Animation* animation,
                              FindAnimation(gltf, pose.animation, where));
    std::set<std::pair<int, std::string_view>> moved;
    std::size_t weights = 0;
    for (const tinygltf::AnimationChannel& channel : animation->channels) {
      const int node = channel.target_node;
      if (node >= 0 && !moved.emplace(node, channel.target_path).second) {
        return GltfError(where, "an animation moves one property twice");
      }
      PLEINAIR_RETURN_IF_ERROR(
          Apply(gltf, *animation, channel, pose.time_s, where, &nodes, &result));
      if (node < 0 || channel.target_path != "weights") continue;
      // Nodes may share a mesh and its targets, so few bytes of the file can ask for many weights.
      weights += result.weights[static_cast<std::size_t>(node)].size();
      if (weights > kMaxVertices) {
        return GltfError(where, "an animation has more than 20 million weights");
      }
    }
  }
  result.local.reserve(nodes.size());
  for (const tinygltf::Node& node : nodes) result.local.push_back(PlacementOf(node));
  return result;
}

std::vector<GltfPlacement> ScenePlacements(const tinygltf::Model& gltf, const GltfPose& pose) {
  std::vector<bool> is_child(gltf.nodes.size());
  for (const tinygltf::Node& node : gltf.nodes) {
    for (const int child : node.children) {
      if (IsGltfIndex(child, gltf.nodes.size())) is_child[static_cast<std::size_t>(child)] = true;
    }
  }
  std::vector<GltfPlacement> placements = pose.local;
  std::vector<bool> placed(gltf.nodes.size());
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < placements.size(); ++i) {
    if (is_child[i]) continue;
    placed[i] = true;
    open.push_back(i);
  }
  while (!open.empty()) {
    const std::size_t parent = open.back();
    open.pop_back();
    for (const int child : gltf.nodes[parent].children) {
      if (!IsGltfIndex(child, gltf.nodes.size())) continue;
      const auto index = static_cast<std::size_t>(child);
      if (placed[index]) continue;
      placed[index] = true;
      placements[index] = placements[parent] * pose.local[index];
      open.push_back(index);
    }
  }
  return placements;
}

}  // namespace pleinair::compositor
