#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/sun_table.h"
#include "base/atomic_file.h"
#include "sky/sun_events.h"

namespace pleinair::app {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  pleinair sun --at 50.0875,14.4213 --time 2025-09-14T11:05:00Z\n"
    "      where the sun stands, and that day's sunrise, noon and sunset\n"
    "  pleinair sun --at=-33.87,151.21 --time 2025-12-21T00:00:00+11:00 \\\n"
    "               --until 2025-12-22T00:00:00+11:00 --step 600\n"
    "      a CSV table, a row every ten minutes\n"
    "  pleinair sun --csv points.csv -o sun.csv\n"
    "      for each row of utc,lat,lon[,height_m,pressure_mbar,temperature_c] (any order, other\n"
    "      columns are kept) four more columns; --csv - reads standard input\n"
    "Columns: azimuth_deg clockwise from true north; elevation_deg without air;\n"
    "elevation_refracted_deg as seen; distance_au.\n";

constexpr const char* kResultColumns =
    "azimuth_deg,elevation_deg,elevation_refracted_deg,distance_au";

struct Options {
  std::string at;
  std::string time;
  std::string until;
  double step_s = 600.0;
  std::string csv;
  std::string model = "precise";
  double height_m = 0.0;
  double pressure_mbar = 1010.0;
  double temperature_c = 10.0;
  double ut1_minus_utc_s = 0.0;
  bool json = false;
  std::string output;
};

Result<std::string> ReadWhole(const std::string& path) {
  const bool standard_input = path == "-";
  const std::string name = standard_input ? "standard input" : path;
  const auto fail = [&](int error_number) {
    return InputError(name, std::string("cannot read: ") + std::strerror(error_number),
                      "name a CSV file, or - for standard input");
  };
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(nullptr, &std::fclose);
  if (!standard_input) {
    opened.reset(std::fopen(path.c_str(), "rb"));
    if (!opened) return fail(errno);
  }
  std::FILE* file = standard_input ? stdin : opened.get();
  std::string text;
  std::array<char, 1 << 16> block;
  while (const std::size_t read = std::fread(block.data(), 1, block.size(), file)) {
    text.append(block.data(), read);
  }
  if (std::ferror(file) != 0) return fail(errno);
  return text;
}

std::string FormatResult(const sky::SunPosition& sun) {
  std::array<char, 128> text;
  std::snprintf(text.data(), text.size(), "%.7f,%.7f,%.7f,%.9f", ToDegrees(sun.azimuth),
                ToDegrees(sun.elevation), ToDegrees(sun.elevation_refracted), sun.distance_au);
  return text.data();
}

std::string FormatJson(UtcTime time, const sky::Observer& observer, const sky::SunPosition& sun) {
  std::array<char, 320> text;
  std::snprintf(text.data(), text.size(),
                "\"utc\":\"%s\",\"lat\":%.9g,\"lon\":%.9g,\"height_m\":%.9g,\"azimuth_deg\":%.7f,"
                "\"elevation_deg\":%.7f,\"elevation_refracted_deg\":%.7f,\"distance_au\":%.9f",
                time.ToString().c_str(), ToDegrees(observer.latitude),
                ToDegrees(observer.longitude), observer.height.value(), ToDegrees(sun.azimuth),
                ToDegrees(sun.elevation), ToDegrees(sun.elevation_refracted), sun.distance_au);
  return text.data();
}

/// Standard output, or a file that appears under its name only when it is complete.
class Output {
 public:
  static Result<Output> Open(const std::string& path) {
    Output output;
    if (path.empty()) return output;
    output.path_ = path;
    output.temporary_ = TemporarySibling(output.path_);
    errno = 0;
    output.file_ =
        std::make_unique<std::ofstream>(output.temporary_, std::ios::binary | std::ios::trunc);
    if (!*output.file_) {
      return tl::make_unexpected(WriteError(output.path_, errno != 0 ? errno : EIO));
    }
    return output;
  }

  std::ostream& stream() { return file_ ? *file_ : std::cout; }

  Result<void> Finish() {
    if (!file_) return {};  // Whoever owns standard output flushes and checks it.
    errno = 0;
    file_->close();
    if (!*file_) {
      const int error_number = errno != 0 ? errno : EIO;
      std::error_code ignored;
      std::filesystem::remove(temporary_, ignored);
      return tl::make_unexpected(WriteError(path_, error_number));
    }
    return CommitFile(temporary_, path_);
  }

 private:
  std::filesystem::path path_, temporary_;
  std::unique_ptr<std::ofstream> file_;
};

/// Positions of many rows on all processors, a block at a time, written in order.
void WriteRows(const std::vector<SunTableRow>& rows, sky::SunModel model, bool json,
               std::ostream& out) {
  constexpr std::size_t kBlock = 1 << 14;
  const std::size_t threads = std::clamp(std::thread::hardware_concurrency(), 1U, 16U);
  std::vector<sky::SunPosition> block(std::min(kBlock, rows.size()));
  for (std::size_t begin = 0; begin < rows.size() && out; begin += kBlock) {
    const std::size_t count = std::min(kBlock, rows.size() - begin);
    const std::size_t workers = std::min(threads, count / 64 + 1);
    const auto compute = [&](std::size_t worker) {
      for (std::size_t i = worker; i < count; i += workers) {
        const SunTableRow& row = rows[begin + i];
        block[i] = sky::ComputeSunPosition(row.observer, row.time, model);
      }
    };
    std::vector<std::jthread> others;
    for (std::size_t worker = 1; worker < workers; ++worker) others.emplace_back(compute, worker);
    compute(0);
    others.clear();  // Joins.
    for (std::size_t i = 0; i < count; ++i) {
      const SunTableRow& row = rows[begin + i];
      if (json) {
        out << '{' << FormatJson(row.time, row.observer, block[i]) << "}\n";
      } else {
        out << row.text << ',' << FormatResult(block[i]) << '\n';
      }
    }
  }
}

Result<void> RunTable(const Options& options, const sky::Observer& defaults, sky::SunModel model) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text, ReadWhole(options.csv));
  PLEINAIR_ASSIGN_OR_RETURN(
      const SunTable table,
      ParseSunTable(text, options.csv == "-" ? "standard input" : options.csv, defaults));
  PLEINAIR_ASSIGN_OR_RETURN(Output output, Output::Open(options.output));
  if (!options.json) output.stream() << table.header << ',' << kResultColumns << '\n';
  WriteRows(table.rows, model, options.json, output.stream());
  return output.Finish();
}

Result<void> RunSeries(const Options& options, const sky::Observer& observer, UtcTime from,
                       UtcTime until, sky::SunModel model) {
  constexpr double kMostRows = 10e6;
  const double seconds =
      static_cast<double>(until.nanoseconds_since_1970() - from.nanoseconds_since_1970()) * 1e-9;
  if (seconds < 0.0) return InputError("--until", "lies before --time", "exchange the two");
  if (!(options.step_s > 0.0) || !std::isfinite(options.step_s)) {
    return InputError("--step", "is not a positive number of seconds", "give for example 600");
  }
  if (seconds / options.step_s >= kMostRows) {
    return InputError("--step", "gives more than ten million rows", "take a longer step");
  }
  const auto count = static_cast<std::size_t>(seconds / options.step_s + 1e-9) + 1;
  std::array<char, 64> place;
  std::snprintf(place.data(), place.size(), ",%.9g,%.9g", ToDegrees(observer.latitude),
                ToDegrees(observer.longitude));
  std::vector<std::string> texts(count);
  std::vector<SunTableRow> rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    rows[i].time = from.PlusSeconds(options.step_s * static_cast<double>(i));
    rows[i].observer = observer;
    texts[i] = rows[i].time.ToString() + place.data();
    rows[i].text = texts[i];
  }
  PLEINAIR_ASSIGN_OR_RETURN(Output output, Output::Open(options.output));
  if (!options.json) output.stream() << "utc,lat,lon," << kResultColumns << '\n';
  WriteRows(rows, model, options.json, output.stream());
  return output.Finish();
}

Result<void> RunMoment(const Options& options, const sky::Observer& observer, UtcTime time,
                       sky::SunModel model) {
  const sky::SunPosition sun = sky::ComputeSunPosition(observer, time, model);
  const sky::SunEvents events = sky::ComputeSunEvents(observer, time, model);
  PLEINAIR_ASSIGN_OR_RETURN(Output output, Output::Open(options.output));
  // Nobody knows the sea's horizon to a fraction of a second.
  const auto to_second = [](UtcTime t) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    return UtcTime((t.nanoseconds_since_1970() +
                    (t.nanoseconds_since_1970() < 0 ? -1 : 1) * kSecond / 2) /
                   kSecond * kSecond)
        .ToString();
  };
  if (options.json) {
    const auto quoted = [&](const std::optional<UtcTime>& t) {
      return t ? "\"" + to_second(*t) + "\"" : std::string("null");
    };
    output.stream() << '{' << FormatJson(time, observer, sun)
                    << ",\"sunrise\":" << quoted(events.sunrise)
                    << ",\"noon\":" << quoted(events.noon)
                    << ",\"sunset\":" << quoted(events.sunset) << "}\n";
    return output.Finish();
  }
  const auto or_none = [&](const std::optional<UtcTime>& t) {
    return t ? to_second(*t) : std::string("none");
  };
  std::array<char, 512> text;
  std::snprintf(text.data(), text.size(),
                "azimuth_deg              %.6f\n"
                "elevation_deg            %.6f\n"
                "elevation_refracted_deg  %.6f\n"
                "distance_au              %.8f\n"
                "sunrise                  %s\n"
                "noon                     %s\n"
                "sunset                   %s\n",
                ToDegrees(sun.azimuth), ToDegrees(sun.elevation),
                ToDegrees(sun.elevation_refracted), sun.distance_au,
                or_none(events.sunrise).c_str(), to_second(events.noon).c_str(),
                or_none(events.sunset).c_str());
  output.stream() << text.data();
  return output.Finish();
}

/// "LAT,LON" in degrees.
Result<void> ParsePlace(const std::string& at, sky::Observer* observer) {
  const std::size_t comma = at.find(',');
  if (comma == std::string::npos) {
    return InputError("--at", "\"" + at.substr(0, 60) + "\" is not a place",
                      "write latitude and longitude in degrees, for example 50.0875,14.4213");
  }
  PLEINAIR_RETURN_IF_ERROR(SetObserverField(
      kObserverFields[0], std::string_view(at).substr(0, comma), "--at", observer));
  return SetObserverField(kObserverFields[1], std::string_view(at).substr(comma + 1), "--at",
                          observer);
}

Result<UtcTime> ParseTimeOption(const char* option, const std::string& text) {
  Result<UtcTime> time = UtcTime::Parse(text);
  if (!time) {
    Error error = std::move(time).error();
    error.where = option;
    return tl::make_unexpected(std::move(error));
  }
  return time;
}

Result<void> Run(const Options& options) {
  sky::Observer observer;
  observer.height = Metres(options.height_m);
  observer.pressure_mbar = options.pressure_mbar;
  observer.temperature_c = options.temperature_c;
  observer.ut1_minus_utc_s = options.ut1_minus_utc_s;
  const sky::SunModel model =
      options.model == "paper" ? sky::SunModel::kPaper : sky::SunModel::kPrecise;
  if (!options.csv.empty()) return RunTable(options, observer, model);
  if (options.at.empty() || options.time.empty()) {
    return InputError("", "pleinair sun needs a place and a time",
                      "give --at LAT,LON and --time T, or --csv FILE; see pleinair sun --help");
  }
  PLEINAIR_RETURN_IF_ERROR(ParsePlace(options.at, &observer));
  PLEINAIR_ASSIGN_OR_RETURN(const UtcTime time, ParseTimeOption("--time", options.time));
  if (options.until.empty()) return RunMoment(options, observer, time, model);
  PLEINAIR_ASSIGN_OR_RETURN(const UtcTime until, ParseTimeOption("--until", options.until));
  return RunSeries(options, observer, time, until, model);
}

}  // namespace

void AddSunCommand(CLI::App& app, CommandResult& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("sun", "Where the sun stands, at a place and a time");
  command->footer(kExamples);
  CLI::Option* at = command->add_option("--at", options->at, "Place: latitude,longitude in degrees")
                        ->type_name("LAT,LON");
  CLI::Option* time =
      command->add_option("--time", options->time, "Moment, RFC 3339 with Z or an offset")
          ->type_name("T");
  CLI::Option* until =
      command->add_option("--until", options->until, "Last moment of a table from --time on")
          ->type_name("T")
          ->needs(time);
  CLI::Option* step = command->add_option("--step", options->step_s, "Seconds between its rows")
                          ->type_name("S")
                          ->capture_default_str()
                          ->needs(until);
  command->add_option("--csv", options->csv, "Table of places and times; - for standard input")
      ->type_name("FILE")
      ->excludes(at)
      ->excludes(time)
      ->excludes(until)
      ->excludes(step);
  command
      ->add_option("--model", options->model,
                   "precise: ERFA, 0.001 degrees; paper: Kolivand & Sunar 2014, 1.4 degrees")
      ->check(CLI::IsMember({"precise", "paper"}))
      ->capture_default_str();
  command->add_option("--height", options->height_m, "Metres above the sea")
      ->type_name("M")
      ->check(CLI::Range(kObserverFields[2].lowest, kObserverFields[2].highest))
      ->capture_default_str();
  command->add_option("--pressure", options->pressure_mbar, "Air pressure in mbar, for refraction")
      ->type_name("P")
      ->check(CLI::Range(kObserverFields[3].lowest, kObserverFields[3].highest))
      ->capture_default_str();
  command->add_option("--temperature", options->temperature_c, "Air temperature in Celsius")
      ->type_name("C")
      ->check(CLI::Range(kObserverFields[4].lowest, kObserverFields[4].highest))
      ->capture_default_str();
  command
      ->add_option("--dut1", options->ut1_minus_utc_s, "UT1 - UTC in seconds, as IERS publishes it")
      ->type_name("S")
      ->check(CLI::Range(-1.0, 1.0))
      ->capture_default_str();
  command->add_flag("--json", options->json, "One JSON object a line");
  command->add_option("-o,--output", options->output, "File instead of standard output")
      ->type_name("FILE");
  command->callback([options, &result] { result.status = Run(*options); });
}

}  // namespace pleinair::app
