#include "app/commands/command.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include <CLI/CLI.hpp>

#include "app/options/output_options.h"

namespace pleinair::app {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  pleinair new walk.mov --model chair.glb -o site\n"
    "  pleinair check site\n"
    "  pleinair replay recordings/courtyard_midday -o out/demo\n"
    "  pleinair compare out/demo recordings/courtyard_midday\n"
    "  pleinair detect photo.jpg --calibration camera.yaml --size-mm 140\n"
    "  pleinair marker 17 -o marker.pdf\n"
    "  pleinair film walk.mov\n"
    "  pleinair calibrate --charuco 8x6 photos/ -o camera.json\n"
    "  pleinair response my_recording -o camera.response\n"
    "  pleinair lens my_recording\n"
    "  pleinair clouds out/demo >> scene.toml\n"
    "  pleinair target poster.jpg --width-mm 420 -o poster.target\n"
    "  pleinair model sculpture.glb -o sheet.png\n"
    "  pleinair leaf --chlorophyll 45 --carotenoids 9 -o leaf.png\n"
    "  pleinair path convert out/demo/poses/sg_17.tum path.glb --calibration camera.json\n"
    "  pleinair place parcels.gpkg --at 50.0875,14.4213,220 --plan plan.svg\n"
    "  pleinair terrain dem.tif --scene scene.toml -o terrain.obj\n"
    "  pleinair flow wind.nc --spacing 500 -o lines.geojson\n"
    "  pleinair sun --at 50.0875,14.4213 --time 2025-09-14T11:05:00Z\n"
    "  pleinair sky --at 50.0875,14.4213 --time 2025-09-14T17:00:00Z -o dome.png\n"
    "  pleinair live --camera file:recordings/courtyard_midday --headless\n"
    "  pleinair recover walk -o walk_clean\n"
    "  pleinair accuracy --quick -o out/quick\n"
    "  pleinair devices\n"
    "  pleinair doctor\n"
    "'pleinair SUBCOMMAND --help' explains more. Exit codes: 0 done, 1 could not, 2 the input or\n"
    "the usage is wrong.";

/// Messages are one line, whatever a file's name or a library's text contains.
std::string OneLine(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text;
}

int Fail(const std::string& message, ExitCode code) {
  std::cerr << "pleinair: " << OneLine(message) << '\n';
  return code;
}

/// Ends parsing before the chosen subcommand runs.
struct OutputRefused {
  Error error;
};

int Fail(const Error& error) {
  return Fail(error.Message(), error.kind == ErrorKind::kInput ? kExitInput : kExitSystem);
}

/// Standard output may be a file on a full disk: printed text counts only when it is flushed.
int FlushOutput(int code) {
  // Long texts fail before the end, and leave their cause.
  if (std::cout && std::ferror(stdout) == 0) errno = 0;
  std::cout.flush();
  const bool failed = !std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (!failed || code != kExitDone) return code;
  const int cause = errno != 0 ? errno : EIO;
  return Fail(std::string("standard output: cannot write: ") + std::strerror(cause) +
                  (cause == ENOSPC ? "; free some space or send the output elsewhere"
                                   : "; send the output elsewhere"),
              kExitSystem);
}

}  // namespace

int RunCommandLine(int argc, const char* const* argv) {
  try {
    CLI::App app{
        "pleinair composes virtual objects into outdoor video, anchored to a printed\n"
        "marker and lit by that day's sun and sky.",
        "pleinair"};
    app.footer(kExamples);
    app.set_version_flag("--version", "pleinair " PLEINAIR_VERSION);
    app.require_subcommand(0, 1);
    CommandResult result;
    AddReplayCommand(app, result);
    AddNewCommand(app, result);
    AddCheckCommand(app, result);
    AddCloudsCommand(app, result);
    AddCompareCommand(app, result);
    AddLiveCommand(app, result);
    AddDetectCommand(app, result);
    AddMarkerCommand(app, result);
    AddFilmCommand(app, result);
    AddTargetCommand(app, result);
    AddBoardCommand(app, result);
    AddModelCommand(app, result);
    AddLeafCommand(app, result);
    AddPathCommand(app, result);
    AddCalibrateCommand(app, result);
    AddResponseCommand(app, result);
    AddLensCommand(app, result);
    AddPlaceCommand(app, result);
    AddTerrainCommand(app, result);
    AddDrapeCommand(app, result);
    AddFlowCommand(app, result);
    AddSunCommand(app, result);
    AddSkyCommand(app, result);
    AddAccuracyCommand(app, result);
    AddReportCommand(app, result);
    AddDevicesCommand(app, result);
    AddBenchCommand(app, result);
    AddRecoverCommand(app, result);
    AddDoctorCommand(app, result);
    app.parse_complete_callback([&app] {
      if (auto allowed = CheckOutputOptions(app); !allowed) throw OutputRefused{allowed.error()};
    });
    try {
      app.parse(argc, argv);
    } catch (const OutputRefused& refused) {
      return Fail(refused.error);
    } catch (const CLI::Success& success) {  // --help, --version
      return FlushOutput(app.exit(success, std::cout, std::cerr));
    } catch (const CLI::ParseError& error) {
      const auto chosen = app.get_subcommands();
      const std::string help =
          chosen.empty() ? "pleinair --help" : "pleinair " + chosen[0]->get_name() + " --help";
      return Fail(std::string(error.what()) + "; see '" + help + "'", kExitInput);
    }
    if (app.get_subcommands().empty()) {
      std::cerr << app.help();
      return kExitInput;
    }
    if (!result.status) return Fail(result.status.error());
    return FlushOutput(kExitDone);
  } catch (const std::bad_alloc&) {
    return Fail("out of memory; use a smaller input, or a machine with more memory", kExitSystem);
  } catch (const std::exception& error) {
    return Fail(std::string("unexpected failure: ") + error.what() + "; please report it",
                kExitSystem);
  }
}

}  // namespace pleinair::app
