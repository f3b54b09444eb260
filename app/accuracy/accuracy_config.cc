#include "app/accuracy/accuracy_config.h"

#include <fmt/format.h>

#include <algorithm>

#include "accuracy/sweeps.h"
#include "app/accuracy/record_fields.h"

namespace pleinair::app {

namespace {

/// The configuration is const when it is written.
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
  return LineOf(writer.json);
}

Result<AccuracyConfig> ParseConfig(const std::string& text, const std::string& file) {
  const auto refusal = InputError(file, "does not hold the configuration of an accuracy run",
                                  "name a folder that this version of 'pleinair accuracy' wrote");
  PLEINAIR_ASSIGN_OR_RETURN(
      AccuracyConfig config,
      ReadJson<AccuracyConfig>(text, refusal,
                               [](const RecordJsonValue& json, AccuracyConfig* read) {
                                 FieldReader reader(json);
                                 TellConfig(reader, *read);
                               }));
  const auto is_among = [](const std::string& name, const std::vector<std::string>& known) {
    return std::find(known.begin(), known.end(), name) != known.end();
  };
  const bool has_sweeps = std::all_of(
      config.sweeps.begin(), config.sweeps.end(),
      [&](const std::string& sweep) { return is_among(sweep, accuracy::SweepNames()); });
  if (!has_sweeps || !is_among(config.camera, accuracy::SweepCameraNames())) return refusal;
  if (config.scale < kMinScale || config.scale > kMaxScale) {
    return InputError(
        file,
        fmt::format("its scale of {} is not from {} to {}", config.scale, kMinScale, kMaxScale),
        "measure it again");
  }
  if (config.spoil_corners_px < 0.0 || config.spoil_corners_px > kMostSpoil_px) {
    return InputError(file,
                      fmt::format("its spoil_corners_px of {} is not from 0 to {}",
                                  config.spoil_corners_px, kMostSpoil_px),
                      "measure it again");
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
