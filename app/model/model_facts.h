#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compositor/models/model.h"

namespace pleinair::app {

/// What a model file contains, and how it is understood.
struct ModelFacts {
  std::size_t meshes = 0, vertices = 0, triangles = 0;
  compositor::ModelBounds bounds;  ///< On a level marker, z up; metres.
  /// Hints where unit, axes or origin are probably not as understood, each with the way out.
  std::vector<std::string> notes;
};

/// Counts a model that was loaded with `frame`. `unit_stated`: the unit is the user's.
ModelFacts FactsOf(const compositor::Model& model, const compositor::ModelFrame& frame,
                   bool unit_stated);

/// The facts as lines of text. `frame`: as the model was loaded.
std::string ModelText(const compositor::Model& model, const compositor::ModelFrame& frame,
                      const ModelFacts& facts);

/// The same as one line of JSON without the line end. `sheet`: the contact sheet written, or empty.
std::string ModelJson(const compositor::Model& model, const compositor::ModelFrame& frame,
                      const ModelFacts& facts, const std::filesystem::path& sheet);

}  // namespace pleinair::app
