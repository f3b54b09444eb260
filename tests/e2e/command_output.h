#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/e2e/run_program.h"

namespace pleinair::e2e {

/// `pleinair ARGUMENTS --json`, which must succeed and print one line.
nlohmann::json RunJson(std::vector<std::string> arguments);

/// One JSON value a line.
std::vector<nlohmann::json> JsonLines(const std::string& text);
/// The same of what a run printed, which must have succeeded.
std::vector<nlohmann::json> JsonLines(const RunResult& run);

/// What stands between line feeds, and between the commas of a line.
std::vector<std::string> Lines(const std::string& text);
std::vector<std::string> Fields(const std::string& line);
/// The fields as numbers, all of which they must be.
std::vector<double> Numbers(const std::string& line);

}  // namespace pleinair::e2e
