#include "app/commands/detect_command.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/options/located_error.h"
#include "app/options/marker_numbers.h"
#include "app/options/option_use.h"
#include "app/output/pose_json.h"
#include "devices/calibration/calibration.h"
#include "devices/images/image_file.h"
#include "tracker/picture_target/target_file.h"
#include "tracker/tracker.h"

namespace pleinair::app {
namespace {

constexpr std::int64_t kMegapixel = 1'000'000;
/// Detection holds 29 bytes for a pixel: 3.5 GB for these. Larger images gain nothing, because a
/// marker of some hundred pixels is measured to hundredths already.
constexpr std::int64_t kMaxPixels = 120 * kMegapixel;

constexpr const char* kDetectExamples =
    "Examples:\n"
    "  pleinair detect photo.jpg --calibration camera.yaml --size-mm 140\n"
    "  pleinair detect frames/*.png --calibration camera.json --size-mm 480 --track\n"
    "  pleinair detect photo.jpg --calibration camera.yaml --size-mm 140 --family sg --numbers "
    "0-49\n"
    "  pleinair detect frames/*.png --calibration camera.json --target poster.target --track\n"
    "Prints one JSON object per image: file, milliseconds, and markers with family, id, corners\n"
    "(pixels, integer = pixel centre; top-left, then clockwise as the marker is read),\n"
    "camera_from_marker, covariance, visible_fraction, visibility (of S-G markers and targets,\n"
    "by parts of the marker), name (of targets, whose family is picture), alternative and path;\n"
    "with --track also lost: markers that are no longer seen. Without --size-mm only the targets\n"
    "are looked for. The id is null where an S-G marker's border is certain and its number is\n"
    "covered; --track and --numbers help then.";

Result<tracker::SgStrategy> StrategyOf(const std::string& name) {
  if (name == "hybrid") return tracker::SgStrategy::kHybrid;
  if (name == "fast") return tracker::SgStrategy::kFast;
  if (name == "surf-golay") return tracker::SgStrategy::kSurfGolay;
  return InputError("--strategy", "\"" + name + "\" is not a strategy",
                    "use hybrid, fast or surf-golay");
}

Result<void> CheckPicture(const std::string& picture, const CameraModel& camera,
                          const std::string& calibration) {
  PLEINAIR_ASSIGN_OR_RETURN(const ImageSize size, devices::InspectImageFile(picture));
  const std::int64_t pixels = std::int64_t{size.width} * size.height;
  if (pixels > kMaxPixels) {
    return InputError(
        picture,
        "has " + std::to_string(pixels / kMegapixel) + " megapixels; detect takes up to " +
            std::to_string(kMaxPixels / kMegapixel) + ", for each of which it needs 30 MB",
        "halve its width and height, and those of the calibration with them");
  }
  if (size.width == camera.width && size.height == camera.height) return {};
  const auto text = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  return InputError(picture,
                    "the image is " + text(size.width, size.height) + " but the calibration " +
                        calibration + " is for " + text(camera.width, camera.height),
                    "use the calibration of this camera at this resolution");
}

/// Checks for options of S-G detection when no S-G markers are detected.
Result<void> CheckUseOfOptions(const CLI::App& command, const DetectArguments& arguments) {
  const bool sg = arguments.size_mm != 0.0 && std::ranges::count(arguments.families, "sg") > 0;
  return RefuseUnusedOptions(command,
                             {{"--strategy", sg, "S-G markers"}, {"--numbers", sg, "S-G markers"}});
}

}  // namespace

Result<void> RunDetect(const DetectArguments& arguments, std::ostream& out) {
  // Targets know their size. Markers are also detected if their size is given.
  const bool only_targets = !arguments.targets.empty() && arguments.size_mm == 0.0;
  if (!only_targets && (!(arguments.size_mm > 0.0) || !std::isfinite(arguments.size_mm))) {
    return InputError("--size-mm", "the marker's size must be positive",
                      "give the edge of its outer black square in millimetres with --size-mm");
  }
  if (!only_targets && (arguments.size_mm < tracker::kMinMarker_m * 1e3 ||
                        arguments.size_mm > tracker::kMaxMarker_m * 1e3)) {
    return InputError("--size-mm", "the marker would be smaller than 0.1 mm or larger than 1 km",
                      "give the edge of its outer black square in millimetres");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const tracker::SgStrategy strategy, StrategyOf(arguments.strategy));
  PLEINAIR_ASSIGN_OR_RETURN(std::vector<int> numbers, MarkerNumbersOf(arguments.numbers));
  PLEINAIR_ASSIGN_OR_RETURN(const CameraModel camera,
                            devices::ReadCalibration(arguments.calibration));
  tracker::TrackerOptions options{.families = arguments.families,
                                  .marker_size_m = arguments.size_mm * 1e-3,
                                  .consecutive_frames = arguments.track,
                                  .sg = {strategy, std::move(numbers)}};
  if (only_targets) options.families.clear();
  for (const std::string& file : arguments.targets) {
    PLEINAIR_ASSIGN_OR_RETURN(tracker::PictureTarget target, tracker::ReadTargetFile(file));
    options.targets.push_back(std::make_shared<const tracker::PictureTarget>(std::move(target)));
  }
  auto tracker = tracker::Tracker::Create(camera, options);
  if (!tracker) {
    const bool of_family = tracker.error().what.find("family") != std::string::npos;
    return LocatedError(std::move(tracker).error(), of_family ? "--family" : arguments.calibration);
  }
  for (const std::string& picture : arguments.pictures) {
    PLEINAIR_RETURN_IF_ERROR(CheckPicture(picture, camera, arguments.calibration));
  }
  for (const std::string& picture : arguments.pictures) {
    PLEINAIR_ASSIGN_OR_RETURN(const devices::DecodedImage decoded,
                              devices::DecodeImageFile(picture));
    const auto start = std::chrono::steady_clock::now();
    auto observations = (*tracker)->Track(decoded.grey.view());
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    if (!observations) return LocatedError(std::move(observations).error(), picture);
    out << "{\"file\":"
        << nlohmann::json(picture).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
        << ",\"milliseconds\":" << nlohmann::json(std::round(elapsed.count() * 1e3) / 1e3).dump()
        << ",\"markers\":" << MarkersJson(*observations);
    if (arguments.track) out << ",\"lost\":" << LostJson((*tracker)->Lost());
    out << "}\n";
    for (const std::string& warning : (*tracker)->Warnings()) {
      std::cerr << "pleinair detect: " << picture << ": " << warning << "\n";
    }
  }
  return {};
}

void AddDetectCommand(CLI::App& app, CommandResult& result) {
  auto arguments = std::make_shared<DetectArguments>();
  CLI::App* command = app.add_subcommand("detect", "Find markers and their poses in images");
  command->footer(kDetectExamples);
  command
      ->add_option("PICTURES", arguments->pictures,
                   "PNG or JPEG images, up to 120 megapixels (30 MB of memory each)")
      ->required();
  command
      ->add_option("--calibration", arguments->calibration,
                   "Camera calibration (own JSON, OpenCV YAML, ROS camera_info, Kalibr)")
      ->required();
  CLI::Option* size =
      command->add_option("--size-mm", arguments->size_mm,
                          "Edge of the outer black square, mm; not needed for targets alone");
  command
      ->add_option("--target", arguments->targets,
                   "Target file that 'pleinair target' made; again for more")
      ->type_name("F")
      ->allow_extra_args(false);
  command->add_option("--family", arguments->families, "Marker families, comma-separated")
      ->delimiter(',')
      ->needs(size)
      ->capture_default_str();
  command->add_flag("--track", arguments->track, "The images are consecutive frames");
  command
      ->add_option("--strategy", arguments->strategy,
                   "How S-G markers are found: hybrid, fast (whole edge seen) or surf-golay")
      ->capture_default_str();
  command
      ->add_option("--numbers", arguments->numbers,
                   "S-G numbers in use, such as 17 or 0-49, comma-separated (default: all 4,096); "
                   "others are not reported, and more of these may be covered")
      ->delimiter(',')
      ->needs(size);
  // `detect` always prints JSON. The flag exists for scripts that always pass it.
  command->add_flag("--json")->description("One JSON object a line (the only form)");
  command->callback([command, arguments, &result] {
    result.status = CheckUseOfOptions(*command, *arguments);
    if (result.status) result.status = RunDetect(*arguments, std::cout);
  });
}

}  // namespace pleinair::app
