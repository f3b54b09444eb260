#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "content/flow/files/flow_file.h"

namespace pleinair::content {

/// Reads velocities of a VTK file in memory, as ReadFlowFile(): for fuzzing.
Result<FlowFile> ParseVtkFlow(std::string_view bytes, const std::string& where,
                              const FlowFileOptions& options);

}  // namespace pleinair::content
