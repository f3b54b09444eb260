#pragma once

// Internal: between the .cc files of this module; not installed.

#include <string>

#include "base/error.h"

namespace tinygltf {
class Model;
}

namespace pleinair::compositor {

/// Extensions whose content this build decompresses: EXT_meshopt_compression and
/// KHR_draco_mesh_compression with the libraries meshoptimizer and Draco.
bool CanDecompress(const std::string& extension);

/// The content of a compressed glTF file, text or binary, without the gaps that its extensions
/// leave and tinygltf refuses: buffers without data become one byte, and accessors without a buffer
/// view refer to the first. Other content is returned as it is.
std::string WithoutGaps(std::string content);

/// Replaces compressed buffer views and accessors by their content. Without compression it does
/// nothing. Errors: a stream that is cut short or damaged, or larger than its limits. `where` names
/// the file.
Result<void> DecompressGltf(const std::string& where, tinygltf::Model* gltf);

}  // namespace pleinair::compositor
