#include <gdal.h>
#include <gdal_frmts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <mutex>
#include <utility>

#include "content/flow/files/component_grid.h"
#include "content/flow/files/field_source.h"
#include "content/flow/files/velocity_units.h"
#include "content/georeference/gdal_handles.h"
#include "content/georeference/stated_crs.h"

namespace pleinair::content {
namespace {

constexpr int kMaxBandSide = 65536;
constexpr const char* kBandsRemedy =
    "give a GeoTIFF of two or three bands (u, v, w), or GRIB with components of wind or current";

/// A raster of velocities: one band for each component and time.
struct Bands {
  std::string where;
  Dataset dataset;
  int width = 0, height = 0;
  std::vector<double> times;                   // As the file states them, seconds since 1970.
  std::vector<std::array<int, 3>> components;  // Band numbers by time; 0: none.
  std::array<std::string, 3> names;
  std::string unit;
  bool is_grib = false;
};

std::string Item(GDALRasterBandH band, const char* name) {
  const char* text = GDALGetMetadataItem(band, name, nullptr);
  return text != nullptr ? text : "";
}

std::string UnitOf(GDALRasterBandH band) {
  const std::string grib = Item(band, "GRIB_UNIT");
  const char* unit = GDALGetRasterUnitType(band);
  return grib.empty() ? std::string(unit != nullptr ? unit : "") : grib;
}

/// The name of a band: that of a GRIB message with its level, or its description.
std::string NameOfBand(GDALRasterBandH band, int number) {
  const std::string element = Item(band, "GRIB_ELEMENT");
  if (!element.empty()) return element + " " + Item(band, "GRIB_SHORT_NAME");
  const char* text = GDALGetDescription(band);
  return text != nullptr && *text != '\0' ? std::string(text).substr(0, 60)
                                          : std::to_string(number);
}

/// GRIB: elements of the same level, one band a time.
Result<void> FindMessages(Bands* bands, const FlowFileOptions& options) {
  constexpr std::array<std::array<const char*, 2>, 3> kPairs = {
      {{"UGRD", "VGRD"}, {"UOGRD", "VOGRD"}, {"UICE", "VICE"}}};
  std::map<std::string, std::map<double, int>> by_name;  // Bands by time.
  std::vector<ArrayNote> notes;
  const int count = GDALGetRasterCount(bands->dataset.get());
  for (int i = 1; i <= count; ++i) {
    GDALRasterBandH band = GDALGetRasterBand(bands->dataset.get(), i);
    const std::string name = NameOfBand(band, i);
    if (by_name[name].empty()) notes.push_back({name, UnitOf(band)});
    by_name[name][std::strtod(Item(band, "GRIB_VALID_TIME").c_str(), nullptr)] = i;
  }
  std::array<std::string, 3> chosen{options.u, options.v, options.w};
  if (chosen[0].empty()) {
    std::string list;
    for (const auto& [name, times] : by_name) {
      for (const auto& pair : kPairs) {
        const std::string u = std::string(pair[0]) + " ";
        if (!name.starts_with(u)) continue;
        const std::string partner = std::string(pair[1]) + " " + name.substr(u.size());
        if (by_name.count(partner) == 0) continue;
        list += (list.empty() ? "" : "; ") + ("\"" + name) + "\", \"" + partner + "\"";
        if (!chosen[0].empty()) {
          chosen[2] = "several";
          continue;
        }
        chosen[0] = name;
        chosen[1] = partner;
      }
    }
    if (chosen[2] == "several") {
      return InputError(bands->where, "has several fields of velocities: " + list.substr(0, 400),
                        "choose one with --u and --v");
    }
    if (chosen[0].empty()) return NoVelocities(bands->where, notes);
  }
  for (std::size_t c = 0; c < 3; ++c) {
    if (chosen[c].empty()) continue;
    if (by_name.count(chosen[c]) == 0) return NoVelocities(bands->where, notes);
  }
  for (const auto& [time, band] : by_name[chosen[0]]) {
    const auto north = by_name[chosen[1]].find(time);
    if (north == by_name[chosen[1]].end()) continue;
    bands->times.push_back(time);
    bands->components.push_back({band, north->second, 0});
  }
  if (bands->components.empty()) {
    return InputError(bands->where, "its components have no time in common", kBandsRemedy);
  }
  bands->names = chosen;
  return {};
}

/// GeoTIFF: the bands u, v and w, or those that are named by number or description.
Result<void> FindBands(Bands* bands, const FlowFileOptions& options) {
  const int count = GDALGetRasterCount(bands->dataset.get());
  std::vector<ArrayNote> notes;
  std::array<int, 3> chosen{};
  const std::array<std::string, 3> wanted{options.u, options.v, options.w};
  for (int i = 1; i <= count; ++i) {
    GDALRasterBandH band = GDALGetRasterBand(bands->dataset.get(), i);
    const std::string name = NameOfBand(band, i);
    notes.push_back({name, UnitOf(band)});
    for (std::size_t c = 0; c < 3; ++c) {
      if (!wanted[c].empty() && (wanted[c] == name || wanted[c] == std::to_string(i)))
        chosen[c] = i;
    }
  }
  if (wanted[0].empty()) {
    if (count < 2 || count > 3) return NoVelocities(bands->where, notes);
    chosen = {1, 2, count == 3 ? 3 : 0};
  }
  for (std::size_t c = 0; c < 3; ++c) {
    if (chosen[c] == 0 && !wanted[c].empty()) return NoVelocities(bands->where, notes);
  }
  if (chosen[0] == 0 || chosen[1] == 0) return NoVelocities(bands->where, notes);
  for (std::size_t c = 0; c < 3; ++c) {
    if (chosen[c] == 0) continue;
    bands->names[c] = NameOfBand(GDALGetRasterBand(bands->dataset.get(), chosen[c]), chosen[c]);
  }
  bands->components = {chosen};
  return {};
}

Result<std::vector<double>> ReadBand(const Bands& bands, int number) {
  const QuietErrors quiet;
  GDALRasterBandH band = GDALGetRasterBand(bands.dataset.get(), number);
  std::vector<double> values(static_cast<std::size_t>(bands.width) *
                             static_cast<std::size_t>(bands.height));
  if (GDALRasterIO(band, GF_Read, 0, 0, bands.width, bands.height, values.data(), bands.width,
                   bands.height, GDT_Float64, 0, 0) != CE_None) {
    return InputError(bands.where, "is damaged: " + QuietErrors::Last("cannot be read"),
                      "download or export the file again");
  }
  const std::string unit = UnitOf(band);
  const auto metres = unit.empty() ? std::optional<double>(1.0) : MetresPerSecond(unit);
  if (!metres) {
    return InputError(bands.where,
                      "the unit of band " + std::to_string(number) + " is \"" + unit.substr(0, 40) +
                          "\", which is not known",
                      std::string("convert it to one of ") + kVelocityUnits);
  }
  int has_nodata = 0, has = 0;
  const double nodata = GDALGetRasterNoDataValue(band, &has_nodata);
  double scale = GDALGetRasterScale(band, &has);
  if (has == 0 || scale == 0.0) scale = 1.0;
  const double offset = GDALGetRasterOffset(band, &has);
  for (double& value : values) {
    const bool missing = !std::isfinite(value) || (has_nodata != 0 && value == nodata);
    value = missing ? std::numeric_limits<double>::quiet_NaN()
                    : (value * scale + (has != 0 ? offset : 0.0)) * *metres;
  }
  return values;
}

Result<std::shared_ptr<Bands>> OpenBands(const std::string& path, const std::string& where,
                                         const FlowFileOptions& options) {
  static std::once_flag once;
  std::call_once(once, [] {
    GDALRegister_GTiff();
    GDALRegister_GRIB();
  });
  constexpr std::array<const char*, 3> kDrivers = {"GTiff", "GRIB", nullptr};
  auto bands = std::make_shared<Bands>();
  bands->where = where;
  bands->dataset.reset(GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, kDrivers.data(),
                                  nullptr, nullptr));
  if (!bands->dataset) {
    const std::string message = QuietErrors::Last("");
    return InputError(where, message.empty() ? "cannot be read" : "cannot be read: " + message,
                      kBandsRemedy);
  }
  bands->width = GDALGetRasterXSize(bands->dataset.get());
  bands->height = GDALGetRasterYSize(bands->dataset.get());
  if (std::min(bands->width, bands->height) < 2 ||
      std::max(bands->width, bands->height) > kMaxBandSide) {
    return InputError(
        where,
        "has " + std::to_string(bands->width) + " x " + std::to_string(bands->height) + " cells",
        "cut out what lies near the marker, with 2 to " + std::to_string(kMaxBandSide) +
            " cells a side");
  }
  bands->is_grib =
      std::string_view(GDALGetDriverShortName(GDALGetDatasetDriver(bands->dataset.get()))) ==
      "GRIB";
  if (bands->is_grib) {
    PLEINAIR_RETURN_IF_ERROR(FindMessages(bands.get(), options));
  } else {
    PLEINAIR_RETURN_IF_ERROR(FindBands(bands.get(), options));
  }
  bands->unit = UnitOf(GDALGetRasterBand(bands->dataset.get(), bands->components.front().front()));
  return bands;
}

}  // namespace

Result<FlowFile> ReadBandsFlow(const std::string& path, const std::string& where,
                               const FlowFileOptions& options) {
  const QuietErrors quiet;
  PLEINAIR_ASSIGN_OR_RETURN(const std::shared_ptr<Bands> bands, OpenBands(path, where, options));
  std::array<double, 6> map{};
  if (GDALGetGeoTransform(bands->dataset.get(), map.data()) != CE_None || map[2] != 0.0 ||
      map[4] != 0.0) {
    return InputError(where, "states no place of its cells, or a turned grid",
                      "export it with its georeference, rows from west to east");
  }
  OGRSpatialReferenceH srs = GDALGetSpatialRef(bands->dataset.get());
  const bool geographic = srs != nullptr && OSRIsGeographic(srs) != 0 && options.crs.empty();
  const StatedCrs stated = ReadStatedCrs(srs);
  std::array<SourceAxis, 3> source;
  source[0].longitude = geographic;
  for (int x = 0; x < bands->width; ++x) source[0].nodes.push_back(map[0] + (x + 0.5) * map[1]);
  for (int y = 0; y < bands->height; ++y) source[1].nodes.push_back(map[3] + (y + 0.5) * map[5]);
  source[2].nodes = {0.0};
  FieldChart chart;
  if (geographic) {
    chart = FieldChart::Geographic(MiddleOf(source[0]), MiddleOf(source[1]));
  } else if (options.crs != "marker") {
    const std::string crs = options.crs.empty() ? stated.text : options.crs;
    if (!crs.empty()) chart = FieldChart::Projected(crs);
  }
  const Vec3 unit =
      chart.FromFile({chart.middle().longitude_deg + 1.0, chart.middle().latitude_deg + 1.0, 0.0});
  std::array<FieldAxis, 3> axes;
  const std::array<const char*, 3> names{"x", "y", "z"};
  for (std::size_t a = 0; a < 3; ++a) {
    const bool degrees = geographic && a < 2;
    const double middle = !degrees ? 0.0
                          : a == 0 ? chart.middle().longitude_deg
                                   : chart.middle().latitude_deg;
    PLEINAIR_ASSIGN_OR_RETURN(
        axes[a],
        MakeFieldAxis(source[a], middle, !degrees ? 1.0 : (a == 0 ? unit.x : unit.y), names[a]));
  }
  auto grid = std::make_shared<ComponentGrid>(
      std::move(axes), std::array<std::size_t, 3>{1, static_cast<std::size_t>(bands->width), 0},
      CurvilinearCells(), chart);
  std::vector<Seconds> times;
  for (const double time : bands->times) times.push_back(time - bands->times.front());
  const auto read = [bands, grid](std::size_t time) -> Result<FieldSlice> {
    std::array<std::vector<double>, 3> values;
    std::array<const std::vector<double>*, 3> pointers{};
    for (std::size_t c = 0; c < 3; ++c) {
      if (bands->components[time][c] == 0) continue;
      PLEINAIR_ASSIGN_OR_RETURN(values[c], ReadBand(*bands, bands->components[time][c]));
      pointers[c] = &values[c];
    }
    return grid->Combine(pointers, false);
  };
  PLEINAIR_ASSIGN_OR_RETURN(FlowFile flow, MakeFlowFile(grid, times, read, chart, options));
  for (const std::string& name : bands->names) {
    if (!name.empty()) flow.arrays.push_back(name);
  }
  flow.unit = bands->unit;
  if (flow.unit.empty()) flow.warnings.emplace_back("the bands state no unit; taken for m s-1");
  if (!bands->times.empty() && bands->times.front() > 0.0) {
    flow.first_time = UtcTime(0).PlusSeconds(bands->times.front());
  }
  if (geographic) flow.half_width_deg = std::max(HalfWidthOf(source[0]), HalfWidthOf(source[1]));
  return flow;
}

}  // namespace pleinair::content
