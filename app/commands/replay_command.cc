#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands/command.h"
#include "app/commands/replay_options.h"
#include "app/commands/replay_run.h"
#include "app/commands/research_options.h"

namespace pleinair::app {
namespace {

constexpr const char* kReplayExamples =
    "Examples:\n"
    "  pleinair replay recordings/courtyard_midday -o out/demo\n"
    "  pleinair replay site/ -o out/site --frames --size 1280x720\n"
    "  pleinair replay site/ -o out/site --sun-to-sky 0   (no sun shone)\n"
    "  pleinair replay site/ -o out/site --frames --export gltf,colmap   (for film tools)\n"
    "  pleinair replay site/ -o out/site --time-lapse 05:00..21:00 --every 10min   (the day)\n"
    "  pleinair replay walk.mp4 --frame 120 --calibration phone.yaml --scene scene.toml -o "
    "out/one\n"
    "  pleinair replay photo.jpg --calibration phone.yaml --scene scene.toml -o out/photo\n"
    "  pleinair replay site/ -o out/part --from 2.5 --to 6   (seconds)\n"
    "  pleinair replay walk.mp4 --calibration phone.yaml --scene site/scene.toml -o out/walk\n"
    "  pleinair replay site/ -o out/walk --trajectory scan/   (Stray Scanner; the marker once)\n"
    "  pleinair replay site/ -o out/walk --trajectory sparse/0 --trajectory-points places.txt\n"
    "  pleinair replay sites/* -o out --shard 2/8   (every eighth project, from the second)\n"
    "Writes composite.mp4, poses/MARKER.tum, detections.jsonl, report.json, report.html and, with\n"
    "--frames, frames/0000.png and so on. docs/guide/reference/recordings.md describes recordings "
    "and scenes.";

}  // namespace

void AddReplayCommand(CLI::App& app, CommandResult& result) {
  CLI::App* command =
      app.add_subcommand("replay", "Compose the virtual objects of a scene into a recording");
  command->footer(kReplayExamples);
  auto arguments = std::make_shared<ReplayArguments>();
  AddReplayOptions(*command, *arguments);
  RefuseResearchOptions(*command);
  command->callback([arguments, &result] { result.status = RunReplay(*arguments); });
}

}  // namespace pleinair::app
