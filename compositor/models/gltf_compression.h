#pragma once

// Internal: between the .cc files of this module; not installed.

#include <string>

#include "base/error.h"

namespace tinygltf {
class Model;
}

namespace pleinair::compositor {

/// Returns whether this build decompresses the content of an extension. EXT_meshopt_compression
/// needs the library meshoptimizer, KHR_draco_mesh_compression needs Draco.
bool CanDecompress(const std::string& extension);

/// Fills the gaps in the content of a compressed glTF file, text or binary. Its extensions leave
/// these gaps, which tinygltf refuses. Buffers without data become one byte. Accessors without a
/// buffer view refer to the first. Other content is returned as it is.
std::string WithoutGaps(std::string content);

/// Replaces compressed buffer views and accessors by their content. Without compression it does
/// nothing. Errors: a stream that is cut short or damaged, or larger than its limits. `where` names
/// the file.
Result<void> DecompressGltf(const std::string& where, tinygltf::Model* gltf);

}  // namespace pleinair::compositor
