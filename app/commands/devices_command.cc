#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "devices/cameras/camera_list.h"

namespace pleinair::app {
namespace {

constexpr const char* kDevicesExamples =
    "Examples:\n"
    "  pleinair devices\n"
    "      the cameras that are plugged in, with their sizes, rates and controls\n"
    "  pleinair devices --network\n"
    "      GigE Vision cameras, too, found by a broadcast on every network\n"
    "  pleinair devices --json\n"
    "      one JSON object a camera\n"
    "The first name of a camera is its identity: it stays when the camera is plugged in elsewhere\n"
    "(serial=) or when the machine is restarted (bus=).\n";

struct DevicesOptions {
  bool json = false;
  bool network = false;
};

std::string Rates(const std::vector<double>& rates_hz) {
  std::string text;
  for (const double rate : rates_hz)
    text += fmt::format("{}{:.4g}", text.empty() ? "" : ", ", rate);
  return text.empty() ? text : " at " + text + " Hz";
}

const char* Unit(devices::CameraControl control) {
  switch (control) {
    case devices::CameraControl::kExposure:
      return " s";
    case devices::CameraControl::kWhiteBalance:
      return " K";
    case devices::CameraControl::kGain:
    case devices::CameraControl::kFocus:
      return "";
  }
  return "";
}

std::string Sizes(const devices::FormatDescription& format) {
  std::string text;
  for (const auto& at : format.sizes) {
    text +=
        fmt::format("              {}x{}{}\n", at.size.width, at.size.height, Rates(at.rates_hz));
  }
  return text;
}

/// Groups formats of equal sizes. Formats that cannot be read here appear by name only.
void PrintFormats(const std::vector<devices::FormatDescription>& formats) {
  std::vector<std::pair<std::string, std::string>> names_of_sizes;
  std::string not_read;
  const auto append = [](const std::string& name, std::string* names) {
    *names += (names->empty() ? "" : ", ") + name;
  };
  for (const devices::FormatDescription& format : formats) {
    if (!format.format) {
      append(format.name, &not_read);
      continue;
    }
    const std::string sizes = Sizes(format);
    const auto same = std::find_if(names_of_sizes.begin(), names_of_sizes.end(),
                                   [&](const auto& each) { return each.second == sizes; });
    if (same != names_of_sizes.end()) {
      append(format.name, &same->first);
    } else {
      names_of_sizes.emplace_back(format.name, sizes);
    }
  }
  for (const auto& [names, sizes] : names_of_sizes) {
    fmt::print("  pictures  {}\n{}", names, sizes);
  }
  if (!not_read.empty()) fmt::print("  not read  {}\n", not_read);
}

void PrintCamera(const devices::CameraDescription& camera) {
  fmt::print("{}\n", camera.uri);
  if (camera.node != camera.uri) fmt::print("  now at    {}\n", camera.node);
  if (!camera.name.empty()) {
    fmt::print("  name      {} ({}, {})\n", camera.name, camera.driver, camera.bus);
  }
  if (!camera.serial.empty()) fmt::print("  serial    {}\n", camera.serial);
  if (!camera.trouble.empty()) fmt::print("  problem   {}\n", camera.trouble);
  PrintFormats(camera.formats);
  for (const devices::ControlRange& range : camera.controls) {
    const char* unit = Unit(range.control);
    const char* automatic = range.is_auto ? ", automatic" : range.has_auto ? ", locked" : "";
    fmt::print("  control   {}: {:g}{} ({:g} to {:g}{}){}\n", NameOf(range.control), range.value,
               unit, range.lowest, range.highest, unit, automatic);
  }
}

nlohmann::json CameraJson(const devices::CameraDescription& camera) {
  nlohmann::json formats = nlohmann::json::array();
  for (const auto& format : camera.formats) {
    nlohmann::json sizes = nlohmann::json::array();
    for (const auto& at : format.sizes) {
      sizes.push_back(
          {{"width", at.size.width}, {"height", at.size.height}, {"rates_hz", at.rates_hz}});
    }
    formats.push_back(
        {{"name", format.name}, {"readable", format.format.has_value()}, {"sizes", sizes}});
  }
  nlohmann::json controls = nlohmann::json::array();
  for (const devices::ControlRange& range : camera.controls) {
    controls.push_back({{"name", NameOf(range.control)},
                        {"lowest", range.lowest},
                        {"highest", range.highest},
                        {"value", range.value},
                        {"has_auto", range.has_auto},
                        {"is_auto", range.is_auto}});
  }
  return {{"uri", camera.uri},
          {"node", camera.node},
          {"name", camera.name},
          {"driver", camera.driver},
          {"bus", camera.bus},
          {"serial", camera.serial},
          {"formats", formats},
          {"controls", controls},
          {"trouble", camera.trouble.empty() ? nlohmann::json() : nlohmann::json(camera.trouble)}};
}

void RunDevices(const DevicesOptions& options) {
  const devices::CameraList list = devices::ListCameras(options.network);
  for (const devices::CameraDescription& camera : list.cameras) {
    if (options.json) {
      // A driver's names may contain any bytes.
      std::cout << CameraJson(camera).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                << '\n';
    } else {
      PrintCamera(camera);
    }
  }
  if (list.cameras.empty()) {
    std::cerr << "No camera is plugged in. Plug one in and run this again"
              << (options.network ? ".\n" : "; --network looks for GigE cameras, too.\n")
              << "Without one, file:PATH plays a recording as if it were a camera.\n";
  }
  for (const devices::CameraBackendState& backend : list.backends) {
    if (!backend.built_in) std::cerr << "This build has no support for " << backend.name << ".\n";
    if (!backend.trouble.empty()) std::cerr << backend.name << ": " << backend.trouble << ".\n";
  }
}

}  // namespace

void AddDevicesCommand(CLI::App& app, CommandResult&) {
  auto options = std::make_shared<DevicesOptions>();
  CLI::App* command = app.add_subcommand(
      "devices", "List the cameras that are plugged in: identity, formats, rates, controls");
  command->footer(kDevicesExamples);
  command->add_flag("--json", options->json, "One JSON object a camera");
  command->add_flag("--network", options->network,
                    "Look for GigE Vision cameras on every network, too");
  command->callback([options] { RunDevices(*options); });
}

}  // namespace pleinair::app
