#include "app/accuracy/film_plots.h"

#include <limits>
#include <map>

#include "export/plots/line_plot.h"

namespace pleinair::app {

std::string FilmPlots(const std::string& sweep, const std::vector<std::string>& detectors,
                      const std::vector<accuracy::FrameRecord>& records) {
  if (!sweep.starts_with("sequence") && sweep != "recording") return {};
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  struct Film {
    exports::PlotLine x{"x", {}, {}}, y{"y", {}, {}}, z{"z", {}, {}};
    exports::PlotLine place_error{"", {}, {}}, rotation_error{"", {}, {}};
  };
  std::map<std::string, Film> films;
  for (const accuracy::FrameRecord& record : records) {
    if (record.sweep != sweep || record.detector != detectors[0] || record.markers.empty()) {
      continue;
    }
    Film& film = films[record.pattern];
    const accuracy::MarkerRecord& marker = record.markers[0];
    const auto add = [&record](exports::PlotLine& line, double value) {
      line.x.push_back(record.repeat);
      line.y.push_back(value);
    };
    Vec3 place{kGap, kGap, kGap};
    if (marker.pose) place = marker.pose->camera_from_marker.Inverse().translation_m;
    add(film.x, place.x);
    add(film.y, place.y);
    add(film.z, place.z);
    const Vec3 truth = marker.true_camera_from_marker.Inverse().translation_m;
    add(film.place_error, Norm(place - truth) * 1e3);
    add(film.rotation_error, marker.pose ? marker.pose->rotation_error_deg : kGap);
  }
  constexpr const char* kUnit = "frames";
  std::string html;
  for (const auto& [name, film] : films) {
    const std::string of = name.empty() ? "" : name + ": ";
    html += "<div class=\"charts\">" +
            exports::LinePlotSvg(of + "Camera in the marker frame, as found", "m",
                                 {film.x, film.y, film.z}, kUnit) +
            exports::LinePlotSvg(of + "Error of its place", "mm", {film.place_error}, kUnit) +
            exports::LinePlotSvg(of + "Error of its rotation", "°", {film.rotation_error}, kUnit) +
            "</div>\n";
  }
  return html;
}

}  // namespace pleinair::app
