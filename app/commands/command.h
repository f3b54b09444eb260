#pragma once

#include "base/error.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Exit codes of the command (design: 0 done, 1 could not, 2 the input or usage is wrong).
enum ExitCode { kExitDone = 0, kExitSystem = 1, kExitInput = 2 };

/// How the chosen subcommand ended; main() turns it into the exit code and the one line of error.
struct CommandResult {
  Result<void> status;
};

// One file a subcommand. Each of these adds its subcommand with its options, help and examples to
// `app`, and a callback that runs it and leaves its outcome in `result`; both outlive the
// callback. A callback writes results to standard output and everything else to standard error,
// and throws nothing.
void AddReplayCommand(CLI::App& app, CommandResult& result);
void AddCompareCommand(CLI::App& app, CommandResult& result);
void AddLiveCommand(CLI::App& app, CommandResult& result);
void AddDetectCommand(CLI::App& app, CommandResult& result);
void AddMarkerCommand(CLI::App& app, CommandResult& result);
void AddTargetCommand(CLI::App& app, CommandResult& result);
void AddBoardCommand(CLI::App& app, CommandResult& result);
void AddPathCommand(CLI::App& app, CommandResult& result);
void AddCalibrateCommand(CLI::App& app, CommandResult& result);
void AddSunCommand(CLI::App& app, CommandResult& result);
void AddSkyCommand(CLI::App& app, CommandResult& result);
void AddAccuracyCommand(CLI::App& app, CommandResult& result);
void AddReportCommand(CLI::App& app, CommandResult& result);
void AddDevicesCommand(CLI::App& app, CommandResult& result);
void AddBenchCommand(CLI::App& app, CommandResult& result);
void AddDoctorCommand(CLI::App& app, CommandResult& result);

/// Parses the command line, runs the subcommand and gives the exit code. An error is one line on
/// standard error, "pleinair: file: cause; way out"; a result that could not be written to
/// standard output (a full disk behind a redirection) is an error too.
int RunCommandLine(int argc, const char* const* argv);

}  // namespace pleinair::app
