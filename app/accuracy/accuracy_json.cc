#include "app/accuracy/accuracy_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace pleinair::app {
namespace {

using Json = nlohmann::ordered_json;
using accuracy::Interval;
using accuracy::Spread;

/// Nine significant digits; null if not finite.
Json Number(double value) {
  if (!std::isfinite(value)) return {};
  if (value == 0.0) return 0.0;
  const double scale = std::pow(10.0, 8 - std::floor(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}

Json IntervalJson(const Interval& interval) {
  return {Number(interval.low), Number(interval.high)};
}

Json SpreadJson(const Spread& spread, double unit = 1.0) {
  return {{"median", Number(spread.median * unit)},
          {"p95", Number(spread.p95 * unit)},
          {"p99", Number(spread.p99 * unit)},
          {"rms", Number(spread.rms * unit)}};
}

Json NeesJson(const accuracy::NeesSummary& nees) {
  return {{"count", nees.count},
          {"mean", Number(nees.mean)},
          {"band", IntervalJson(nees.band)},
          {"consistent", nees.band.Contains(nees.mean)}};
}

Json CellJson(const accuracy::CellSummary& cell) {
  Json json{{"detector", cell.detector},
            {"sweep", cell.sweep},
            {"pattern", cell.pattern.empty() ? Json() : Json(cell.pattern)},
            {"level", cell.level ? Json(*cell.level) : Json()},
            {"frames", cell.counts.frames},
            {"markers", cell.counts.markers},
            {"hits", cell.counts.hits},
            {"rate", cell.counts.markers > 0 ? Number(static_cast<double>(cell.counts.hits) /
                                                      static_cast<double>(cell.counts.markers))
                                             : Json()},
            {"rate_interval", IntervalJson(cell.rates.hits)},
            {"misplaced", cell.counts.misplaced},
            {"false_numbers", cell.counts.false_numbers},
            {"false_frames_interval", IntervalJson(cell.rates.false_frames)}};
  if (cell.counts.hits == 0) return json;
  json["flips"] = cell.counts.flips;
  json["corner_px"] = SpreadJson(cell.corner_px);
  json["corner_bias_px"] = {{"x", Number(cell.bias_px.x)},
                            {"y", Number(cell.bias_px.y)},
                            {"outward", Number(cell.bias_px.outward)}};
  json["rotation_deg"] = SpreadJson(cell.rotation_deg);
  json["translation_mm"] = SpreadJson(cell.translation_m, 1e3);
  json["translation_percent"] = SpreadJson(cell.translation_share, 1e2);
  if (cell.nees) json["nees"] = NeesJson(*cell.nees);
  return json;
}

Json JitterJson(const accuracy::JitterSummary& jitter) {
  return {{"detector", jitter.detector},
          {"pattern", jitter.pattern},
          {"level", jitter.level},
          {"frames", jitter.frames},
          {"corner_std_px", Number(jitter.corner_std_px)},
          {"corner_bias_px", Number(jitter.corner_bias_px)},
          {"translation_std_mm", Number(jitter.translation_std_m * 1e3)},
          {"rotation_std_deg", Number(jitter.rotation_std_deg)}};
}

Json FilmJson(const accuracy::FilmSummary& film) {
  return {{"detector", film.detector},
          {"film", film.film},
          {"frames", film.frames},
          {"found", film.found},
          {"tracks", film.tracks.count},
          {"median_track", Number(film.median_track)},
          {"longest_track", film.tracks.longest},
          {"lost", film.losses.count},
          {"told_lost", film.losses.reported},
          {"gaps", film.gaps.count},
          {"longest_gap", film.gaps.longest},
          {"recovered", film.losses.recovered},
          {"step_jitter_px", Number(film.step_jitter_px)},
          {"ate_rmse_mm", Number(film.trajectory.ate_m * 1e3)},
          {"truth_aligned", film.truth_aligned},
          {"ate_unaligned_rmse_mm",
           film.truth_aligned ? Json() : Number(film.trajectory.ate_unaligned_m * 1e3)},
          {"rpe_translation_rmse_mm", Number(film.trajectory.rpe_translation_m * 1e3)},
          {"rpe_rotation_rmse_deg", Number(film.trajectory.rpe_rotation_deg)}};
}

Json PeerJson(const accuracy::PeerSummary& peer) {
  const auto ratio = [](const accuracy::PeerRatio& of) {
    return Json{{"ratio", Number(of.value)}, {"interval", IntervalJson(of.interval)}};
  };
  return {{"sweep", peer.sweep},
          {"film", peer.film.empty() ? Json() : Json(peer.film)},
          {"peer", peer.peer},
          {"markers", peer.hits.markers},
          {"both", peer.hits.both},
          {"only_ours", peer.hits.only_ours},
          {"only_peer", peer.hits.only_peer},
          {"mcnemar_p", Number(peer.hits.p)},
          {"rate", ratio(peer.rate)},
          {"corner_px", ratio(peer.corner)},
          {"rotation_deg", ratio(peer.rotation)},
          {"our_false_numbers", peer.our_false},
          {"peer_false_numbers", peer.peer_false}};
}

Json LightJson(const accuracy::LightSummary& light) {
  Json json{{"recording", light.recording.empty() ? Json() : Json(light.recording)},
            {"pictures", light.pictures}};
  for (std::size_t i = 0; i < light.figures.size(); ++i) {
    const accuracy::LightFigure& figure = light.figures[i];
    json[accuracy::kImageMeasures[i].name] = {
        {"count", figure.count},
        {"mean", Number(figure.mean)},
        {"interval", figure.interval ? IntervalJson(*figure.interval) : Json()}};
  }
  return json;
}

Json UnreadJson(const UnreadFilm& unread) { return {{"film", unread.film}, {"peer", unread.peer}}; }

Json AmbiguityJson(const accuracy::AmbiguityBin& bin) {
  return {{"detector", bin.detector},
          {"low", Number(bin.low)},
          {"high", Number(bin.high)},
          {"count", bin.count},
          {"wrong", bin.wrong},
          {"flips", bin.flips},
          {"wrong_rate_interval", IntervalJson(bin.rate)}};
}

Json MapJson(const accuracy::ErrorMap& map) {
  Json json{{"detector", map.detector},
            {"columns", map.columns},
            {"rows", map.rows},
            {"corners", map.counts},
            {"median_px", Json::array()}};
  for (const double value : map.median_px) json["median_px"].push_back(Number(value));
  return json;
}

template <typename T, typename ToJson>
Json ListJson(const std::vector<T>& items, ToJson to_json) {
  Json list = Json::array();
  for (const T& item : items) list.push_back(to_json(item));
  return list;
}

}  // namespace

std::vector<UnreadFilm> UnreadFilms(const AccuracyReport& report) {
  std::vector<UnreadFilm> unread;
  const std::vector<accuracy::FilmSummary>& films = report.summary.films;
  const std::vector<std::string>& recordings = report.config.recordings;
  for (const accuracy::FilmSummary& film : films) {
    const bool is_ours = film.detector == report.summary.detectors[0];
    const bool is_recording =
        std::find(recordings.begin(), recordings.end(), film.film) != recordings.end();
    if (!is_ours || !is_recording) continue;
    for (const std::string& peer : report.config.peers) {
      if (std::none_of(films.begin(), films.end(), [&](const accuracy::FilmSummary& other) {
            return other.film == film.film && other.detector == peer;
          })) {
        unread.push_back({film.film, peer});
      }
    }
  }
  return unread;
}

std::string AccuracyJson(const AccuracyReport& report) {
  const accuracy::RunSummary& summary = report.summary;
  Json json;
  json["program"] = "pleinair";
  json["format"] = 1;
  json["version"] = report.version;
  json["command"] = CommandOf(report.config);
  json["config"] = Json::parse(ConfigJson(report.config));
  json["confidence"] = accuracy::kConfidence;
  json["skipped"] = report.skipped;
  json["detectors"] = summary.detectors;
  json["nominal_nees"] = ListJson(summary.nominal_nees, NeesJson);
  json["cells"] = ListJson(summary.cells, CellJson);
  json["jitter"] = ListJson(summary.jitter, JitterJson);
  json["films"] = ListJson(summary.films, FilmJson);
  json["ambiguity"] = ListJson(summary.ambiguity, AmbiguityJson);
  json["against"] = ListJson(summary.peers, PeerJson);
  json["without_print"] = ListJson(UnreadFilms(report), UnreadJson);
  json["light"] = ListJson(summary.light, LightJson);
  json["error_maps"] = ListJson(summary.maps, MapJson);
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pleinair::app
