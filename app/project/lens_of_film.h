#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/project/film_look.h"
#include "base/error.h"

namespace pleinair::app {

/// The lens of a film, estimated from the markers in at most 24 of its frames (film_lens.h), fewer
/// of large ones. Nothing: these frames do not determine the focal length within 1 %, or show no
/// marker. Errors: those of OpenVideo(); interrupted (system).
Result<std::optional<KnownLens>> LensOfFilm(const std::filesystem::path& film,
                                            const std::vector<std::string>& families);

}  // namespace pleinair::app
