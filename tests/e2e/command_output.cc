#include "tests/e2e/command_output.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace pleinair::e2e {
namespace {

std::vector<std::string> Split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

}  // namespace

nlohmann::json RunJson(std::vector<std::string> arguments) {
  arguments.emplace_back("--json");
  const RunResult run = RunPleinair(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 1) << run.out;
  return nlohmann::json::parse(run.out, nullptr, false);
}

std::vector<nlohmann::json> JsonLines(const std::string& text) {
  const std::vector<std::string> lines = Lines(text);
  std::vector<nlohmann::json> values(lines.size());
  std::ranges::transform(lines, values.begin(),
                         [](const std::string& line) { return nlohmann::json::parse(line); });
  return values;
}

std::vector<nlohmann::json> JsonLines(const RunResult& run) {
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return JsonLines(run.out);
}

std::vector<std::string> Lines(const std::string& text) { return Split(text, '\n'); }
std::vector<std::string> Fields(const std::string& line) { return Split(line, ','); }

std::vector<double> Numbers(const std::string& line) {
  std::vector<double> numbers;
  for (const std::string& field : Fields(line)) numbers.push_back(std::stod(field));
  return numbers;
}

}  // namespace pleinair::e2e
