#include "scene/lens_description.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pleinair::scene {
namespace {

constexpr int kMinBlades = 3, kMaxBlades = 16;

bool IsLength(double value) { return value > 0.0 && !std::isnan(value); }

Result<void> CheckFocus(const LensFacts& facts, const std::string& where) {
  if (facts.focus_m && facts.focus_dioptres) {
    return InputError(where, "\"focus_m\" and \"focus_dioptres\" are both given",
                      "keep one of them");
  }
  if (facts.focus_m) {
    if (facts.focus_m->empty()) {
      return InputError(where, "\"focus_m\" is an empty list", "give one distance a frame");
    }
    if (!std::all_of(facts.focus_m->begin(), facts.focus_m->end(), IsLength)) {
      return InputError(where, "\"focus_m\" is not greater than zero",
                        "write metres, or \"infinity\"");
    }
    const double focal_length_m = facts.focal_length_mm.value_or(0.0) * 1e-3;
    if (*std::min_element(facts.focus_m->begin(), facts.focus_m->end()) <= focal_length_m) {
      return InputError(where, "\"focus_m\" is nearer than the focal length",
                        "write metres along the optical axis, and the focal length in millimetres");
    }
  }
  if (facts.focus_dioptres) {
    const auto is_valid = [](double value) { return value >= 0.0 && std::isfinite(value); };
    if (facts.focus_dioptres->empty() ||
        !std::all_of(facts.focus_dioptres->begin(), facts.focus_dioptres->end(), is_valid)) {
      return InputError(where, "\"focus_dioptres\" is not a number from 0 up, or a list of them",
                        "write 1 / metres; 0 is infinity");
    }
  }
  return {};
}

Result<void> CheckExposure(const LensFacts& facts, const std::string& where) {
  if (!facts.exposure_ms) return {};
  if (facts.exposure_ms->empty()) {
    return InputError(where, "\"exposure_ms\" is an empty list", "give one time a frame");
  }
  const auto is_time = [](double value) { return IsLength(value) && std::isfinite(value); };
  if (!std::all_of(facts.exposure_ms->begin(), facts.exposure_ms->end(), is_time)) {
    return InputError(where, "\"exposure_ms\" is not greater than zero",
                      "write the milliseconds for which the shutter is open");
  }
  return {};
}

Result<std::optional<double>> Aperture(const LensFacts& facts, const std::string& where) {
  for (const auto& [value, key] :
       {std::pair{facts.aperture_mm, "aperture_mm"}, std::pair{facts.f_number, "f_number"},
        std::pair{facts.focal_length_mm, "focal_length_mm"}}) {
    if (value && !(IsLength(*value) && std::isfinite(*value))) {
      return InputError(where, std::string("\"") + key + "\" is not greater than zero",
                        "leave it out if it is not known");
    }
  }
  if (facts.aperture_mm && facts.f_number) {
    return InputError(where, "\"aperture_mm\" and \"f_number\" are both given", "keep one of them");
  }
  if (facts.f_number && !facts.focal_length_mm) {
    return InputError(where, "\"f_number\" is given without \"focal_length_mm\"",
                      "give both, or aperture_mm, the diameter of the entrance pupil");
  }
  if (facts.focal_length_mm && !facts.f_number) {
    return InputError(where, "\"focal_length_mm\" is given without \"f_number\"",
                      "give both, or aperture_mm, the diameter of the entrance pupil");
  }
  if (facts.f_number) return *facts.focal_length_mm / *facts.f_number * 1e-3;
  if (facts.aperture_mm) return *facts.aperture_mm * 1e-3;
  return std::nullopt;
}

}  // namespace

Result<LensDescription> CompleteLens(const LensFacts& facts, const std::string& where) {
  LensDescription lens;
  PLEINAIR_ASSIGN_OR_RETURN(lens.aperture_m, Aperture(facts, where));
  PLEINAIR_RETURN_IF_ERROR(CheckFocus(facts, where));
  if (facts.focus_m) {
    lens.focus_dioptres = *facts.focus_m;
    for (double& value : lens.focus_dioptres) value = 1.0 / value;
  } else if (facts.focus_dioptres) {
    lens.focus_dioptres = *facts.focus_dioptres;
  }
  PLEINAIR_RETURN_IF_ERROR(CheckExposure(facts, where));
  if (facts.exposure_ms) {
    lens.exposure_s = *facts.exposure_ms;
    for (double& value : lens.exposure_s) value *= 1e-3;
  }
  lens.blades = facts.blades.value_or(0);
  if (lens.blades != 0 && (lens.blades < kMinBlades || lens.blades > kMaxBlades)) {
    return InputError(where, "\"blades\" is " + std::to_string(lens.blades),
                      "write 0 for a round stop, or 3 to 16");
  }
  lens.blade_rotation_deg = facts.blade_rotation_deg.value_or(0.0);
  if (!std::isfinite(lens.blade_rotation_deg)) {
    return InputError(where, "\"blade_rotation_deg\" is not finite", "write degrees");
  }
  return lens;
}

}  // namespace pleinair::scene
