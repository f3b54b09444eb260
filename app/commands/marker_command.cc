#include "app/commands/marker_command.h"

#include <charconv>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/options/sheet_format_options.h"
#include "base/atomic_file.h"
#include "export/print_sheets/marker_sheet.h"
#include "export/print_sheets/sheet.h"
#include "export/print_sheets/sheet_file.h"
#include "export/print_sheets/sheet_raster.h"
#include "export/print_sheets/vector_page.h"
#include "tracker/golay/golay_code.h"
#include "tracker/surf_golay/sg_layout.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;
namespace sg = tracker::sg;

constexpr const char* kMarkerExamples =
    "Examples:\n"
    "  pleinair marker 17 -o marker.pdf\n"
    "      a sheet to print at 100 %, with the number, the size and a ruler\n"
    "  pleinair marker 0-9 --size-mm 90 -o ten.pdf\n"
    "      one file with ten pages\n"
    "  pleinair marker 17 --size-mm 200 --page A3 -o marker.svg\n"
    "  pleinair marker 0-49 --png --pixels 960 -o 'print-{id}.png' --json\n"
    "      the bare markers with their white margin, and where in each the black square lies\n"
    "The size is the outer edge of the black square, not of the paper.\n";

constexpr const char* kIdPattern = "{id}";
// Fewer pixels than modules cannot show them; the upper limit is 400 megapixels.
constexpr int kMinPixels = sg::kModules;
constexpr int kMaxPixels = 20'000;

struct MarkerOptions {
  std::vector<std::string> ids;
  double size_mm = 140.0;
  std::string page = "A4";
  exports::FormatFlags formats;
  std::optional<int> pixels;
  std::string output;
  bool json = false;
};

std::optional<int> ParseNumber(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

tl::unexpected<Error> NotANumber(const std::string& word) {
  return InputError("", "there is no marker \"" + word + "\"",
                    "numbers go from 0 to " + std::to_string(tracker::kGolayNumbers - 1) +
                        "; several as 3 5 8 or 0-9");
}

/// Returns the file of each number.
Result<std::vector<fs::path>> NameFiles(const std::string& output, const std::vector<int>& numbers,
                                        exports::SheetFormat format) {
  std::error_code error;
  std::string pattern = output;
  if (output.back() == '/' || fs::is_directory(output, error)) {
    fs::create_directories(output, error);
    if (error) return tl::make_unexpected(WriteError(output, error.value()));
    pattern = (fs::path(output) / "sg-{id}.").string() + std::string(exports::FormatName(format));
  }
  std::vector<fs::path> files;
  const std::size_t at = pattern.find(kIdPattern);
  for (const int number : numbers) {
    std::string name = pattern;
    if (at != std::string::npos) {
      name.replace(at, std::string_view(kIdPattern).size(), std::to_string(number));
    }
    files.emplace_back(name);
  }
  return files;
}

nlohmann::json DescribeMarker(const fs::path& file, int number, double size_mm) {
  return {{"file", file.string()},
          {"family", "sg"},
          {"version", sg::kVersion},
          {"id", number},
          {"size_mm", size_mm}};
}

void PrintMarker(const nlohmann::json& object) {
  std::cout << object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

Result<void> WriteBarePrint(const fs::path& file, int number, const MarkerOptions& options) {
  const int pixels = *options.pixels;
  const double side_m = options.size_mm * 1e-3 * sg::kModules / sg::kEdge;
  Image<std::uint8_t> picture = exports::RasterizeMarker(tracker::SgMarkerPattern(number), pixels);
  PLEINAIR_ASSIGN_OR_RETURN(const std::string png,
                            exports::EncodeGrayPng(picture.view(), pixels / side_m));
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(file, png));
  if (options.json) {
    nlohmann::json object = DescribeMarker(file, number, options.size_mm);
    object["pixels"] = pixels;
    object["edge_fraction"] = static_cast<double>(sg::kEdge) / sg::kModules;
    PrintMarker(object);
  }
  return {};
}

nlohmann::json DescribeSheet(const fs::path& file, int number, double size_mm,
                             const exports::Sheet& sheet) {
  nlohmann::json object = DescribeMarker(file, number, size_mm);
  object["page_mm"] = {sheet.page.width_mm, sheet.page.height_mm};
  for (const Vec2 corner : exports::FindCorners(sheet.prints.front())) {
    object["corners_on_page_mm"].push_back({corner.x, corner.y});
  }
  return object;
}

Result<void> WriteSheets(const std::vector<int>& numbers, exports::SheetFormat format,
                         exports::PageSize page, const MarkerOptions& options) {
  std::vector<exports::Sheet> sheets;
  for (const int number : numbers) {
    PLEINAIR_ASSIGN_OR_RETURN(exports::Sheet sheet,
                              exports::MarkerSheet(number, options.size_mm, page));
    sheets.push_back(std::move(sheet));
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<fs::path> files,
                            NameFiles(options.output, numbers, format));
  const bool one_file = numbers.size() > 1 && files[0] == files[1];
  if (one_file) {
    PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(files[0], exports::WritePdf(sheets)));
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!one_file) {
      PLEINAIR_ASSIGN_OR_RETURN(const std::string content, exports::RenderSheet(sheets[i], format));
      PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(files[i], content));
    }
    if (!options.json) continue;
    nlohmann::json object = DescribeSheet(files[i], numbers[i], options.size_mm, sheets[i]);
    object["page"] = one_file ? i + 1 : 1;
    PrintMarker(object);
  }
  return {};
}

bool GivesOneName(const std::string& output) {
  std::error_code ignored;
  return output.find(kIdPattern) == std::string::npos && output.back() != '/' &&
         !fs::is_directory(output, ignored);
}

Result<void> RunMarker(const MarkerOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<int> numbers, ParseMarkerNumbers(options.ids));
  PLEINAIR_RETURN_IF_ERROR(exports::CheckLength("--size-mm", options.size_mm));
  if (options.output.empty()) {
    return InputError("--output", "the name is empty", "name a file, for example marker.pdf");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const exports::PageSize page, exports::ParsePageSize(options.page));
  std::error_code ignored;
  const bool folder = options.output.back() == '/' || fs::is_directory(options.output, ignored);
  PLEINAIR_ASSIGN_OR_RETURN(const exports::SheetFormat format,
                            exports::ChooseFormat(options.formats, folder ? "" : options.output));
  if (numbers.size() > 1 && GivesOneName(options.output) &&
      (format != exports::SheetFormat::kPdf || options.pixels)) {
    return InputError(options.output, "is one file for several markers",
                      "write {id} into the name, name a folder, or use .pdf for one file");
  }
  if (!options.pixels) return WriteSheets(numbers, format, page, options);
  if (format != exports::SheetFormat::kPng) {
    return InputError("--pixels", "only PNG has pixels", "give --png or a name that ends in .png");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<fs::path> files,
                            NameFiles(options.output, numbers, format));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    PLEINAIR_RETURN_IF_ERROR(WriteBarePrint(files[i], numbers[i], options));
  }
  return {};
}

}  // namespace

Result<std::vector<int>> ParseMarkerNumbers(const std::vector<std::string>& words) {
  const auto exists = [](std::optional<int> number) {
    return number && *number >= 0 && *number < tracker::kGolayNumbers;
  };
  std::vector<int> numbers;
  for (const std::string& word : words) {
    const std::size_t dash = word.find('-', 1);
    const auto first = ParseNumber(std::string_view(word).substr(0, dash));
    const auto last =
        dash == std::string::npos ? first : ParseNumber(std::string_view(word).substr(dash + 1));
    if (!exists(first) || !exists(last) || *last < *first) return NotANumber(word);
    for (int number = *first; number <= *last; ++number) numbers.push_back(number);
  }
  return numbers;
}

void AddMarkerCommand(CLI::App& app, CommandResult& result) {
  auto options = std::make_shared<MarkerOptions>();
  CLI::App* command = app.add_subcommand("marker", "Make markers to print");
  command->footer(kMarkerExamples);
  command->add_option("ids", options->ids, "Numbers from 0 to 4095; 3 5 8 or 0-9")
      ->type_name("ID")
      ->required();
  command->add_option("--size-mm", options->size_mm, "Outer edge of the black square")
      ->type_name("MM")
      ->check(CLI::Range(exports::kMinMarker_mm, exports::kMaxMarker_mm))
      ->capture_default_str();
  CLI::Option* page =
      command
          ->add_option("--page", options->page, "A5 to A0, letter, A4-landscape or 300x400 in mm")
          ->type_name("PAGE")
          ->capture_default_str();
  AddFormatOptions(*command, options->formats);
  command
      ->add_option("--pixels", options->pixels,
                   "The bare marker with its white margin as a PNG of N x N pixels; multiples of "
                   "48 are sharpest")
      ->type_name("N")
      ->check(CLI::Range(kMinPixels, kMaxPixels))
      ->excludes(page);
  command
      ->add_option("-o,--output", options->output,
                   "File (.pdf, .svg, .png), name with {id}, or folder")
      ->type_name("F")
      ->required();
  command->add_flag("--json", options->json, "One JSON object a marker on standard output");
  command->callback([options, &result] { result.status = RunMarker(*options); });
}

}  // namespace pleinair::app
