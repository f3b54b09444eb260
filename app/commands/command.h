#pragma once

#include "base/error.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Exit codes of the command (design: 0 success, 1 system error, 2 wrong input or usage).
enum ExitCode { kExitDone = 0, kExitSystem = 1, kExitInput = 2 };

/// Result of the chosen subcommand. main() converts it to the exit code and the error line.
struct CommandResult {
  Result<void> status;
};

// One file per subcommand. Each function adds its subcommand with options, help and examples to
// `app`. Its callback runs it and stores the outcome in `result`. Both outlive the callback. A
// callback writes results to standard output and everything else to standard error. It throws
// nothing.
void AddReplayCommand(CLI::App& app, CommandResult& result);
void AddNewCommand(CLI::App& app, CommandResult& result);
void AddLensCommand(CLI::App& app, CommandResult& result);
void AddCloudsCommand(CLI::App& app, CommandResult& result);
void AddCheckCommand(CLI::App& app, CommandResult& result);
void AddCompareCommand(CLI::App& app, CommandResult& result);
void AddLiveCommand(CLI::App& app, CommandResult& result);
void AddDetectCommand(CLI::App& app, CommandResult& result);
void AddMarkerCommand(CLI::App& app, CommandResult& result);
void AddFilmCommand(CLI::App& app, CommandResult& result);
void AddTargetCommand(CLI::App& app, CommandResult& result);
void AddBoardCommand(CLI::App& app, CommandResult& result);
void AddModelCommand(CLI::App& app, CommandResult& result);
void AddLeafCommand(CLI::App& app, CommandResult& result);
void AddPathCommand(CLI::App& app, CommandResult& result);
void AddCalibrateCommand(CLI::App& app, CommandResult& result);
void AddResponseCommand(CLI::App& app, CommandResult& result);
void AddSunCommand(CLI::App& app, CommandResult& result);
void AddSkyCommand(CLI::App& app, CommandResult& result);
void AddAccuracyCommand(CLI::App& app, CommandResult& result);
void AddReportCommand(CLI::App& app, CommandResult& result);
void AddDevicesCommand(CLI::App& app, CommandResult& result);
void AddBenchCommand(CLI::App& app, CommandResult& result);
void AddPlaceCommand(CLI::App& app, CommandResult& result);
void AddTerrainCommand(CLI::App& app, CommandResult& result);
void AddDrapeCommand(CLI::App& app, CommandResult& result);
void AddFlowCommand(CLI::App& app, CommandResult& result);
void AddRecoverCommand(CLI::App& app, CommandResult& result);
void AddDoctorCommand(CLI::App& app, CommandResult& result);

/// Parses the command line, runs the subcommand and returns the exit code. An error is one line on
/// standard error: "pleinair: file: cause; way out". A failed write to standard output (a full disk
/// behind a redirection) is an error too.
int RunCommandLine(int argc, const char* const* argv);

}  // namespace pleinair::app
