#include "app/commands/research_options.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/options/light_options.h"
#include "app/options/number_range.h"
#include "shadows/shadow_method.h"

namespace pleinair::app {
namespace {

std::vector<std::string> ShadowMethodNames() {
  std::vector<std::string> names;
  for (const auto& traits : shadows::ShadowMethods()) names.emplace_back(traits.name);
  return names;
}

}  // namespace

void AddResearchOptions(CLI::App& command, ReplayArguments& arguments) {
  compositor::ComposerOptions& composer = arguments.options.composer;
  AddSolverOptions(command, arguments.options.light);
  command
      .add_option(
          "--shadows", arguments.research.shadows,
          "Shadow method (docs/method/shadows.md): ours has the sun's own penumbra, zgaf is "
          "the paper's")
      ->check(CLI::IsMember(ShadowMethodNames()))
      ->type_name("METHOD")
      ->capture_default_str();
  command
      .add_option("--shadow-partitions", composer.shadow_partitions,
                  "Partitions of the shadow maps")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
  command
      .add_option("--shadow-split-weight", composer.shadow_split_weight,
                  "Lambda of the partitions: 0 even, 1 logarithmic")
      ->check(NumberRange(0.0, 1.0))
      ->capture_default_str();
  command
      .add_option("--shadow-sizes", arguments.research.shadow_sizes,
                  "Texels a side of the shadow maps; one number, or one a partition from the "
                  "finest on. Default: as fine as the image shows, 1024,1024,512,512 up to "
                  "1024 pixels a side, twice that beyond and for --time-lapse")
      ->delimiter(',')
      ->expected(1, 4)
      ->check(CLI::IsMember({128, 256, 512, 1024, 2048, 4096}))
      ->type_name("N,...");
  command
      .add_option("--shadow-blur", composer.shadow_blur_distance_m,
                  "Methods that blur moments: distance in metres of the blocker whose penumbra "
                  "the blur has")
      ->check(NumberRange(0.01, 100.0))
      ->capture_default_str();
  command.add_flag("--shadow-debug", composer.show_shadow_maps,
                   "Tint surfaces by shadow-map partition and show the maps");
  command
      .add_option("--shader-dir", arguments.research.shader_directory,
                  "Folder with shaders to use instead of the built-in ones, for development")
      ->check(CLI::ExistingDirectory);
}

void RefuseResearchOptions(CLI::App& command) {
  CLI::App research;
  research.set_help_flag();
  ReplayArguments unused;
  AddResearchOptions(research, unused);
  for (const CLI::Option* option : research.get_options()) {
    const std::string name = option->get_name();
    command
        .add_option_function<std::vector<std::string>>(
            name,
            [name](const std::vector<std::string>&) {
              throw CLI::ValidationError(
                  name, "is an option of 'pleinair bench replay', which takes all of replay's too");
            })
        ->expected(0, 4)
        ->group("");  // Hidden from the help.
  }
}

}  // namespace pleinair::app
