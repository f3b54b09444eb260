#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "app/commands/command.h"
#include "app/commands/sun_path_command.h"
#include "app/options/local_time.h"
#include "app/options/observer_options.h"
#include "app/options/option_use.h"
#include "app/sun/sun_day_table.h"
#include "app/sun/sun_rows.h"

namespace pleinair::app {
namespace {

constexpr const char* kSunExamples =
    "Examples:\n"
    "  pleinair sun --at 50.0875,14.4213 --time 2025-09-14T11:05:00Z\n"
    "      where the sun stands, and that day's sunrise, noon, sunset and twilights\n"
    "  pleinair sun --at=-33.87,151.21 --from 2025-12-21T00:00:00+11:00 \\\n"
    "               --to 2025-12-22T00:00:00+11:00 --step 600\n"
    "      a CSV table, a row every ten minutes\n"
    "  pleinair sun --csv points.csv -o sun.csv\n"
    "      for each row of utc,lat,lon[,height_m,pressure_mbar,temperature_c] (any order, other\n"
    "      columns are kept) four more columns; --csv - reads standard input\n"
    "  pleinair sun --at 69.65,18.96 --day 2025-05-17 --utc-offset +02:00\n"
    "      all that the sun does on that day of a clock; with --days 365 a CSV row a day\n"
    "  pleinair sun --at 50.0875,14.4213 --path sun_path.svg --utc-offset +01:00 --year 2025\n"
    "      the year's sun paths as architects draw them (SVG or PNG)\n"
    "Columns: azimuth_deg clockwise from true north; elevation_deg without air;\n"
    "elevation_refracted_deg as seen; distance_au.\n"
    "A zone of the IANA database is written in brackets: 2025-09-14T13:05:00[Europe/Prague].\n"
    "The day of --time is that of its offset or zone, or with Z that of local mean solar time.\n";

constexpr int kFirstYear = 1678;
constexpr int kLastYear = 2261;
constexpr int kMaxDays = 3660;

/// One time, a table from `time` to `until`, or calendar days.
struct SunSpan {
  std::string time, until;
  double step_s = 600.0;
  std::string day;
  int days = 0;
  std::string utc_offset;
};

/// The diagram of a year's sun paths.
struct SunPathPicture {
  std::string file;
  int year = 0;
  int size_px = 1200;
};

struct SunArguments {
  ObserverOptions observer;
  SunSpan span;
  SunPathPicture path;
  std::string csv;
  std::string model = "precise";
  bool json = false;
  std::string output;
};

Result<std::optional<UtcOffset>> ChosenOffset(const SunArguments& arguments) {
  if (arguments.span.utc_offset.empty()) return std::nullopt;
  PLEINAIR_ASSIGN_OR_RETURN(const UtcOffset offset,
                            ParseUtcOffset(arguments.span.utc_offset, "--utc-offset"));
  return offset;
}

Result<void> RunSunDay(const SunArguments& arguments, const sky::Observer& observer,
                       std::optional<UtcOffset> offset, const SunDayOptions& writing) {
  PLEINAIR_ASSIGN_OR_RETURN(const UtcTime midnight, ParseDay(arguments.span.day, offset, "--day"));
  if (arguments.span.days == 0) return WriteSunDay(observer, midnight, *offset, writing);
  return WriteSunAlmanac(observer, midnight, *offset, arguments.span.days, writing);
}

Result<void> RunSunPath(const SunArguments& arguments, const sky::Observer& observer,
                        std::optional<UtcOffset> offset, sky::SunModel model) {
  SunPathOptions path;
  path.file = arguments.path.file;
  path.size_px = arguments.path.size_px;
  path.model = model;
  path.json = arguments.json;
  path.offset = offset.value_or(NauticalOffset(ToDegrees(observer.longitude)));
  if (!arguments.span.time.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(path.moment, ParseTimeOption("--time", arguments.span.time));
    path.year = path.moment->PlusSeconds(path.offset.seconds()).ToCivil().year;
  }
  if (arguments.path.year != 0) path.year = arguments.path.year;
  if (path.year == 0) {
    return InputError("--path", "the year is not given", "give --year, for example --year 2025");
  }
  return WriteSunPath(observer, path);
}

Result<void> RunSun(const CLI::App& command, const SunArguments& arguments) {
  PLEINAIR_RETURN_IF_ERROR(
      RefuseUnusedOptions(command, {{"--utc-offset", arguments.span.until.empty(),
                                     "days and pictures; a span is given in UTC"}}));
  const sky::SunModel model =
      arguments.model == "paper" ? sky::SunModel::kPaper : sky::SunModel::kPrecise;
  const SunRowsOptions rows{model, arguments.json, arguments.output};
  if (!arguments.csv.empty()) {
    return WriteSunTable(arguments.csv, ObserverWithoutPlace(arguments.observer), rows);
  }
  if (arguments.observer.at.empty() ||
      (arguments.span.time.empty() && arguments.span.day.empty() && arguments.path.file.empty())) {
    return InputError("", "pleinair sun needs a place and a time",
                      "give --at LAT,LON and --time T, --day DATE or --path FILE, or --csv FILE; "
                      "see pleinair sun --help");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const sky::Observer observer, MakeObserver(arguments.observer));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<UtcOffset> offset, ChosenOffset(arguments));
  const SunDayOptions writing{model, arguments.json, arguments.output};
  if (!arguments.path.file.empty()) return RunSunPath(arguments, observer, offset, model);
  if (!arguments.span.day.empty()) return RunSunDay(arguments, observer, offset, writing);
  PLEINAIR_ASSIGN_OR_RETURN(const UtcTime time, ParseTimeOption("--time", arguments.span.time));
  if (arguments.span.until.empty()) {
    const std::optional<UtcOffset> calendar = offset ? offset : OffsetOf(arguments.span.time);
    return WriteSunMoment(observer, time, calendar, offset.value_or(UtcOffset{}), writing);
  }
  PLEINAIR_ASSIGN_OR_RETURN(const UtcTime until, ParseTimeOption("--until", arguments.span.until));
  return WriteSunSeries(observer, time, until, arguments.span.step_s, rows);
}

}  // namespace

void AddSunCommand(CLI::App& app, CommandResult& result) {
  auto arguments = std::make_shared<SunArguments>();
  CLI::App* command = app.add_subcommand("sun", "Where the sun stands, at a place and a time");
  command->footer(kSunExamples);
  CLI::Option* at = AddObserverOptions(*command, arguments->observer);
  CLI::Option* time = command
                          ->add_option("--time,--from", arguments->span.time,
                                       "Moment, RFC 3339 with Z, an offset or its [zone]")
                          ->type_name("T");
  CLI::Option* until = command
                           ->add_option("--until,--to", arguments->span.until,
                                        "Last moment of a table from --time on")
                           ->type_name("T")
                           ->needs(time);
  CLI::Option* step =
      command->add_option("--step", arguments->span.step_s, "Seconds between its rows")
          ->type_name("S")
          ->capture_default_str()
          ->needs(until);
  CLI::Option* day = command
                         ->add_option("--day", arguments->span.day,
                                      "Calendar day, as 2025-06-21, of a clock at --utc-offset")
                         ->type_name("DATE")
                         ->excludes(time);
  CLI::Option* days =
      command->add_option("--days", arguments->span.days, "A table of that many days from --day on")
          ->type_name("N")
          ->check(CLI::Range(1, kMaxDays))
          ->needs(day);
  CLI::Option* path =
      command
          ->add_option("--path", arguments->path.file, "Sun-path picture of a year, .svg or .png")
          ->type_name("FILE")
          ->excludes(day)
          ->excludes(until);
  CLI::Option* year = command->add_option("--year", arguments->path.year, "Its year")
                          ->type_name("Y")
                          ->check(CLI::Range(kFirstYear, kLastYear))
                          ->needs(path);
  CLI::Option* size = command->add_option("--size", arguments->path.size_px, "Its width in pixels")
                          ->type_name("N")
                          ->check(CLI::Range(kMinSunPath_px, kMaxSunPath_px))
                          ->capture_default_str()
                          ->needs(path);
  CLI::Option* offset =
      command
          ->add_option("--utc-offset", arguments->span.utc_offset,
                       "Clock for days and hours: local time minus UTC, as +02:00")
          ->type_name("OFFSET");
  CLI::Option* csv =
      command
          ->add_option("--csv", arguments->csv, "Table of places and times; - for standard input")
          ->type_name("FILE");
  for (CLI::Option* other : {at, time, until, step, day, days, path, year, size, offset}) {
    csv->excludes(other);
  }
  command
      ->add_option("--model", arguments->model,
                   "precise: ERFA, 0.001 degrees; paper: Kolivand & Sunar 2014, 1.4 degrees")
      ->check(CLI::IsMember({"precise", "paper"}))
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "One JSON object a line");
  command->add_option("-o,--output", arguments->output, "File instead of standard output")
      ->type_name("FILE")
      ->excludes(path);
  RefuseEmptyValues(*command);
  command->callback(
      [command, arguments, &result] { result.status = RunSun(*command, *arguments); });
}

}  // namespace pleinair::app
