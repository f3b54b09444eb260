#include "devices/recordings/euroc.h"

#include <charconv>
#include <cmath>

#include "devices/recordings/recording_manifest.h"
#include "files/json_fields.h"

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
                        "write the bare name of an image");
    }
    if (!frames.empty() && frame.timestamp_ns <= frames.back().timestamp_ns) {
      return InputError(where, "is not later than the line before", "sort the lines by time");
    }
    if (!frames.empty()) {
      const double step_s =
          1e-9 * static_cast<double>(frame.timestamp_ns - frames.back().timestamp_ns);
      if (step_s < kMinStep_s || step_s > kMaxStep_s) {
        return InputError(where, "is less than 0.00001 s or more than a year after the line before",
                          "write time stamps in nanoseconds");
      }
    }
    frames.push_back(std::move(frame));
  }
  if (frames.empty()) return InputError(name, "lists no frames", "get a whole copy of it");
  return frames;
}

Result<std::optional<double>> ParseEurocRate(std::string_view bytes, const std::string& name) {
  PLEINAIR_ASSIGN_OR_RETURN(const files::Json document, files::ParseYaml(bytes, name));
  const files::JsonFields fields(document, name);
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> rate_hz, fields.Number("rate_hz"));
  if (rate_hz && (*rate_hz < kMinRate_hz || *rate_hz > kMaxRate_hz)) {
    return fields.Fail("rate_hz", "is outside 1e-7 to 1e5", "give frames a second");
  }
  return rate_hz;
}

Result<Transform<EurocBody, Camera>> ParseEurocExtrinsics(std::string_view bytes,
                                                          const std::string& name) {
  PLEINAIR_ASSIGN_OR_RETURN(const files::Json document, files::ParseYaml(bytes, name));
  const files::JsonFields fields = files::JsonFields(document, name).Object("T_BS");
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::vector<double>> data, fields.Numbers("data"));
  if (!data || data->size() != 16) {
    return InputError(name, "has no T_BS with data of 4 x 4 numbers",
                      "name the sensor.yaml of a EuRoC camera");
  }
  const std::vector<double>& m = *data;
  const Transform<EurocBody, Camera> body_from_camera{
      {{m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]}}, {m[3], m[7], m[11]}};
  const Mat3& r = body_from_camera.rotation;
  const Mat3 square = r * r.Transposed();
  // Files have six digits or more.
  constexpr double kTolerance = 1e-3;
  bool rigid = m[12] == 0.0 && m[13] == 0.0 && m[14] == 0.0 && m[15] == 1.0;
  for (int i = 0; i < 9; ++i) rigid = rigid && std::abs(square.m[i] - Mat3().m[i]) < kTolerance;
  const double determinant = Dot(Cross({r(0, 0), r(0, 1), r(0, 2)}, {r(1, 0), r(1, 1), r(1, 2)}),
                                 {r(2, 0), r(2, 1), r(2, 2)});
  if (!rigid || determinant < 0.0) {
    return InputError(name, "has a T_BS that is no rigid motion",
                      "its left upper 3 x 3 must be a rotation, its last row 0 0 0 1");
  }
  return body_from_camera;
}

}  // namespace pleinair::devices
