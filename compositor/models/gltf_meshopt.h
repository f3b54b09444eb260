#pragma once

// Internal: between the .cc files of this module; not installed.

#include <string>

#include "base/error.h"

namespace tinygltf {
class Model;
}

namespace pleinair::compositor {

inline constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

#ifdef PLEINAIR_MESHOPT
inline constexpr bool kHasMeshopt = true;
#else
inline constexpr bool kHasMeshopt = false;
#endif

/// Decodes the buffer views with EXT_meshopt_compression into buffers of their own. Errors: damaged
/// or too large. Without the library it does nothing.
Result<void> DecompressMeshopt(const std::string& where, tinygltf::Model* gltf);

}  // namespace pleinair::compositor
