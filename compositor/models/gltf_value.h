#pragma once

// Internal: between the .cc files of this module; not installed.

#include <tiny_gltf.h>

namespace pleinair::compositor {

/// A field of a JSON object; null where it is missing or `value` is no object, for which tinygltf's
/// own access ends the program.
inline const tinygltf::Value& GltfField(const tinygltf::Value& value, const char* key) {
  static const tinygltf::Value kNull;
  return value.IsObject() ? value.Get(key) : kNull;
}

}  // namespace pleinair::compositor
