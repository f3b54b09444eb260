#pragma once

#include <string>

#include "base/error.h"
#include "devices/films/film_tags.h"

namespace pleinair::app {

/// Parses the option --at, "LAT,LON" or "LAT,LON,HEIGHT" in degrees and metres. Error (input):
/// other text, or a place beyond the poles or the date line.
Result<devices::FilmTags::Place> ParsePlace(const std::string& text);

}  // namespace pleinair::app
