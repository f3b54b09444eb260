#include "app/sun/sun_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <ostream>
#include <vector>

#include "app/sun/sun_table.h"
#include "app/terminal/progress_bar.h"
#include "base/parallel_for.h"
#include "files/result_file.h"

namespace pleinair::app {
namespace {

std::string FormatColumns(const sky::SunPosition& sun) {
  std::array<char, 128> text;
  std::snprintf(text.data(), text.size(), "%.7f,%.7f,%.7f,%.9f", ToDegrees(sun.azimuth),
                ToDegrees(sun.elevation), ToDegrees(sun.elevation_refracted), sun.distance_au);
  return text.data();
}

/// Computes the positions of many rows on all processors, block by block, and writes them in order.
void WriteRows(const std::vector<SunTableRow>& rows, const SunRowsOptions& options,
               std::ostream& out) {
  constexpr std::size_t kBlock = 1 << 14;
  constexpr std::size_t kChunk = 64;  // A thread costs as much as a few positions.
  std::vector<sky::SunPosition> block(std::min(kBlock, rows.size()));
  ProgressBar bar("sun", static_cast<std::int64_t>((rows.size() + kBlock - 1) / kBlock), "blocks");
  for (std::size_t begin = 0; begin < rows.size() && out; begin += kBlock) {
    const std::size_t count = std::min(kBlock, rows.size() - begin);
    ParallelFor((count + kChunk - 1) / kChunk, 0, [&](std::size_t chunk) {
      const std::size_t end = std::min(count, (chunk + 1) * kChunk);
      for (std::size_t i = chunk * kChunk; i < end; ++i) {
        const SunTableRow& row = rows[begin + i];
        block[i] = sky::ComputeSunPosition(row.observer, row.time, options.model);
      }
    });
    for (std::size_t i = 0; i < count; ++i) {
      const SunTableRow& row = rows[begin + i];
      if (options.json) {
        out << '{' << SunPositionJson(row.time, row.observer, block[i]) << "}\n";
      } else {
        out << row.text << ',' << FormatColumns(block[i]) << '\n';
      }
    }
    bar.Advance();
  }
}

}  // namespace

std::string SunPositionJson(UtcTime time, const sky::Observer& observer,
                            const sky::SunPosition& sun) {
  std::array<char, 320> text;
  std::snprintf(text.data(), text.size(),
                "\"utc\":\"%s\",\"lat\":%.9g,\"lon\":%.9g,\"height_m\":%.9g,\"azimuth_deg\":%.7f,"
                "\"elevation_deg\":%.7f,\"elevation_refracted_deg\":%.7f,\"distance_au\":%.9f",
                time.ToString().c_str(), ToDegrees(observer.latitude),
                ToDegrees(observer.longitude), observer.height.value(), ToDegrees(sun.azimuth),
                ToDegrees(sun.elevation), ToDegrees(sun.elevation_refracted), sun.distance_au);
  return text.data();
}

Result<void> WriteSunTable(const std::string& csv, const sky::Observer& defaults,
                           const SunRowsOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text, files::ReadTextFile(csv));
  PLEINAIR_ASSIGN_OR_RETURN(const SunTable table,
                            ParseSunTable(text, files::TextFileName(csv), defaults));
  PLEINAIR_ASSIGN_OR_RETURN(files::ResultFile output, files::ResultFile::Open(options.output));
  if (!options.json) output.stream() << table.header << ',' << kSunColumns << '\n';
  WriteRows(table.rows, options, output.stream());
  return output.Finish();
}

Result<void> WriteSunSeries(const sky::Observer& observer, UtcTime from, UtcTime until,
                            double step_s, const SunRowsOptions& options) {
  constexpr double kMaxRows = 10e6;
  const double seconds =
      static_cast<double>(until.nanoseconds_since_1970() - from.nanoseconds_since_1970()) * 1e-9;
  if (seconds < 0.0) return InputError("--until", "lies before --time", "exchange the two");
  if (!(step_s > 0.0) || !std::isfinite(step_s)) {
    return InputError("--step", "is not a positive number of seconds", "give for example 600");
  }
  if (seconds / step_s >= kMaxRows) {
    return InputError("--step", "gives more than ten million rows", "take a longer step");
  }
  const auto count = static_cast<std::size_t>(seconds / step_s + 1e-9) + 1;
  std::array<char, 64> place;
  std::snprintf(place.data(), place.size(), ",%.9g,%.9g", ToDegrees(observer.latitude),
                ToDegrees(observer.longitude));
  std::vector<std::string> texts(count);
  std::vector<SunTableRow> rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    rows[i].time = from.PlusSeconds(step_s * static_cast<double>(i));
    rows[i].observer = observer;
    texts[i] = rows[i].time.ToString() + place.data();
    rows[i].text = texts[i];
  }
  PLEINAIR_ASSIGN_OR_RETURN(files::ResultFile output, files::ResultFile::Open(options.output));
  if (!options.json) output.stream() << "utc,lat,lon," << kSunColumns << '\n';
  WriteRows(rows, options, output.stream());
  return output.Finish();
}

}  // namespace pleinair::app
