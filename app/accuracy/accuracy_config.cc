#include "app/accuracy/accuracy_config.h"

#include <fmt/format.h>

#include "accuracy/sweeps.h"
#include "app/accuracy/record_fields.h"

namespace pleinair::app {

namespace {

/// The configuration is const where it is written.
template <typename Visitor, typename Config>
void TellConfig(Visitor& visit, Config& config) {
  visit.Field("sweeps", config.sweeps);
  visit.Field("size", config.camera);
  visit.Field("seed", config.seed);
  visit.Field("noise_seed", config.noise_seed);
  visit.Field("scale", config.scale);
  visit.Field("recordings", config.recordings);
  visit.Field("light", config.light);
  visit.Field("against", config.peers);
  visit.Field("numbers", config.numbers);
  visit.Field("measure", config.measure);
  visit.Field("spoil_corners_px", config.spoil_corners_px);
}

}  // namespace

std::string ConfigJson(const AccuracyConfig& config) {
  FieldWriter writer;
  TellConfig(writer, config);
  return writer.json.dump(-1, ' ', false, RecordJsonValue::error_handler_t::replace);
}

Result<AccuracyConfig> ParseConfig(const std::string& text, const std::string& file) {
  const auto json = RecordJsonValue::parse(text, nullptr, false);
  AccuracyConfig config;
  try {
    FieldReader reader(json);
    TellConfig(reader, config);
  } catch (const RecordJsonValue::exception&) {
    return InputError(file, "does not hold the configuration of an accuracy run",
                      "name a folder that this version of 'pleinair accuracy' wrote");
  }
  return config;
}

std::string CommandOf(const AccuracyConfig& config) {
  std::string command = "pleinair accuracy";
  for (const std::string& recording : config.recordings) command += " " + recording;
  if (!config.sweeps.empty()) {
    command += fmt::format(" --sweep {}", config.sweeps == accuracy::SweepNames()
                                              ? std::string("all")
                                              : fmt::format("{}", fmt::join(config.sweeps, ",")));
  }
  command += fmt::format(" --size {} --seed {} --noise-seed {} --scale {}", config.camera,
                         config.seed, config.noise_seed, config.scale);
  if (!config.peers.empty()) command += fmt::format(" --against {}", fmt::join(config.peers, ","));
  if (!config.numbers.empty())
    command += fmt::format(" --numbers {}", fmt::join(config.numbers, ","));
  if (!config.recordings.empty() && !config.light) command += " --no-light";
  command += " --measure " + config.measure;
  if (config.spoil_corners_px != 0.0) {
    command += fmt::format(" --spoil-corners-px {}", config.spoil_corners_px);
  }
  return command;
}

}  // namespace pleinair::app
