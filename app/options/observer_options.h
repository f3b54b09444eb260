#pragma once

#include <string>

#include "base/error.h"
#include "sky/sun/sun_position.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace pleinair::app {

/// The observer, as on the command line.
struct ObserverOptions {
  std::string at;
  double height_m = 0.0;
  double pressure_mbar = 1010.0;
  double temperature_c = 10.0;
  double ut1_minus_utc_s = 0.0;
};

/// Adds --at, --height, --pressure, --temperature and --dut1; returns --at. `options` must outlive
/// the command.
CLI::Option* AddObserverOptions(CLI::App& command, ObserverOptions& options);

/// All except the place: the defaults for the rows of a table.
sky::Observer ObserverWithoutPlace(const ObserverOptions& options);

/// Errors (input): --at is not "LAT,LON" in degrees, or not on Earth.
Result<sky::Observer> MakeObserver(const ObserverOptions& options);

}  // namespace pleinair::app
