#include "devices/euroc.h"

#include <charconv>

#include "devices/json_fields.h"

namespace pleinair::devices {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

}  // namespace

Result<std::vector<EurocFrame>> ParseEurocTable(std::string_view bytes, const std::string& name) {
  std::vector<EurocFrame> frames;
  for (int line_number = 1; !bytes.empty(); ++line_number) {
    const std::size_t end = bytes.find('\n');
    const std::string_view line = Trimmed(bytes.substr(0, end));
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
    if (line.empty() || line.front() == '#') continue;
    const std::string where = name + ":" + std::to_string(line_number);

    EurocFrame frame;
    const std::size_t comma = line.find(',');
    const std::string_view stamp = Trimmed(line.substr(0, comma));
    const auto [stop, error] =
        std::from_chars(stamp.data(), stamp.data() + stamp.size(), frame.timestamp_ns);
    if (comma == std::string_view::npos || error != std::errc() ||
        stop != stamp.data() + stamp.size() || frame.timestamp_ns < 0) {
      return InputError(where, "is not a time stamp in nanoseconds, a comma and a file name",
                        "write lines such as 1403636579763555584,1403636579763555584.png");
    }
    frame.file = Trimmed(line.substr(comma + 1));
    if (frame.file.empty() || frame.file == "." || frame.file == ".." ||
        frame.file.find_first_of(std::string_view("/\\\0", 3)) != std::string::npos) {
      return InputError(where, "does not name a file in the folder data/",
                        "write the bare name of a picture");
    }
    if (!frames.empty() && frame.timestamp_ns <= frames.back().timestamp_ns) {
      return InputError(where, "is not later than the line before", "sort the lines by time");
    }
    frames.push_back(std::move(frame));
  }
  if (frames.empty()) return InputError(name, "lists no frames", "get a whole copy of it");
  return frames;
}

Result<std::optional<double>> ParseEurocRate(std::string_view bytes, const std::string& name) {
  PLEINAIR_ASSIGN_OR_RETURN(const Json document, ParseYaml(bytes, name));
  const JsonFields fields(document, name);
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> rate_hz, fields.Number("rate_hz"));
  if (rate_hz && *rate_hz <= 0.0) return fields.Fail("rate_hz", "is not greater than zero");
  return rate_hz;
}

}  // namespace pleinair::devices
