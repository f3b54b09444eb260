#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/e2e/run_program.h"

namespace pleinair::e2e {

/// Runs `pleinair ARGUMENTS --json`, which must succeed and print one line.
nlohmann::json RunJson(std::vector<std::string> arguments);

/// Parses one JSON value per line.
std::vector<nlohmann::json> JsonLines(const std::string& text);
/// Parses the output of a run, which must have succeeded.
std::vector<nlohmann::json> JsonLines(const RunResult& run);

/// Splits at line feeds, and a line at commas.
std::vector<std::string> Lines(const std::string& text);
std::vector<std::string> Fields(const std::string& line);
/// The fields as numbers; each must be one.
std::vector<double> Numbers(const std::string& line);

}  // namespace pleinair::e2e
