#include "app/accuracy/accuracy_config.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "accuracy/sweeps.h"

namespace pleinair::app {

using Json = nlohmann::ordered_json;

std::string ConfigJson(const AccuracyConfig& config) {
  const Json json{{"sweeps", config.sweeps},
                  {"size", config.camera},
                  {"seed", config.seed},
                  {"noise_seed", config.noise_seed},
                  {"scale", config.scale},
                  {"recordings", config.recordings},
                  {"against", config.peers},
                  {"measure", config.measure},
                  {"spoil_corners_px", config.spoil_corners_px}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<AccuracyConfig> ParseConfig(const std::string& text, const std::string& file) {
  try {
    const Json json = Json::parse(text);
    AccuracyConfig config;
    json.at("sweeps").get_to(config.sweeps);
    json.at("size").get_to(config.camera);
    json.at("seed").get_to(config.seed);
    json.at("noise_seed").get_to(config.noise_seed);
    json.at("scale").get_to(config.scale);
    json.at("recordings").get_to(config.recordings);
    json.at("against").get_to(config.peers);
    json.at("measure").get_to(config.measure);
    json.at("spoil_corners_px").get_to(config.spoil_corners_px);
    return config;
  } catch (const Json::exception&) {
    return InputError(file, "does not hold the configuration of an accuracy run",
                      "name a folder that 'pleinair accuracy' wrote");
  }
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
  command += " --measure " + config.measure;
  if (config.spoil_corners_px != 0.0) {
    command += fmt::format(" --spoil-corners-px {}", config.spoil_corners_px);
  }
  return command;
}

}  // namespace pleinair::app
