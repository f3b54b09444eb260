#include "compositor/models/animation/gltf_clip.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "compositor/models/gltf_accessor.h"
#include "compositor/models/gltf_error.h"
#include "compositor/models/model_limits.h"

namespace pleinair::compositor {
namespace {

void NormalizeQuaternion(std::vector<double>* quaternion) {
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

/// Finds an animation by its name, else by its number.
Result<std::size_t> FindAnimation(const tinygltf::Model& gltf, const std::string& name,
                                  const std::string& where) {
  const auto found = std::ranges::find(gltf.animations, name, &tinygltf::Animation::name);
  if (found != gltf.animations.end()) {
    return static_cast<std::size_t>(found - gltf.animations.begin());
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error == std::errc() && end == name.data() + name.size() && number < gltf.animations.size()) {
    return number;
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

}  // namespace

Result<GltfClip> GltfClip::Read(const tinygltf::Model& gltf, const std::string& animation,
                                const std::string& where) {
  GltfClip clip;
  clip.nodes_.reserve(gltf.nodes.size());
  clip.weights_.reserve(gltf.nodes.size());
  for (const tinygltf::Node& node : gltf.nodes) {
    clip.nodes_.push_back(TransformOf(node));
    clip.weights_.emplace_back(node.weights.begin(), node.weights.end());
  }
  if (animation.empty()) return clip;
  PLEINAIR_ASSIGN_OR_RETURN(const std::size_t index, FindAnimation(gltf, animation, where));
  PLEINAIR_RETURN_IF_ERROR(clip.ReadChannels(gltf, index, where));
  return clip;
}

Result<void> GltfClip::ReadChannels(const tinygltf::Model& gltf, std::size_t animation,
                                    const std::string& where) {
  const tinygltf::Animation& source = gltf.animations[animation];
  std::set<std::pair<int, std::string_view>> moved;
  std::size_t weights = 0, numbers = 0;
  for (const tinygltf::AnimationChannel& channel : source.channels) {
    if (channel.target_node < 0) continue;  // The target belongs to an extension.
    if (!IsGltfIndex(channel.target_node, gltf.nodes.size()) ||
        !IsGltfIndex(channel.sampler, source.samplers.size())) {
      return GltfError(where, "an animation refers to a node or a sampler out of range");
    }
    if (!moved.emplace(channel.target_node, channel.target_path).second) {
      return GltfError(where, "an animation moves one property twice");
    }
    const auto node = static_cast<std::size_t>(channel.target_node);
    Property property = Property::kTranslation;
    std::size_t width = 3;
    if (channel.target_path == "rotation") {
      property = Property::kRotation;
      width = 4;
    } else if (channel.target_path == "scale") {
      property = Property::kScale;
    } else if (channel.target_path == "weights") {
      property = Property::kWeights;
      width = TargetsOf(gltf, gltf.nodes[node]);
      if (width == 0 || width > kMaxMorphTargets) continue;  // ApplyMorphTargets() refuses them.
      // Nodes may share a mesh and its targets, so few bytes of the file can ask for many weights.
      weights += width;
      if (weights > kMaxVertices) {
        return GltfError(where, "an animation has more than 20 million weights");
      }
    } else if (channel.target_path != "translation") {
      continue;
    }
    PLEINAIR_ASSIGN_OR_RETURN(Keys keys,
                              ReadKeys(gltf, animation, channel.sampler, width, property, where));
    // Channels may share a sampler: few bytes of the file can ask for many keys, too.
    numbers += keys.times_s.size() + keys.values.size();
    if (numbers > kMaxVertices) {
      return GltfError(where, "the key frames of an animation have more than 20 million numbers");
    }
    if (keys.times_s.size() > 1) duration_s_ = std::max(duration_s_, keys.times_s.back());
    channels_.push_back({node, property, std::move(keys)});
  }
  return {};
}

Result<GltfClip::Keys> GltfClip::ReadKeys(const tinygltf::Model& gltf, std::size_t animation,
                                          int sampler, std::size_t width, Property property,
                                          const std::string& where) {
  const tinygltf::AnimationSampler& source =
      gltf.animations[animation].samplers[static_cast<std::size_t>(sampler)];
  Keys keys;
  keys.width = width;
  keys.is_rotation = property == Property::kRotation;
  keys.kind = source.interpolation == "STEP"          ? Keys::Kind::kStep
              : source.interpolation == "CUBICSPLINE" ? Keys::Kind::kCubic
                                                      : Keys::Kind::kLinear;
  PLEINAIR_ASSIGN_OR_RETURN(keys.times_s, Numbers(gltf, source.input, 1, where));
  // Weights of morph targets come one by one.
  const std::size_t element = property == Property::kWeights ? 1 : width;
  PLEINAIR_ASSIGN_OR_RETURN(keys.values, Numbers(gltf, source.output, element, where));
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

/// Cubic Hermite spline (glTF 2.0, C.5); `span_s` is the time between both keys.
std::vector<double> GltfClip::Spline(const Keys& keys, std::size_t key, double t, double span_s) {
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

std::vector<double> GltfClip::Evaluate(const Keys& keys, double time_s) {
  const auto after = std::upper_bound(keys.times_s.begin(), keys.times_s.end(), time_s);
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
  if (keys.is_rotation) NormalizeQuaternion(&value);
  return value;
}

GltfPose GltfClip::At(double time_s) const {
  std::vector<GltfTransform> nodes = nodes_;
  GltfPose pose;
  pose.weights = weights_;
  for (const Channel& channel : channels_) {
    const std::vector<double> value = Evaluate(channel.keys, time_s);
    GltfTransform& node = nodes[channel.node];
    switch (channel.property) {
      case Property::kTranslation:
        node.translation_m = {value[0], value[1], value[2]};
        break;
      case Property::kRotation:
        node.rotation = {value[0], value[1], value[2], value[3]};
        break;
      case Property::kScale:
        node.scale = {value[0], value[1], value[2]};
        break;
      case Property::kWeights:
        pose.weights[channel.node].assign(value.begin(), value.end());
        break;
    }
  }
  pose.local.reserve(nodes.size());
  for (const GltfTransform& node : nodes) pose.local.push_back(node.Placement());
  return pose;
}

}  // namespace pleinair::compositor
