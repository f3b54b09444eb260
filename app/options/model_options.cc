#include "app/options/model_options.h"

#include <CLI/CLI.hpp>

#include "compositor/models/model_files.h"

namespace pleinair::app {

void AddModelFileOptions(CLI::App& command) {
  command.add_flag_callback(
      "--allow-outside", [] { compositor::AllowFilesOutsideModels(true); },
      "Let models name textures and buffers outside their own folders");
}

}  // namespace pleinair::app
