#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/commands/command.h"
#include "app/leaf/leaf_swatch.h"
#include "app/leaf/leaf_table.h"
#include "app/leaf/spectrum_fit.h"
#include "app/options/option_use.h"
#include "base/image.h"
#include "compositor/leaf/leaf_inversion.h"
#include "compositor/leaf/leaf_maps.h"
#include "compositor/leaf/prospect.h"
#include "compositor/models/texture_decoder.h"
#include "export/images/image_writer.h"
#include "files/csv.h"
#include "files/output_rule.h"
#include "files/result_file.h"
#include "scene/leaf_contents.h"

namespace pleinair::app {
namespace {

constexpr const char* kLeafExamples =
    "Examples:\n"
    "  pleinair leaf --chlorophyll 45 --carotenoids 9 --water 0.012 --dry 0.005\n"
    "      colors of a healthy leaf\n"
    "  pleinair leaf --spad 42 --carotenoids 9 --json -o leaf.png\n"
    "      by a reading of the SPAD-502 meter; the picture shows both sides\n"
    "  pleinair leaf --model plate --chlorophyll 31.7 --carotenoids 10.6\n"
    "      the model of Miao et al. 2016: one plate at three wavelengths\n"
    "  pleinair leaf --csv leaves.csv --spectra spectra.csv --nm 400..800\n"
    "      a table of leaves; columns name, model, structure, chlorophyll_ug_cm2, ...\n"
    "  pleinair leaf fit measured.csv\n"
    "      the contents that explain a measured spectrum, with their standard deviations\n"
    "  pleinair leaf maps structure.png -o maps\n"
    "      maps of pigments, gloss and thickness from an image of the veins\n"
    "Colors: linear Rec.709 under D65; a white diffuser has 1 1 1. What is left out is 0;\n"
    "--structure is then 1.5.\n";

/// The options of scene::kLeafQuantities, in their order.
struct LeafOption {
  const char* name;
  const char* description;
};
constexpr std::array<LeafOption, scene::kLeafQuantities.size()> kLeafOptions = {{
    {"--chlorophyll", "Chlorophyll a and b, 0 to 150 µg/cm²"},
    {"--carotenoids", "Carotenoids, 0 to 50 µg/cm²"},
    {"--anthocyanins", "Anthocyanins, 0 to 40 µg/cm²; prospect-d"},
    {"--brown", "Brown pigments, 0 to 5, without unit"},
    {"--water", "Equivalent thickness of the water, 0 to 0.1 cm; prospect-d"},
    {"--dry", "Dry matter, 0 to 0.05 g/cm²"},
    {"--structure", "Structure N, 1 to 4; thin leaves have 1.5"},
}};

struct LeafCommandOptions {
  std::string model = scene::kProspectDName;
  std::array<std::string, kLeafOptions.size()> quantities;
  std::string spad;
  std::vector<std::string> refractive;
  std::string csv, spectra, nm, output;
  bool json = false;
};

struct NanometreRange {
  int first = compositor::kFirstLeafNm, last = compositor::kLastLeafNm;
};

Result<NanometreRange> ParseNanometres(const std::string& text) {
  if (text.empty()) return NanometreRange{};
  const auto whole = [](std::string_view part) -> std::optional<int> {
    int value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc{} || end != part.data() + part.size()) return std::nullopt;
    return value;
  };
  const std::size_t dots = text.find("..");
  if (dots != std::string::npos) {
    const std::optional<int> first = whole(std::string_view(text).substr(0, dots));
    const std::optional<int> last = whole(std::string_view(text).substr(dots + 2));
    if (first && last && *first >= compositor::kFirstLeafNm && *last <= compositor::kLastLeafNm &&
        *first <= *last) {
      return NanometreRange{*first, *last};
    }
  }
  return InputError("--nm", "\"" + text.substr(0, 40) + "\" is no range of wavelengths",
                    "give whole nanometres within 400..2500");
}

Result<double> ParseLeafNumber(const std::string& text, const std::string& option) {
  const std::optional<double> value = files::ParseNumber(text);
  if (value) return *value;
  return InputError(option, "\"" + text.substr(0, 40) + "\" is not a number",
                    "give a finite number");
}

Result<scene::Leaf> ChosenLeaf(const LeafCommandOptions& options) {
  scene::Leaf leaf;
  PLEINAIR_ASSIGN_OR_RETURN(leaf.model, ParseLeafModel(options.model, "--model"));
  for (std::size_t i = 0; i < kLeafOptions.size(); ++i) {
    if (options.quantities[i].empty()) continue;
    PLEINAIR_ASSIGN_OR_RETURN(const double value,
                              ParseLeafNumber(options.quantities[i], kLeafOptions[i].name));
    PLEINAIR_RETURN_IF_ERROR(
        scene::CheckLeafQuantity(scene::kLeafQuantities[i], value, kLeafOptions[i].name));
    leaf.contents.*scene::kLeafQuantities[i].value = value;
  }
  if (!options.spad.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(const double spad, ParseLeafNumber(options.spad, "--spad"));
    PLEINAIR_ASSIGN_OR_RETURN(leaf.contents.chlorophyll_ug_cm2,
                              scene::ChlorophyllOfSpad(spad, "--spad"));
  }
  for (std::size_t c = 0; c < options.refractive.size(); ++c) {
    PLEINAIR_ASSIGN_OR_RETURN(leaf.refractive_index[c],
                              ParseLeafNumber(options.refractive[c], "--refractive"));
    PLEINAIR_RETURN_IF_ERROR(
        CheckLeafRefraction("the index", leaf.refractive_index[c], "--refractive"));
  }
  return leaf;
}

/// Options that belong to the other way of naming leaves, or to nothing that is asked for.
Result<void> CheckUseOfLeafOptions(const CLI::App& command, const LeafCommandOptions& options) {
  const bool single = options.csv.empty();
  const std::string a_leaf = "one leaf, and --csv names a table";
  for (const LeafOption& option : kLeafOptions) {
    PLEINAIR_RETURN_IF_ERROR(RefuseUnusedOptions(command, {{option.name, single, a_leaf}}));
  }
  PLEINAIR_RETURN_IF_ERROR(
      RefuseUnusedOptions(command, {{"--model", single, a_leaf},
                                    {"--spad", single, a_leaf},
                                    {"--output", single, a_leaf},
                                    {"--nm", !options.spectra.empty(), "--spectra"}}));
  const bool plate = options.model == scene::kPlateName;
  return RefuseUnusedOptions(command, {{"--refractive", single && plate, "the model plate"},
                                       {"--anthocyanins", single && !plate, "the model prospect-d"},
                                       {"--water", single && !plate, "the model prospect-d"}});
}

Result<void> RunLeafTable(const LeafCommandOptions& options, NanometreRange nm) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text, files::ReadTextFile(options.csv));
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<NamedLeaf> leaves,
                            ParseLeafTable(text, files::TextFileName(options.csv)));
  if (!options.spectra.empty()) {
    PLEINAIR_RETURN_IF_ERROR(WriteLeafSpectra(leaves, options.spectra, nm.first, nm.last));
  }
  return WriteLeafColors(leaves, options.json);
}

Result<void> RunLeaf(const CLI::App& command, const LeafCommandOptions& options) {
  PLEINAIR_RETURN_IF_ERROR(CheckUseOfLeafOptions(command, options));
  PLEINAIR_ASSIGN_OR_RETURN(const NanometreRange nm, ParseNanometres(options.nm));
  if (options.spectra == "-") {
    return InputError("--spectra", "cannot be standard output", "name a file");
  }
  if (!options.csv.empty()) return RunLeafTable(options, nm);
  PLEINAIR_ASSIGN_OR_RETURN(const scene::Leaf leaf, ChosenLeaf(options));
  if (!options.output.empty() && std::filesystem::path(options.output).extension() != ".png") {
    return InputError(options.output, "is not the name of a PNG picture",
                      "name a file that ends in .png");
  }
  if (!options.output.empty()) {
    PLEINAIR_RETURN_IF_ERROR(exports::WritePng(options.output, LeafSwatch(leaf).view()));
  }
  if (!options.spectra.empty()) {
    PLEINAIR_RETURN_IF_ERROR(
        WriteLeafSpectra({{"leaf", leaf}}, options.spectra, nm.first, nm.last));
  }
  std::cout << (options.json ? LeafJson({"", leaf}) + "\n" : LeafText(leaf));
  return {};
}

struct LeafFitOptions {
  std::string spectrum;
  bool json = false;
};

Result<void> RunLeafFit(const LeafFitOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text, files::ReadTextFile(options.spectrum));
  const std::string name = files::TextFileName(options.spectrum);
  PLEINAIR_ASSIGN_OR_RETURN(const compositor::MeasuredSpectrum spectrum,
                            ParseMeasuredSpectrum(text, name));
  PLEINAIR_ASSIGN_OR_RETURN(const compositor::LeafFit fit, compositor::FitLeaf(spectrum, name));
  std::cout << (options.json ? LeafFitJson(fit) + "\n" : LeafFitText(fit));
  return {};
}

void AddLeafFitCommand(CLI::App* leaf, CommandResult* result) {
  auto options = std::make_shared<LeafFitOptions>();
  CLI::App* command = leaf->add_subcommand("fit", "Pigments of a leaf from its spectrum");
  command->footer(
      "Examples:\n"
      "  pleinair leaf fit measured.csv\n"
      "The table has the columns wavelength_nm and reflectance, transmittance or both, as shares\n"
      "from 0 to 1. Rows outside 400 to 2500 nm are left out.\n");
  command->add_option("SPECTRUM", options->spectrum, "CSV table; - is standard input")->required();
  command->add_flag("--json", options->json, "One JSON object");
  RefuseEmptyValues(*command);
  command->callback([options, result] { result->status = RunLeafFit(*options); });
}

struct LeafMapsOptions {
  std::string structure, folder;
};

/// A grey image as RGB.
RgbImage RgbOfGrey(const Image<std::uint8_t>& grey) {
  RgbImage rgb(grey.width(), grey.height(), 3);
  for (std::size_t i = 0; i < grey.size(); ++i) std::fill_n(rgb.data() + 3 * i, 3, grey.data()[i]);
  return rgb;
}

Result<void> RunLeafMaps(const LeafMapsOptions& options) {
  namespace fs = std::filesystem;
  PLEINAIR_ASSIGN_OR_RETURN(const Image<std::uint8_t> structure,
                            compositor::ReadTexture(options.structure));
  const compositor::LeafMaps maps = compositor::MapsOfStructure(structure.view());
  std::error_code error;
  fs::create_directories(options.folder, error);
  if (error) {
    return SystemError(options.folder, "cannot be made: " + error.message(), "name another folder");
  }
  const fs::path folder(options.folder);
  for (const char* name : {"pigment.png", "gloss.png", "thickness.png"}) {
    PLEINAIR_RETURN_IF_ERROR(files::CheckFreeName(folder / name));
  }
  PLEINAIR_RETURN_IF_ERROR(exports::WritePng(folder / "pigment.png", maps.pigment.view()));
  PLEINAIR_RETURN_IF_ERROR(exports::WritePng(folder / "gloss.png", RgbOfGrey(maps.gloss).view()));
  return exports::WritePng(folder / "thickness.png", RgbOfGrey(maps.thickness).view());
}

void AddLeafMapsCommand(CLI::App* leaf, CommandResult* result) {
  auto options = std::make_shared<LeafMapsOptions>();
  CLI::App* command =
      leaf->add_subcommand("maps", "Maps of a leaf from an image of its structure, to be edited");
  command->footer(
      "Examples:\n"
      "  pleinair leaf maps structure.png -o maps\n"
      "Red is the main vein, green secondary veins, blue mesophyll. Writes pigment.png (red, "
      "green\n"
      "and blue scale chlorophyll, carotenoids and brown pigments; 255 is 1), gloss.png (255 is "
      "1)\n"
      "and thickness.png (128 is 1).\n");
  command->add_option("STRUCTURE", options->structure, "Image of the veins")->required();
  command->add_option("-o,--output", options->folder, "Folder for the maps")
      ->type_name("DIR")
      ->required();
  RefuseEmptyValues(*command);
  command->callback([options, result] { result->status = RunLeafMaps(*options); });
}

void AddLeafOptions(CLI::App* command, LeafCommandOptions* options) {
  command->add_option("--model", options->model, "prospect-d or plate")
      ->type_name("MODEL")
      ->capture_default_str();
  CLI::Option* chlorophyll = nullptr;
  for (std::size_t i = 0; i < kLeafOptions.size(); ++i) {
    CLI::Option* option =
        command
            ->add_option(kLeafOptions[i].name, options->quantities[i], kLeafOptions[i].description)
            ->type_name("X");
    if (i == 0) chlorophyll = option;
  }
  command->add_option("--spad", options->spad, "Chlorophyll by a reading of the SPAD-502, 0 to 82")
      ->type_name("X")
      ->excludes(chlorophyll);
  command
      ->add_option("--refractive", options->refractive,
                   "Refractive index of red, green and blue; plate")
      ->type_name("R,G,B")
      ->delimiter(',')
      ->expected(3);
  command->add_option("--csv", options->csv, "Table of leaves; - is standard input")
      ->type_name("FILE");
  command->add_option("--spectra", options->spectra, "Write spectra there, as CSV")
      ->type_name("FILE");
  command->add_option("--nm", options->nm, "Wavelengths of --spectra; default 400..2500")
      ->type_name("A..B");
  command->add_option("-o,--output", options->output, "Picture of both sides (.png)")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "One JSON object per leaf");
}

}  // namespace

void AddLeafCommand(CLI::App& app, CommandResult& result) {
  auto options = std::make_shared<LeafCommandOptions>();
  CLI::App* command =
      app.add_subcommand("leaf", "Colors and spectra of leaves, from their pigments");
  command->footer(kLeafExamples);
  AddLeafOptions(command, options.get());
  RefuseEmptyValues(*command);
  command->require_subcommand(0, 1);
  AddLeafFitCommand(command, &result);
  AddLeafMapsCommand(command, &result);
  command->callback([command, options, &result] {
    if (command->get_subcommands().empty()) result.status = RunLeaf(*command, *options);
  });
}

}  // namespace pleinair::app
