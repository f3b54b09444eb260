#pragma once

// Internal: between the .cc files of this module; not installed.

#include <string>

#include "base/error.h"

namespace tinygltf {
class Model;
}

namespace pleinair::compositor {

inline constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";

#ifdef PLEINAIR_DRACO
inline constexpr bool kHasDraco = true;
#else
inline constexpr bool kHasDraco = false;
#endif

/// Decodes the primitives with KHR_draco_mesh_compression. Their accessors then refer to buffers of
/// their own, with attributes as floats and indices of 32 bits. Errors: damaged, too large, or
/// attributes that the stream does not have. Without the library it does nothing.
Result<void> DecompressDraco(const std::string& where, tinygltf::Model* gltf);

}  // namespace pleinair::compositor
