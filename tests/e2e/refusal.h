#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "tests/e2e/run_program.h"

namespace pleinair::e2e {

/// A command line that cannot be carried out, and what the one line of error must name. OUT in an
/// argument is an empty folder, in which nothing may be left.
struct Refusal {
  const char* name;
  std::vector<std::string> arguments;  ///< Behind the subcommand.
  std::string message;
};
inline void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.name; }

/// One line that names what is wrong, nothing on standard output.
void ExpectRefused(const RunResult& run, const std::string& message, int exit_code = 2);

/// The same of a command that is run here, and nothing written.
void ExpectRefusal(const std::string& subcommand, const Refusal& refusal);

/// The same for `--csv` of a table whose third line is `broken`, to standard output and to a file:
/// the error names that line.
void ExpectBrokenLineIsNamed(const std::vector<std::string>& command,
                             const std::string& header_and_row, const std::string& broken,
                             const std::string& row_after);

}  // namespace pleinair::e2e
