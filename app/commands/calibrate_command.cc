#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/calibrate/board_options.h"
#include "app/calibrate/calibration_drawings.h"
#include "app/calibrate/calibration_page.h"
#include "app/calibrate/calibration_summary.h"
#include "app/calibrate/film_lens.h"
#include "app/calibrate/view_collection.h"
#include "app/commands/command.h"
#include "app/options/number_range.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress_bar.h"
#include "base/atomic_file.h"
#include "devices/calibration/calibration_text.h"
#include "export/images/image_writer.h"

namespace pleinair::app {
namespace {

using devices::CalibrationForm;
using tracker::LensCalibration;
using tracker::LensKind;

constexpr const char* kCalibrateExamples =
    "Examples:\n"
    "  pleinair board -o board.pdf\n"
    "  pleinair calibrate --board board.json photos/ -o camera.json --report lens.html\n"
    "  pleinair calibrate --charuco 8x6 photos/*.jpg -o camera.json\n"
    "  pleinair calibrate --chessboard 9x6 film.mp4 --opencv camera.yaml --ros camera_info.yaml\n"
    "  pleinair calibrate walk.mov --marker sg -o camera.json\n"
    "      without a board, from the marker that the film shows from several sides\n"
    "  pleinair calibrate --charuco 8x6 v4l2:/dev/video0 -o camera.json\n"
    "      picks views while you move the board, until it has enough or you press Ctrl-C\n"
    "Take 10 to 20 images of the whole board: near and far, tilted by 20 to 45 degrees in "
    "several\n"
    "directions, in every corner of the image, with focus and zoom held. Views that do not\n"
    "determine the lens are refused with the reasons. docs/guide/calibrate.md explains more.";

constexpr int kBoardViews = 40, kMarkerFilmViews = 120;

/// A file to write and its format.
struct Output {
  const char* option;
  const char* help;
  CalibrationForm form;
  std::string file;
};

struct CalibrateOptions {
  std::vector<std::string> sources;
  BoardOptions board;
  std::vector<std::string> marker;  ///< Families; empty: a board is seen.
  std::string model = "auto";
  std::vector<Output> outputs = {
      {"-o,--output", "pleinair's own format (.json)", CalibrationForm::kOwn, ""},
      {"--opencv", "OpenCV's format (.yaml)", CalibrationForm::kOpenCvYaml, ""},
      {"--opencv-json", "OpenCV's format as JSON", CalibrationForm::kOpenCvJson, ""},
      {"--ros", "ROS' camera_info (.yaml)", CalibrationForm::kRos, ""},
      {"--kalibr", "Kalibr's camchain (.yaml)", CalibrationForm::kKalibr, ""},
      {"--euroc", "EuRoC's sensor.yaml", CalibrationForm::kEuroc, ""}};
  std::string report, coverage, size;
  std::optional<double> seconds;
  std::optional<int> views;
  bool json = false;
};

Result<devices::FormatRequest> WishOf(const CalibrateOptions& options) {
  devices::FormatRequest requested;
  if (options.size.empty()) return requested;
  PLEINAIR_ASSIGN_OR_RETURN(const auto sides, ParseSides("--size", options.size));
  requested.size = ImageSize{sides.first, sides.second};
  return requested;
}

/// Reports problems with the outputs before minutes of work.
Result<void> CheckOutputs(const CalibrateOptions& options) {
  const bool any = !options.report.empty() || !options.coverage.empty() || options.json ||
                   std::any_of(options.outputs.begin(), options.outputs.end(),
                               [](const Output& output) { return !output.file.empty(); });
  if (!any) return InputError("", "no output file is given", "name a file with -o camera.json");
  if (!options.coverage.empty() && !options.coverage.ends_with(".svg") &&
      !options.coverage.ends_with(".png")) {
    return InputError("--coverage", "\"" + options.coverage + "\" is neither .svg nor .png",
                      "name it coverage.svg or coverage.png");
  }
  return {};
}

std::vector<tracker::PlaneView> Planes(const Collection& collection,
                                       const tracker::CalibrationBoard& board) {
  const std::vector<Vec2> points = BoardPoints(board);
  std::vector<tracker::PlaneView> planes;
  for (const CollectedView& each : collection.views) planes.push_back(OnPlane(each.view, points));
  return planes;
}

/// Refines the markers when the lens is known. If calibration fails, the next step reports why.
void RefineViews(tracker::BoardFinder& finder, Collection* collection) {
  if (!finder.refines() || collection->views.size() < tracker::kMinViews) return;
  const auto rough = tracker::FitLens(Planes(*collection, finder.board()), collection->width,
                                      collection->height, LensKind::kRadtan4, 1.0);
  if (!rough) return;
  ProgressBar bar("Measuring", static_cast<std::int64_t>(collection->views.size()), "views");
  for (CollectedView& each : collection->views) {
    finder.Refine(rough->camera, each.grey.view(), &each.view);
    bar.Advance();
  }
}

Result<LensCalibration> Calibrate(const CalibrateOptions& options, const Collection& collection,
                                  const tracker::CalibrationBoard& board) {
  tracker::LensCalibrationOptions lens_options;
  for (const LensKind kind : tracker::kLensKinds) {
    if (options.model == NameOf(kind)) lens_options.kind = kind;
  }
  auto calibration = tracker::CalibrateLens(Planes(collection, board), collection.width,
                                            collection.height, lens_options);
  if (calibration) return calibration;
  Error error = calibration.error();
  if (error.where.empty()) error.where = options.sources.front();
  if (collection.views.size() < tracker::kMinViews) {
    error.what = fmt::format(
        "the board is seen in {} of {} images, and fewer than {} do not determine a lens",
        collection.views.size(), collection.looked_at, tracker::kMinViews);
  }
  return tl::make_unexpected(std::move(error));
}

std::map<std::string, double> Notes(const LensCalibration& calibration) {
  return {{"rms_px", calibration.rms_px},
          {"validation_rms_px", calibration.validation.rms_px},
          {"views", static_cast<double>(calibration.views.size())},
          {"coverage", calibration.coverage.Share()},
          {"fx_deviation_px", calibration.uncertainty.fx},
          {"fy_deviation_px", calibration.uncertainty.fy},
          {"cx_deviation_px", calibration.uncertainty.cx},
          {"cy_deviation_px", calibration.uncertainty.cy}};
}

Result<void> WriteCoverage(const std::string& file, const LensCalibration& calibration) {
  const exports::VectorDrawing drawing = CoverageDrawing(calibration);
  constexpr int kWidth_px = 1200;
  if (file.ends_with(".svg"))
    return WriteFileAtomically(file, exports::DrawingSvg(drawing, kWidth_px));
  return exports::WritePng(file, exports::RasterizeDrawing(drawing, kWidth_px).view());
}

/// File names and contents.
using Texts = std::vector<std::pair<std::string, std::string>>;

Result<Texts> CalibrationTexts(const CalibrateOptions& options, const CameraModel& camera,
                               const std::map<std::string, double>& notes) {
  Texts texts;
  for (const Output& output : options.outputs) {
    if (output.file.empty()) continue;
    auto text = devices::CalibrationText(camera, output.form, notes);
    if (!text) {
      Error error = text.error();
      error.where = output.file;
      return tl::make_unexpected(std::move(error));
    }
    texts.emplace_back(output.file, *std::move(text));
  }
  return texts;
}

Result<void> WriteTexts(const Texts& texts) {
  for (const auto& [file, text] : texts) {
    PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(file, text));
  }
  return {};
}

Result<void> Write(const CalibrateOptions& options, const LensCalibration& calibration,
                   const Collection& collection, const tracker::CalibrationBoard& board) {
  // All texts first: if a format cannot store the lens, no file is written.
  PLEINAIR_ASSIGN_OR_RETURN(Texts texts,
                            CalibrationTexts(options, calibration.fit.camera, Notes(calibration)));
  if (!options.report.empty()) {
    CalibrationFacts facts;
    facts.command = "pleinair calibrate";
    for (const std::string& source : options.sources) {
      if (facts.command.size() < 200) facts.command += " " + source;
    }
    facts.board = board.Description();
    facts.title = options.sources.front();
    facts.looked_at = collection.looked_at;
    facts.with_board = static_cast<int>(collection.views.size());
    texts.emplace_back(options.report, CalibrationPage(facts, calibration, collection.views));
  }
  PLEINAIR_RETURN_IF_ERROR(WriteTexts(texts));
  return options.coverage.empty() ? Result<void>() : WriteCoverage(options.coverage, calibration);
}

/// Errors (input): options that are for boards.
Result<void> CheckMarkerOptions(const CalibrateOptions& options) {
  const BoardOptions& board = options.board;
  const std::pair<const char*, bool> for_boards[] = {
      {"--board", !board.description.empty()},      {"--chessboard", !board.chessboard.empty()},
      {"--charuco", !board.charuco.empty()},        {"--dictionary", !board.dictionary.empty()},
      {"--square-mm", board.square_mm.has_value()}, {"--report", !options.report.empty()},
      {"--coverage", !options.coverage.empty()},    {"--model", options.model != "auto"}};
  for (const auto& [name, given] : for_boards) {
    if (given) return InputError(name, "is for boards, not for --marker", "leave one of them out");
  }
  if (options.views && *options.views < static_cast<int>(tracker::kMinMarkerViews)) {
    return InputError("--views", "is fewer than the views that a marker needs",
                      "give " + std::to_string(tracker::kMinMarkerViews) + " or more");
  }
  return {};
}

/// Calibrates from the markers of a film instead of a board.
Result<void> CalibrateFromMarkers(const CalibrateOptions& options) {
  PLEINAIR_RETURN_IF_ERROR(CheckMarkerOptions(options));
  PLEINAIR_ASSIGN_OR_RETURN(const devices::FormatRequest requested, WishOf(options));
  const InterruptGuard guard;
  PLEINAIR_ASSIGN_OR_RETURN(const auto pictures, OpenPictures(options.sources, requested));
  tracker::MarkerViewOptions views;
  views.families = options.marker;
  views.max_views = static_cast<std::size_t>(options.views.value_or(kMarkerFilmViews));
  PLEINAIR_ASSIGN_OR_RETURN(const FilmLens film,
                            EstimateFilmLens(*pictures, options.sources.front(), views));
  PLEINAIR_ASSIGN_OR_RETURN(const Texts texts,
                            CalibrationTexts(options, film.lens.camera, FilmLensNotes(film)));
  PLEINAIR_RETURN_IF_ERROR(WriteTexts(texts));
  std::cout << (options.json ? FilmLensJson(film).dump() + "\n" : FilmLensText(film));
  return {};
}

Result<void> RunCalibrate(const CalibrateOptions& options) {
  PLEINAIR_RETURN_IF_ERROR(CheckOutputs(options));
  if (!options.marker.empty()) return CalibrateFromMarkers(options);
  PLEINAIR_ASSIGN_OR_RETURN(const tracker::CalibrationBoard board, BoardOf(options.board));
  PLEINAIR_ASSIGN_OR_RETURN(const devices::FormatRequest requested, WishOf(options));
  PLEINAIR_ASSIGN_OR_RETURN(const auto finder, tracker::BoardFinder::Create(board));
  const InterruptGuard guard;
  PLEINAIR_ASSIGN_OR_RETURN(const auto pictures, OpenPictures(options.sources, requested));
  CollectionOptions collection_options;
  collection_options.max_views = options.views.value_or(kBoardViews);
  collection_options.seconds = options.seconds;
  PLEINAIR_ASSIGN_OR_RETURN(Collection collection,
                            CollectViews(*pictures, *finder, collection_options));
  RefineViews(*finder, &collection);
  PLEINAIR_ASSIGN_OR_RETURN(const LensCalibration calibration,
                            Calibrate(options, collection, finder->board()));
  PLEINAIR_RETURN_IF_ERROR(Write(options, calibration, collection, finder->board()));
  if (options.json) {
    std::cout << CalibrationJson(calibration, collection, finder->board())
                     .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
              << '\n';
  } else {
    PrintCalibration(calibration, collection, finder->board());
  }
  return {};
}

}  // namespace

void AddCalibrateCommand(CLI::App& app, CommandResult& result) {
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* command =
      app.add_subcommand("calibrate", "Calibrate a camera from views of a board or a marker");
  command->footer(kCalibrateExamples);
  command
      ->add_option(
          "SOURCE", options->sources,
          "Images, a folder of them, a film, or a camera (v4l2:..., libcamera:..., aravis:...)")
      ->required();
  AddBoardOptions(*command, options->board);
  command
      ->add_option("--marker", options->marker,
                   "Calibrate from the scene's own markers, of these families, comma-separated "
                   "(sg, tag36h11, ...)")
      ->delimiter(',')
      ->expected(1)
      ->type_name("FAMILY");
  for (Output& output : options->outputs) {
    command->add_option(output.option, output.file, output.help)->type_name("F");
  }
  command->add_option("--report", options->report, "Page with coverage, residuals, views (HTML)")
      ->type_name("F");
  command->add_option("--coverage", options->coverage, "Where the board was seen (.svg or .png)")
      ->type_name("F");
  command
      ->add_option("--model", options->model,
                   "auto (the one that best predicts views left out of the fit), pinhole, radtan4, "
                   "radtan5, rational or equidistant (fisheye)")
      ->check(CLI::IsMember({"auto", "pinhole", "radtan4", "radtan5", "rational", "equidistant"}))
      ->type_name("KIND")
      ->capture_default_str();
  command
      ->add_option("--views", options->views,
                   "Maximum number of views from a film or camera; default: 40, with --marker 120")
      ->check(CLI::Range(tracker::kMinViews, 200));
  command->add_option("--seconds", options->seconds, "Maximum time with a camera")
      ->check(NumberRange(1.0, 36'000.0));
  command->add_option("--size", options->size, "Image size to request from a camera")
      ->type_name("1280x720");
  command->add_flag("--json", options->json, "One JSON object on standard output");
  command->callback([options, &result] {
    try {
      result.status = RunCalibrate(*options);
    } catch (const std::bad_alloc&) {
      result.status = SystemError("", "needs more memory than there is",
                                  "use fewer or smaller images, or a machine with more");
    } catch (const std::exception& error) {
      result.status = SystemError("", std::string("calibrate failed: ") + error.what(),
                                  "please report it with the images");
    }
  });
}

}  // namespace pleinair::app
