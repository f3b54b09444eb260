#include "content/georeference/operation_choice.h"

#include <algorithm>

namespace pleinair::content {
namespace {

// The area in which operations are ranked, either side of the place: about 10 km.
constexpr double kAreaMargin_deg = 0.1;

ProjList Operations(PJ_CONTEXT* context, const CoordinateSystem& source,
                    const CoordinateSystem& target, const GeodeticPoint& place,
                    PROJ_GRID_AVAILABILITY_USE grids) {
  const ProjFactory factory(proj_create_operation_factory_context(context, nullptr));
  if (!factory) return nullptr;
  proj_operation_factory_context_set_area_of_interest(
      context, factory.get(), std::max(-180.0, place.longitude_deg - kAreaMargin_deg),
      std::max(-90.0, place.latitude_deg - kAreaMargin_deg),
      std::min(180.0, place.longitude_deg + kAreaMargin_deg),
      std::min(90.0, place.latitude_deg + kAreaMargin_deg));
  proj_operation_factory_context_set_spatial_criterion(context, factory.get(),
                                                       PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
  proj_operation_factory_context_set_grid_availability_use(context, factory.get(), grids);
  return ProjList(
      proj_create_operations(context, source.object.get(), target.object.get(), factory.get()));
}

std::vector<std::string> MissingGrids(PJ_CONTEXT* context, const PJ* operation) {
  std::vector<std::string> missing;
  const int count = proj_coordoperation_get_grid_used_count(context, operation);
  for (int i = 0; i < count; ++i) {
    const char* name = nullptr;
    int available = 0;
    if (proj_coordoperation_get_grid_used(context, operation, i, &name, nullptr, nullptr, nullptr,
                                          nullptr, nullptr, &available) &&
        !available && name && *name) {
      missing.emplace_back(name);
    }
  }
  return missing;
}

/// Grids of the first operation of `list` that is no ballpark one; empty: they are all there.
std::vector<std::string> GridsOfBest(PJ_CONTEXT* context, const PJ_OBJ_LIST* list) {
  for (int i = 0; list && i < proj_list_get_count(list); ++i) {
    const ProjObject operation(proj_list_get(context, list, i));
    if (operation && !proj_coordoperation_has_ballpark_transformation(context, operation.get())) {
      return MissingGrids(context, operation.get());
    }
  }
  return {};
}

tl::unexpected<Error> NoHeights(const CoordinateSystem& source, const CoordinateSystem& target,
                                const std::vector<std::string>& missing, const std::string& where) {
  const std::string vertical =
      source.vertical_name.empty() ? target.vertical_name : source.vertical_name;
  const std::string heights = vertical.empty() ? "heights" : "\"" + vertical + "\"";
  const std::string without =
      source.horizontal_code.empty()
          ? ""
          : " or, if the heights share the datum of the place, give --crs " +
                source.horizontal_code;
  if (missing.empty()) {
    return InputError(
        where, "PROJ has no transformation of " + heights + " for this place",
        "use a file with ellipsoidal heights" + (without.empty() ? "" : "," + without));
  }
  return InputError(where,
                    "the grid " + missing.front() + " for " + heights +
                        " is not installed; heights would be wrong by tens of metres",
                    GridRemedy(missing.front()) + (without.empty() ? "" : "," + without));
}

}  // namespace

std::string GridRemedy(const std::string& grid) {
  return "install it with \"projsync --file " + grid +
         "\" (Debian: package proj-bin), or put it into PROJ's data folder";
}

Result<ChosenOperation> ChooseOperation(PJ_CONTEXT* context, const CoordinateSystem& source,
                                        const CoordinateSystem& target, const GeodeticPoint& place,
                                        Heights heights, const std::string& where) {
  const ProjList known = Operations(context, source, target, place, PROJ_GRID_AVAILABILITY_IGNORED);
  const ProjList installed = Operations(context, source, target, place,
                                        PROJ_GRID_AVAILABILITY_DISCARD_OPERATION_IF_MISSING_GRID);
  ChosenOperation chosen;
  chosen.missing_grids = GridsOfBest(context, known.get());
  const int count = installed ? proj_list_get_count(installed.get()) : 0;
  for (int i = 0; i < count; ++i) {
    const ProjObject candidate(proj_list_get(context, installed.get(), i));
    if (!candidate || !proj_coordoperation_is_instantiable(context, candidate.get())) continue;
    const bool ballpark =
        proj_coordoperation_has_ballpark_transformation(context, candidate.get()) != 0;
    if (chosen.object && (ballpark || !chosen.ballpark)) continue;
    ProjObject normalized(proj_normalize_for_visualization(context, candidate.get()));
    if (!normalized) continue;
    const char* name = proj_get_name(candidate.get());
    chosen.name = name ? name : "";
    chosen.accuracy_m = std::max(0.0, proj_coordoperation_get_accuracy(context, candidate.get()));
    chosen.ballpark = ballpark;
    chosen.object = std::move(normalized);
  }
  if (heights == Heights::kTransformed && (!chosen.object || chosen.ballpark)) {
    return NoHeights(source, target, chosen.missing_grids, where);
  }
  if (!chosen.object) {
    return InputError(where, "PROJ has no transformation from " + source.name + " to WGS 84 here",
                      "check the coordinate reference system and the place");
  }
  return chosen;
}

}  // namespace pleinair::content
