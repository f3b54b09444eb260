#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "content/flow/files/flow_file.h"
#include "content/flow/flow_line.h"

namespace pleinair::app {

/// Reads seeds of a CSV file with the header x,y or x,y,z in the file's coordinates, of geographic
/// files lon,lat or lon,lat,z; optionally t, seconds after the first time of the file. Seeds
/// without t start at `start_s`. Errors (input): another header, a field that is no number, no
/// seeds, more than kMaxSeeds.
Result<std::vector<content::Seed>> ReadSeeds(const std::string& file, const content::FlowFile& flow,
                                             content::Seconds start_s);

constexpr std::size_t kMaxSeeds = 2'000'000;

}  // namespace pleinair::app
