#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/project/film_look.h"
#include "app/project/questions.h"
#include "base/error.h"
#include "devices/films/film_tags.h"
#include "session/marker_tracks.h"

namespace pleinair::app {

/// A value of a new scene, and where it is known from, for the comment beside it.
template <typename T>
struct Sourced {
  T value{};
  std::string from;
};

/// Direction of the marker, as in a scene: degrees clockwise from north.
struct StatedHeading {
  double deg = 0.0;
  bool is_magnetic = false;
};

/// What the user states of a scene on the command line.
struct StatedScene {
  std::optional<std::string> time;  ///< RFC 3339, or with a zone.
  std::optional<devices::FilmTags::Place> place;
  std::optional<StatedHeading> heading;
  std::optional<double> size_mm;
  bool upright = false;
  std::optional<double> marker_height_m;  ///< The marker's centre above the ground.
  std::optional<std::string> sky;         ///< Cloudiness in words.
  std::optional<std::filesystem::path> model;
  bool accepts_tags = false;  ///< Takes what the tags offer, unasked.
};

/// Everything that a new scene.toml says.
struct NewScene {
  Sourced<std::string> time;
  Sourced<devices::FilmTags::Place> place;
  Sourced<StatedHeading> heading;
  ChosenMarker marker;
  double size_mm = 0.0;
  Sourced<bool> upright;
  std::optional<double> marker_height_m;
  Sourced<std::string> sky;
  std::string lens_from;
  std::optional<std::filesystem::path> model;
  std::string film;                ///< Name of the film, for comments.
  std::vector<std::string> notes;  ///< Impossible tags, a scaled calibration: sentences.
};

/// The film of a project, and photographs taken beside it.
struct Footage {
  FilmLook film;
  ChosenMarker marker;
  std::vector<FilmLook> photos;
};

/// Collects a scene from what is stated, what the tags of film and photographs offer, and answers.
/// Tags are used only where the user accepts them. `questions`: null where nobody can be asked.
/// Errors (input): something is stated nowhere, with the options that state it; a stated value that
/// cannot be true.
Result<NewScene> CollectScene(const Footage& footage, const StatedScene& stated,
                              Questions* questions);

/// Checks that every value is stated or offered by tags, where nobody can be asked. `sources`: the
/// film and photographs, before the search for markers. A direction in the tags counts as an
/// offered heading, although the search may not find the marker. Error (input): as CollectScene().
Result<void> CheckNothingIsMissing(const std::vector<FilmLook>& sources, const StatedScene& stated);

/// Checks a time of a scene (ParseTimeOption()) and returns it as it is written.
Result<std::string> ParseSceneTime(const std::string& text);

/// Checks words for the sky and returns them. Error (input): words that are not known.
Result<std::string> ParseSky(const std::string& text);

/// Parses "342", or "337m" as a compass shows it. Error (input): other text, or beyond ±360.
Result<StatedHeading> ParseHeading(const std::string& text);

}  // namespace pleinair::app
