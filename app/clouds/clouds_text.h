#pragma once

#include <string>

#include "sky/clouds/film/film_course.h"
#include "sky/clouds/film/film_layer.h"

namespace pleinair::app {

/// The fitted layer as a table of a scene, after comments with its uncertainty. Empty without
/// clouds.
std::string FilmLayerToml(const clouds::FilmLayer& fitted, const clouds::FilmLayerFacts& facts,
                          const std::string& recording);

/// The same as one line of JSON.
std::string FilmLayerJson(const clouds::FilmLayer& fitted, const clouds::FilmLayerFacts& facts,
                          const clouds::FilmCourse& course);

/// seconds, sun and sky of the film, and those of the layer. Empty fields where the sky is unknown.
std::string FilmCourseCsv(const clouds::FilmCourse& course, const clouds::FilmLayer& fitted);

}  // namespace pleinair::app
