#include "app/options/observer_options.h"

#include <string_view>

#include <CLI/CLI.hpp>

#include "app/options/number_range.h"
#include "app/sun/sun_table.h"

namespace pleinair::app {

CLI::Option* AddObserverOptions(CLI::App& command, ObserverOptions& options) {
  CLI::Option* at = command.add_option("--at", options.at, "Place: latitude,longitude in degrees")
                        ->type_name("LAT,LON");
  command.add_option("--height", options.height_m, "Metres above the sea")
      ->type_name("M")
      ->check(NumberRange(kObserverFields[2].lowest, kObserverFields[2].highest))
      ->capture_default_str();
  command.add_option("--pressure", options.pressure_mbar, "Air pressure in mbar, for refraction")
      ->type_name("P")
      ->check(NumberRange(kObserverFields[3].lowest, kObserverFields[3].highest))
      ->capture_default_str();
  command.add_option("--temperature", options.temperature_c, "Air temperature in Celsius")
      ->type_name("C")
      ->check(NumberRange(kObserverFields[4].lowest, kObserverFields[4].highest))
      ->capture_default_str();
  command
      .add_option("--dut1", options.ut1_minus_utc_s, "UT1 - UTC in seconds, as IERS publishes it")
      ->type_name("S")
      ->check(NumberRange(-1.0, 1.0))
      ->capture_default_str();
  return at;
}

sky::Observer ObserverWithoutPlace(const ObserverOptions& options) {
  sky::Observer observer;
  observer.height = Metres(options.height_m);
  observer.pressure_mbar = options.pressure_mbar;
  observer.temperature_c = options.temperature_c;
  observer.ut1_minus_utc_s = options.ut1_minus_utc_s;
  return observer;
}

Result<sky::Observer> MakeObserver(const ObserverOptions& options) {
  const std::string& at = options.at;
  const std::size_t comma = at.find(',');
  if (comma == std::string::npos) {
    return InputError("--at", "\"" + at.substr(0, 60) + "\" is not a place",
                      "write latitude and longitude in degrees, for example 50.0875,14.4213");
  }
  sky::Observer observer = ObserverWithoutPlace(options);
  PLEINAIR_RETURN_IF_ERROR(SetObserverField(
      kObserverFields[0], std::string_view(at).substr(0, comma), "--at", &observer));
  PLEINAIR_RETURN_IF_ERROR(SetObserverField(
      kObserverFields[1], std::string_view(at).substr(comma + 1), "--at", &observer));
  return observer;
}

}  // namespace pleinair::app
