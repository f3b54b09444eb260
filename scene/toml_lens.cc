#include "scene/toml_lens.h"

#include <limits>
#include <string>
#include <vector>

namespace pleinair::scene {

Result<std::optional<LensDescription>> ReadLensTable(const TomlTable& scene) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<TomlTable> tables, scene.Tables("lens"));
  if (tables.empty()) return std::nullopt;
  if (tables.size() > 1) return scene.Fail("lens", "is given more than once", "keep one lens");
  const TomlTable& table = tables[0];
  PLEINAIR_RETURN_IF_ERROR(table.AllowOnly({"focus_m", "aperture_mm", "f_number", "focal_length_mm",
                                            "blades", "blade_rotation_deg", "exposure_ms"}));
  LensFacts facts;
  const toml::node* focus = table.Find("focus_m");
  if (focus != nullptr && focus->is_string()) {
    if (focus->value_or(std::string()) != "infinity") {
      return table.Fail("focus_m", "is neither a number nor \"infinity\"",
                        "write metres, or \"infinity\"");
    }
    facts.focus_m = {std::numeric_limits<double>::infinity()};
  } else {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> focus_m, table.Number("focus_m"));
    if (focus_m) facts.focus_m = {*focus_m};
  }
  PLEINAIR_ASSIGN_OR_RETURN(facts.aperture_mm, table.Number("aperture_mm"));
  PLEINAIR_ASSIGN_OR_RETURN(facts.f_number, table.Number("f_number"));
  PLEINAIR_ASSIGN_OR_RETURN(facts.focal_length_mm, table.Number("focal_length_mm"));
  PLEINAIR_ASSIGN_OR_RETURN(facts.blades, table.Integer("blades"));
  PLEINAIR_ASSIGN_OR_RETURN(facts.blade_rotation_deg, table.Number("blade_rotation_deg"));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> exposure_ms, table.Number("exposure_ms"));
  if (exposure_ms) facts.exposure_ms = {*exposure_ms};
  PLEINAIR_ASSIGN_OR_RETURN(LensDescription lens, CompleteLens(facts, table.WhereHere()));
  return lens;
}

}  // namespace pleinair::scene
