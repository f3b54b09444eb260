#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "compositor/leaf/leaf_inversion.h"

namespace pleinair::app {

/// Parses a CSV spectrum: the columns wavelength_nm, reflectance and transmittance, in any order;
/// one of the last two may be missing. Rows outside 400…2500 nm are left out, because the model
/// ends there. `file` is the file's name; errors contain it and the line. Errors (input): unknown,
/// repeated or missing columns, values that are no numbers or far outside 0…1.
Result<compositor::MeasuredSpectrum> ParseMeasuredSpectrum(std::string_view text,
                                                           const std::string& file);

/// A fit for people, and as a JSON object in one line.
std::string LeafFitText(const compositor::LeafFit& fit);
std::string LeafFitJson(const compositor::LeafFit& fit);

}  // namespace pleinair::app
