#include <fmt/format.h>

#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "devices/films/film_facts.h"
#include "devices/images/image_file.h"
#include "devices/recordings/video_file.h"
#include "files/text_file.h"

namespace pleinair::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFilmExamples =
    "Examples:\n"
    "  pleinair film walk.mov\n"
    "      size, rate, colors, sound, and what the phone wrote of place, time and lens\n"
    "  pleinair film walk.mov still.jpg --json\n"
    "      one JSON object a file\n"
    "Place, time and direction are those of the phone: check them before you write them into the\n"
    "scene (docs/guide/film.md).";

/// A film or a photograph, as far as it is described.
struct Described {
  std::string file;
  ImageSize size;
  std::optional<std::int64_t> frames;  ///< Nothing: a photograph.
  double frame_rate_hz = 0.0;
  devices::FilmFacts facts;
};

constexpr std::uintmax_t kMaxPhotoBytes = std::uintmax_t{256} << 20;

Result<Described> Describe(const std::string& file) {
  Described described;
  described.file = file;
  if (devices::IsImageFile(file)) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::string bytes, files::ReadWholeFile(file, kMaxPhotoBytes));
    PLEINAIR_ASSIGN_OR_RETURN(described.size, devices::InspectImage(bytes, file));
    described.facts.tags = devices::TagsOfPhoto(bytes);
    return described;
  }
  PLEINAIR_ASSIGN_OR_RETURN(devices::OpenedVideo video, devices::OpenVideo(file, {}));
  described.size = video.size;
  described.frames = video.frames->FrameCount();
  described.frame_rate_hz = video.frame_rate_hz;
  described.facts = std::move(video.facts);
  return described;
}

Json JsonOf(const Described& film) {
  const devices::FilmFacts& facts = film.facts;
  const devices::FilmTags& tags = facts.tags;
  Json json{{"file", film.file}, {"width", film.size.width}, {"height", film.size.height}};
  if (film.frames) {
    json["frames"] = *film.frames;
    json["frame_rate_hz"] = film.frame_rate_hz;
    json["duration_s"] = facts.duration_s;
    json["longest_interval_s"] = facts.longest_interval_s;
    json["longest_interval_after_frame"] = facts.longest_interval_after;
    json["codec"] = facts.codec;
    json["colors"] = facts.colors;
    json["hdr"] = facts.is_hdr;
    json["clockwise_deg"] = facts.clockwise_deg;
    json["mirrored"] = facts.is_mirrored;
    if (!facts.sound_codec.empty()) json["sound"] = facts.sound_codec;
  }
  if (tags.place) {
    json["latitude_deg"] = tags.place->latitude_deg;
    json["longitude_deg"] = tags.place->longitude_deg;
    if (tags.place->height_m) json["height_m"] = *tags.place->height_m;
  }
  if (!tags.time.empty()) json["time"] = tags.time;
  if (tags.view_heading_deg) {
    json["view_heading_deg"] = *tags.view_heading_deg;
    json["view_heading_is_magnetic"] = tags.view_heading_is_magnetic;
  }
  if (!tags.camera.empty()) json["camera"] = tags.camera;
  if (tags.focal_length_35mm) json["focal_length_35mm"] = *tags.focal_length_35mm;
  if (!tags.rejected.empty()) json["rejected"] = tags.rejected;
  return json;
}

std::string FilmText(const Described& film) {
  const devices::FilmFacts& facts = film.facts;
  std::string text = fmt::format("{}: {}x{}", film.file, film.size.width, film.size.height);
  if (!film.frames) return text + "\n";
  if (facts.clockwise_deg != 0) text += fmt::format(", turned by {} degrees", facts.clockwise_deg);
  if (facts.is_mirrored) text += ", mirrored";
  text += fmt::format(", {}, {}\n", facts.codec, facts.colors);
  text += fmt::format("  {} frames", *film.frames);
  if (facts.duration_s > 0.0) text += fmt::format(" in {:.3f} s", facts.duration_s);
  text += fmt::format(", {:.4g} a second", film.frame_rate_hz);
  constexpr double kPause = 1.5;  // Of the usual interval.
  if (facts.longest_interval_s * film.frame_rate_hz > kPause) {
    text += fmt::format("; a pause of {:.3f} s after frame {}", facts.longest_interval_s,
                        facts.longest_interval_after);
  }
  text += "\n  sound: " + (facts.sound_codec.empty() ? "none" : facts.sound_codec) + "\n";
  if (facts.is_hdr) {
    text += "  HDR: what is brighter than reference white is clipped; film in SDR if you can\n";
  }
  return text;
}

/// Lines of a scene.toml that the tags offer.
std::string TagText(const devices::FilmTags& tags) {
  std::string text;
  if (!tags.camera.empty()) text += "  camera: " + tags.camera;
  if (tags.focal_length_35mm) {
    text += fmt::format("{} {:g} mm (35 mm film)", tags.camera.empty() ? "  lens:" : ",",
                        *tags.focal_length_35mm);
  }
  if (!text.empty()) text += "\n";
  for (const std::string& sentence : tags.rejected) text += "  " + sentence + "\n";
  if (tags.view_heading_deg) {
    text +=
        fmt::format("  the camera looked to {:g} degrees, clockwise from {} north\n",
                    *tags.view_heading_deg, tags.view_heading_is_magnetic ? "magnetic" : "true");
  }
  if (tags.time.empty() && !tags.place) return text;
  text += "Check these, then write them into scene.toml:\n";
  if (!tags.time.empty()) text += fmt::format("time = \"{}\"\n", tags.time);
  if (!tags.place) return text;
  text += fmt::format("[place]\nlatitude_deg = {:.6f}\nlongitude_deg = {:.6f}\n",
                      tags.place->latitude_deg, tags.place->longitude_deg);
  if (tags.place->height_m) text += fmt::format("height_m = {:.0f}\n", *tags.place->height_m);
  return text;
}

struct FilmArguments {
  std::vector<std::string> files;
  bool json = false;
};

Result<void> RunFilm(const FilmArguments& arguments) {
  std::vector<Described> all;
  for (const std::string& file : arguments.files) {
    PLEINAIR_ASSIGN_OR_RETURN(Described described, Describe(file));
    all.push_back(std::move(described));
  }
  for (const Described& film : all) {
    if (arguments.json) {
      std::cout << JsonOf(film).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                << '\n';
    } else {
      std::cout << FilmText(film) << TagText(film.facts.tags);
    }
  }
  return {};
}

}  // namespace

void AddFilmCommand(CLI::App& app, CommandResult& result) {
  CLI::App* command =
      app.add_subcommand("film", "Describe films and photographs, and offer their place and time");
  command->footer(kFilmExamples);
  auto arguments = std::make_shared<FilmArguments>();
  command->add_option("FILE", arguments->files, "Films, or photographs (JPEG)")->required();
  command->add_flag("--json", arguments->json, "One JSON object a file");
  command->callback([arguments, &result] { result.status = RunFilm(*arguments); });
}

}  // namespace pleinair::app
