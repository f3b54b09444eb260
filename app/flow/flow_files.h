#pragma once

#include <string>

#include "app/flow/flow_lines.h"
#include "base/error.h"

namespace pleinair::app {

/// Whether WriteFlowFile() knows the ending of a name. Error (input): it does not.
Result<void> CheckFlowEnding(const std::string& file);

/// Writes lines by the ending: .csv (a row per vertex), .vtp (VTK), .geojson, .glb (y up), .obj,
/// .svg (a plan). Errors (system): those of writing.
Result<void> WriteFlowFile(const FlowLines& lines, const std::string& file);

std::string FlowCsv(const FlowLines& lines);
std::string FlowVtp(const FlowLines& lines);
/// Longitudes and latitudes; of a file without a place on Earth its own metres.
std::string FlowGeoJson(const FlowLines& lines);
std::string FlowObj(const FlowLines& lines);

/// "left", "wall", …
const char* NameOf(content::LineEnd end);

}  // namespace pleinair::app
