#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"

namespace tinygltf {
class Model;
class Value;
}  // namespace tinygltf

namespace pleinair::compositor {

/// A field of a JSON object; null where it is missing or `value` is no object, for which tinygltf's
/// own access ends the program.
const tinygltf::Value& GltfField(const tinygltf::Value& value, const char* key);

/// The bytes of a buffer view. Errors: the view or its buffer does not exist or is too short.
/// `where` names the file in all errors of this header.
Result<std::span<const std::byte>> GltfViewBytes(const tinygltf::Model& gltf, int view,
                                                 const std::string& where);

/// Reads the elements of an accessor as N floats each. Normalised integers are scaled, and sparse
/// values replace their elements. Errors: out of range, another number of components, values not
/// finite.
template <std::size_t N>
Result<std::vector<std::array<float, N>>> ReadGltfFloats(const tinygltf::Model& gltf, int accessor,
                                                         const std::string& where);

/// Reads colors with or without alpha, clamped to 0…1. Errors as above.
Result<std::vector<std::array<float, 4>>> ReadGltfColors(const tinygltf::Model& gltf, int accessor,
                                                         const std::string& where);

/// Reads the elements of an accessor of unsigned integers. Errors as above.
Result<std::vector<std::uint32_t>> ReadGltfIndices(const tinygltf::Model& gltf, int accessor,
                                                   const std::string& where);

}  // namespace pleinair::compositor
