#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "tests/e2e/run_program.h"

namespace pleinair::e2e {

/// An invalid command line, and what the one-line error must name. OUT in an argument is an empty
/// folder, which must remain empty.
struct Refusal {
  const char* name;
  std::vector<std::string> arguments;  ///< After the subcommand.
  std::string message;
};
inline void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.name; }

/// Expects a one-line error that names the fault, and nothing on standard output.
void ExpectRefused(const RunResult& run, const std::string& message, int exit_code = 2);

/// Runs the command, expects the same, and no files.
void ExpectRefusal(const std::string& subcommand, const Refusal& refusal);

/// The same for `--csv` with a table whose third line is `broken`, to standard output and to a
/// file. The error must name that line.
void ExpectBrokenLineIsNamed(const std::vector<std::string>& command,
                             const std::string& header_and_row, const std::string& broken,
                             const std::string& row_after);

}  // namespace pleinair::e2e
