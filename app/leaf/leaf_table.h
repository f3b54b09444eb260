#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/leaf_contents.h"

namespace pleinair::app {

/// A leaf of a table, or that of the command line.
struct NamedLeaf {
  std::string name;
  scene::Leaf leaf;
};

/// Parses a CSV table of leaves: the columns name, model, refractive_r, refractive_g, refractive_b
/// and the keys of scene::kLeafQuantities, in any order. Missing columns and empty fields take
/// their values from a default scene::Leaf; a leaf without a name is called by its number. `file`
/// is the file's name; errors contain it and the line. Errors (input): an empty table, unknown or
/// repeated columns, unknown models, values that are no numbers or outside their range.
Result<std::vector<NamedLeaf>> ParseLeafTable(std::string_view text, const std::string& file);

/// The model of that name. Errors (input): unknown.
Result<scene::LeafModel> ParseLeafModel(std::string_view name, const std::string& where);

/// Errors (input): the refractive index `key` is outside its range. `where` locates it.
Result<void> CheckLeafRefraction(const std::string& key, double value, const std::string& where);

/// Writes the colors of the leaves under D65 to standard output: CSV, or with `json` an object per
/// line. Errors: as WriteError.
Result<void> WriteLeafColors(const std::vector<NamedLeaf>& leaves, bool json);

/// Writes the spectra of the leaves at every nanometre from `first_nm` to `last_nm` as CSV. Errors
/// (input): a leaf of the model plate, which has no spectrum; as WriteError.
Result<void> WriteLeafSpectra(const std::vector<NamedLeaf>& leaves, const std::string& file,
                              int first_nm, int last_nm);

/// One leaf with its colors under D65, for people and as a JSON object in one line.
std::string LeafText(const scene::Leaf& leaf);
std::string LeafJson(const NamedLeaf& leaf);

}  // namespace pleinair::app
