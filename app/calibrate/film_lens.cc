#include "app/calibrate/film_lens.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "app/terminal/interrupt.h"
#include "app/terminal/progress_bar.h"

namespace pleinair::app {
namespace {

using tracker::MarkerViewCollector;

/// Measuring and estimating alternate at most so often, and end when the focal length moves by less
/// than this share of its deviation.
constexpr int kMaxRounds = 5;
constexpr double kSettled = 0.1;
/// A larger difference between tag and film is reported: the film is cropped, or the tag is wrong.
constexpr double kTagDiffers = 0.03;

/// Reads the next images, at most `count`; none at the end. Errors: another size than `size`, which
/// the first image sets.
Result<std::vector<NamedPicture>> ReadPictures(PictureStream& pictures, std::size_t count,
                                               ImageSize* size) {
  std::vector<NamedPicture> read;
  while (read.size() < count) {
    PLEINAIR_ASSIGN_OR_RETURN(std::optional<NamedPicture> picture, pictures.Next());
    if (!picture) break;
    const ImageSize here{picture->grey.width(), picture->grey.height()};
    if (size->width == 0) *size = here;
    if (here != *size) {
      return InputError(picture->name,
                        fmt::format("has {}x{} pixels, and those before have {}x{}", here.width,
                                    here.height, size->width, size->height),
                        "a calibration is for one size: give images of one camera at one size");
    }
    read.push_back(*std::move(picture));
  }
  return read;
}

std::string ImageCount(int count) {
  return fmt::format("{} {}", count, count == 1 ? "image" : "images");
}

/// Collects the views of all frames.
Result<MarkerViewCollector> Collect(PictureStream& pictures, const std::string& source,
                                    const tracker::MarkerViewOptions& options, ImageSize* size,
                                    FilmLens* film) {
  const std::size_t at_once = options.consecutive_frames ? 1 : options.images_at_once;
  std::optional<MarkerViewCollector> collector;
  ProgressBar bar("Finding markers", pictures.Count(), "images");
  while (true) {
    PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(source));
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<NamedPicture> read,
                              ReadPictures(pictures, at_once, size));
    if (read.empty()) break;
    if (!collector) {
      PLEINAIR_ASSIGN_OR_RETURN(collector, MarkerViewCollector::Create(*size, options));
    }
    std::vector<tracker::NamedImage> images;
    images.reserve(read.size());
    for (const NamedPicture& picture : read) {
      images.push_back({picture.name, picture.grey.view()});
    }
    PLEINAIR_ASSIGN_OR_RETURN(const int with_marker, collector->Add(images));
    film->looked_at += static_cast<int>(read.size());
    film->with_marker += with_marker;
    for (std::size_t i = 0; i < read.size(); ++i) bar.Advance();
  }
  if (film->with_marker == 0) {
    return InputError(source, fmt::format("shows no marker in {}", ImageCount(film->looked_at)),
                      "name its family with --marker (sg, tag36h11, ...)");
  }
  return *std::move(collector);
}

double Equivalent35mm(const CameraModel& camera) {
  return camera.fx / FocalFrom35mm(1.0, {camera.width, camera.height});
}

}  // namespace

double FocalFrom35mm(double focal_length_35mm, ImageSize size) {
  return focal_length_35mm * std::hypot(size.width, size.height) / std::hypot(36.0, 24.0);
}

Result<FilmLens> EstimateFilmLens(PictureStream& pictures, const std::string& source,
                                  tracker::MarkerViewOptions options) {
  if (pictures.is_live()) {
    return InputError(source, "is a camera, and --marker needs a film that ends",
                      "record it first (pleinair live --record), or use a board");
  }
  options.consecutive_frames = pictures.is_film();
  FilmLens film;
  ImageSize size;
  PLEINAIR_ASSIGN_OR_RETURN(const MarkerViewCollector collector,
                            Collect(pictures, source, options, &size, &film));
  if (const auto tag = pictures.FocalLength35mm()) film.tag_focal_px = FocalFrom35mm(*tag, size);
  CameraModel camera;
  camera.width = size.width;
  camera.height = size.height;
  camera.fx = camera.fy = film.tag_focal_px.value_or(0.9 * std::max(size.width, size.height));
  camera.cx = 0.5 * (size.width - 1);
  camera.cy = 0.5 * (size.height - 1);
  const auto located = [&](Error error) {
    if (error.where.empty()) error.where = source;
    return tl::make_unexpected(std::move(error));
  };
  ProgressBar bar("Measuring", std::nullopt, "rounds");
  for (int round = 0; round < kMaxRounds; ++round) {
    PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(source));
    auto lens =
        tracker::EstimateMarkerLens(collector.Measure(camera), size.width, size.height, camera.fx);
    if (!lens) return located(std::move(lens).error());
    film.lens = *std::move(lens);
    const double moved = std::fabs(film.lens.camera.fx - camera.fx);
    camera = film.lens.camera;
    bar.Advance();
    if (round > 0 && moved <= kSettled * film.lens.deviations.focal_px) break;
  }
  if (auto determined = tracker::CheckDetermined(film.lens); !determined) {
    return located(std::move(determined).error());
  }
  return film;
}

std::string FilmLensSentence(const FilmLens& film) {
  const double focal = film.lens.camera.fx, deviation = film.lens.deviations.focal_px;
  std::string text = fmt::format(
      "focal length {:.2f} +- {:.2f} px ({:.2f} %, {:.1f} mm on 35 mm film), from {} views of the "
      "marker",
      focal, deviation, 100.0 * deviation / focal, Equivalent35mm(film.lens.camera),
      film.lens.used.size());
  if (film.tag_focal_px && std::fabs(*film.tag_focal_px / focal - 1.0) > kTagDiffers) {
    text += fmt::format("; the film's tag states {:.1f} mm: it is cropped, or the tag is wrong",
                        *film.tag_focal_px / focal * Equivalent35mm(film.lens.camera));
  }
  return text;
}

std::string FilmLensText(const FilmLens& film) {
  const CameraModel& camera = film.lens.camera;
  const tracker::MarkerLensDeviations& doubt = film.lens.deviations;
  return fmt::format(
      "marker seen in {} of {} of {}x{}\n{}\n"
      "center {:.2f}, {:.2f} +- {:.2f}, {:.2f} px; k1 {:.5f} +- {:.5f}, k2 {:.5f} +- {:.5f}; "
      "chi2 {:.2f}\n",
      film.with_marker, ImageCount(film.looked_at), camera.width, camera.height,
      FilmLensSentence(film), camera.cx, camera.cy, doubt.cx_px, doubt.cy_px, camera.distortion[0],
      doubt.k1, camera.distortion[1], doubt.k2, film.lens.chi2);
}

nlohmann::ordered_json FilmLensJson(const FilmLens& film) {
  const CameraModel& camera = film.lens.camera;
  const tracker::MarkerLensDeviations& doubt = film.lens.deviations;
  nlohmann::ordered_json json = {{"image_width", camera.width},
                                 {"image_height", camera.height},
                                 {"fx", camera.fx},
                                 {"fy", camera.fy},
                                 {"cx", camera.cx},
                                 {"cy", camera.cy}};
  json["distortion"] = {{"k1", camera.distortion[0]}, {"k2", camera.distortion[1]}};
  json["standard_deviations"] = {{"fx", doubt.focal_px}, {"fy", doubt.focal_px},
                                 {"cx", doubt.cx_px},    {"cy", doubt.cy_px},
                                 {"k1", doubt.k1},       {"k2", doubt.k2}};
  json["chi2"] = film.lens.chi2;
  json["images"] = film.looked_at;
  json["with_marker"] = film.with_marker;
  json["views"] = film.lens.used.size();
  json["max_tilt_deg"] = film.lens.max_tilt_deg;
  json["distance_ratio"] = film.lens.distance_ratio;
  json["focal_length_35mm"] = Equivalent35mm(camera);
  if (film.tag_focal_px) {
    json["tag_focal_length_35mm"] = *film.tag_focal_px / camera.fx * Equivalent35mm(camera);
  }
  return json;
}

std::map<std::string, double> FilmLensNotes(const FilmLens& film) {
  return {{"views", static_cast<double>(film.lens.used.size())},
          {"chi2", film.lens.chi2},
          {"fx_deviation_px", film.lens.deviations.focal_px},
          {"fy_deviation_px", film.lens.deviations.focal_px},
          {"cx_deviation_px", film.lens.deviations.cx_px},
          {"cy_deviation_px", film.lens.deviations.cy_px}};
}

}  // namespace pleinair::app
