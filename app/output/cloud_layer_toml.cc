#include "app/output/cloud_layer_toml.h"

#include <fmt/format.h>

namespace pleinair::app {

std::string CloudLayerToml(const clouds::CloudLayer& layer) {
  std::string text = fmt::format(
      "[[cloud_layer]]\nkind = \"{}\"\ncover = {}\noptical_depth = {}\nbase_m = {}\n"
      "thickness_m = {}\ncell_m = {}\nwind_m_s = {}\nwind_from_deg = {}\nseed = {}\n",
      clouds::NameOf(layer.kind), layer.cover, layer.optical_depth, layer.base_m, layer.thickness_m,
      layer.cell_m, layer.wind_m_s, layer.wind_from_deg, layer.seed);
  if (layer.east_m != 0.0 || layer.north_m != 0.0) {
    text += fmt::format("east_m = {}\nnorth_m = {}\n", layer.east_m, layer.north_m);
  }
  const clouds::CloudPassing& passing = layer.passing;
  if (passing.seconds.empty()) return text;
  return text + fmt::format(
                    "[cloud_layer.passing]\neast_m = {}\nnorth_m = {}\nwidth_m = {}\n"
                    "seconds = [{}]\nshifts = [{}]\n",
                    passing.east_m, passing.north_m, passing.width_m,
                    fmt::join(passing.seconds, ", "), fmt::join(passing.shifts, ", "));
}

}  // namespace pleinair::app
