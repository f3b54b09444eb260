#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands/command.h"
#include "app/model/contact_sheet.h"
#include "app/model/model_facts.h"
#include "app/options/model_options.h"
#include "app/options/option_use.h"
#include "compositor/models/model.h"
#include "export/images/image_writer.h"
#include "files/output_rule.h"
#include "scene/length_units.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModelExamples =
    "Examples:\n"
    "  pleinair model sculpture.glb\n"
    "      size, unit, axes, materials, and what will not be drawn\n"
    "  pleinair model chair.obj --up y --unit mm -o chair.png\n"
    "      also a sheet of four views under a clear sky, with a scale and a person's outline\n"
    "  pleinair model *.glb --json\n"
    "      a JSON object per file\n"
    "  pleinair model *.obj -o sheets/\n"
    "      a sheet per file, sheets/NAME.png\n"
    "--up and --unit are the keys up and unit of [[object]] in a scene.\n";

struct ModelCommandOptions {
  std::vector<std::string> files;
  std::string up, unit, shading = "file", output;
  bool json = false;
};

compositor::ModelFrame FrameOf(const ModelCommandOptions& options) {
  compositor::ModelFrame frame;
  if (!options.up.empty()) frame.file_up = options.up == "y" ? UpAxis::kY : UpAxis::kZ;
  if (!options.unit.empty()) frame.unit_m = scene::MetresOfUnit(options.unit).value_or(1.0);
  return frame;
}

compositor::NormalsMode NormalsOf(const std::string& shading) {
  if (shading == "flat") return compositor::NormalsMode::kFlat;
  return shading == "smooth" ? compositor::NormalsMode::kSmooth
                             : compositor::NormalsMode::kFromFile;
}

std::vector<std::string> UnitNames() {
  std::vector<std::string> names;
  names.reserve(scene::kLengthUnits.size());
  for (const scene::LengthUnit& unit : scene::kLengthUnits) names.emplace_back(unit.name);
  return names;
}

bool IsFolder(const std::string& output) {
  std::error_code ignored;
  return output.back() == '/' || fs::is_directory(output, ignored);
}

/// The sheet of a model in a folder of sheets.
fs::path SheetName(const fs::path& model) { return model.filename().replace_extension(".png"); }

/// The contact sheet of a model; empty if none is wanted.
Result<fs::path> SheetOf(const fs::path& model, const ModelCommandOptions& options) {
  if (options.output.empty()) return fs::path();
  if (!IsFolder(options.output)) return fs::path(options.output);
  std::error_code error;
  fs::create_directories(options.output, error);
  if (error) {
    return SystemError(options.output, "cannot be made: " + error.message(), "name another folder");
  }
  fs::path sheet = fs::path(options.output) / SheetName(model);
  PLEINAIR_RETURN_IF_ERROR(files::CheckFreeName(sheet));
  return sheet;
}

Result<void> CheckOutput(const ModelCommandOptions& options) {
  if (options.output.empty()) return {};
  if (IsFolder(options.output)) {
    std::set<fs::path> sheets;
    for (const std::string& file : options.files) {
      if (sheets.insert(SheetName(file)).second) continue;
      return InputError(file,
                        "would have the same sheet as another model, " + SheetName(file).string(),
                        "name them in two calls, with two folders");
    }
    return {};
  }
  if (options.files.size() > 1) {
    return InputError(options.output, "is one file for the sheets of several models",
                      "name a folder, with a slash at the end");
  }
  if (fs::path(options.output).extension() != ".png") {
    return InputError(options.output, "is not the name of a PNG picture",
                      "name a file that ends in .png, or a folder");
  }
  return {};
}

Result<void> RunModel(const ModelCommandOptions& options) {
  PLEINAIR_RETURN_IF_ERROR(CheckOutput(options));
  const compositor::ModelFrame frame = FrameOf(options);
  for (const std::string& file : options.files) {
    PLEINAIR_ASSIGN_OR_RETURN(
        compositor::Model loaded,
        compositor::LoadModel(file, {NormalsOf(options.shading), false, frame}));
    const auto model = std::make_shared<const compositor::Model>(std::move(loaded));
    const ModelFacts facts = FactsOf(*model, frame, !options.unit.empty());
    PLEINAIR_ASSIGN_OR_RETURN(const fs::path sheet, SheetOf(file, options));
    if (!sheet.empty()) {
      PLEINAIR_ASSIGN_OR_RETURN(const RgbImage image, ContactSheet(model));
      PLEINAIR_RETURN_IF_ERROR(exports::WritePng(sheet, image.view()));
    }
    std::cout << (options.json ? ModelJson(*model, frame, facts, sheet) + "\n"
                               : ModelText(*model, frame, facts));
  }
  return {};
}

}  // namespace

void AddModelCommand(CLI::App& app, CommandResult& result) {
  auto options = std::make_shared<ModelCommandOptions>();
  CLI::App* command =
      app.add_subcommand("model", "Describe model files, and draw them from four sides");
  command->footer(kModelExamples);
  command->add_option("files", options->files, "OBJ or glTF 2.0 files")
      ->type_name("FILE")
      ->required();
  command->add_option("--up", options->up, "Axis of the files that points up")
      ->type_name("AXIS")
      ->check(CLI::IsMember({"y", "z"}));
  command->add_option("--unit", options->unit, "Unit of the files")
      ->type_name("UNIT")
      ->check(CLI::IsMember(UnitNames()));
  command->add_option("--shading", options->shading, "Normals, as in a scene")
      ->type_name("KIND")
      ->check(CLI::IsMember({"file", "flat", "smooth"}))
      ->capture_default_str();
  command->add_option("-o,--output", options->output, "Contact sheet (.png), or a folder for them")
      ->type_name("FILE");
  AddModelFileOptions(*command);
  command->add_flag("--json", options->json, "One JSON object per file");
  RefuseEmptyValues(*command);
  command->callback([options, &result] { result.status = RunModel(*options); });
}

}  // namespace pleinair::app
