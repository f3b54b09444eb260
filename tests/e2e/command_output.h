#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace pleinair::e2e {

/// `pleinair ARGUMENTS --json`, which must succeed and print one line.
nlohmann::json RunJson(std::vector<std::string> arguments);

/// What stands between line feeds, and between the commas of a line.
std::vector<std::string> Lines(const std::string& text);
std::vector<std::string> Fields(const std::string& line);
/// The fields as numbers, all of which they must be.
std::vector<double> Numbers(const std::string& line);

}  // namespace pleinair::e2e
