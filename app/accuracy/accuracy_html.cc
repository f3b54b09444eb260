#include "app/accuracy/accuracy_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "app/accuracy/film_plots.h"
#include "app/accuracy/light_section.h"
#include "app/accuracy/ratio_text.h"
#include "app/accuracy/worst_frames.h"
#include "export/plots/level_chart.h"
#include "export/plots/line_plot.h"
#include "export/plots/page_style.h"
#include "files/markup_escape.h"

namespace pleinair::app {
namespace {

using accuracy::CellSummary;
using accuracy::RunSummary;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string Figure(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "–";
}

double RateOf(const CellSummary& cell) {
  return cell.counts.markers > 0
             ? static_cast<double>(cell.counts.hits) / static_cast<double>(cell.counts.markers)
             : kNone;
}

std::string Card(const std::string& figure, const std::string& caption) {
  return fmt::format("<div class=\"card\"><b>{}</b><span>{}</span></div>\n",
                     files::EscapeMarkup(figure), files::EscapeMarkup(caption));
}

std::string MachinesText(const std::set<std::string>& machines) {
  std::string text = "Measured on";
  for (const std::string& machine : machines) {
    text += (machine == *machines.begin() ? " " : "; ") + files::EscapeMarkup(machine);
  }
  return text;
}

std::string Cards(const AccuracyReport& report) {
  std::string html = "<div class=\"cards\">\n";
  const RunSummary& summary = report.summary;
  std::int64_t frames = 0, hits = 0, markers = 0, false_numbers = 0, flips = 0;
  for (const CellSummary& cell : summary.cells) {
    if (cell.level || !cell.pattern.empty() || cell.detector != summary.detectors[0]) continue;
    frames += cell.counts.frames;
    hits += cell.counts.hits;
    markers += cell.counts.markers;
    false_numbers += cell.counts.false_numbers;
    flips += cell.counts.flips;
  }
  html += Card(fmt::format("{}", frames), "frames");
  html += Card(fmt::format("{} of {}", hits, markers), "markers hit, over all sweeps");
  html += Card(fmt::format("{}", false_numbers), "false numbers");
  html += Card(fmt::format("{}", flips), "poses flipped");
  if (!summary.nominal_nees.empty()) {
    const accuracy::NeesSummary& nees = summary.nominal_nees[0];
    html += Card(fmt::format("{:.2f}", nees.mean),
                 fmt::format("NEES on the distance sweep; consistent within {:.2f}…{:.2f}",
                             nees.band.low, nees.band.high));
  }
  return html + "</div>\n";
}

/// Meaning of the levels of a sweep.
std::string LevelName(const std::string& sweep, const std::string& pattern) {
  static const std::map<std::string, std::string> kNames{
      {"distance", "size, px (edge, seen frontally)"},
      {"angle", "tilt, degrees"},
      {"border", "border covered, %"},
      {"content", "content covered, %"},
      {"blur/defocus", "radius of the defocus disc, px"},
      {"blur/motion", "length of the streak, px"},
      {"noise/gain", "photons lost, times"},
      {"noise/dark", "exposure"},
      {"light/gradient", "ratio over the marker"},
      {"light/shadow", "ratio at the edge"},
      {"light/over", "exposure"},
      {"light/glare", "of the marker, %"},
      {"many", "markers in the frame"},
      {"jitter", "size, px"}};
  const auto with_pattern = kNames.find(sweep + "/" + pattern);
  if (with_pattern != kNames.end()) return with_pattern->second;
  const auto plain = kNames.find(sweep);
  return plain != kNames.end() ? plain->second : "level";
}

/// Detection and error by level of one pattern of a sweep, for all detectors.
std::string ChartsOf(const RunSummary& summary, const std::string& sweep,
                     const std::string& pattern) {
  std::vector<std::string> levels;
  std::vector<exports::LevelSeries> rates, errors;
  for (const std::string& detector : summary.detectors) {
    exports::LevelSeries rate{detector, {}, {}, {}}, error{detector, {}, {}, {}};
    std::vector<std::string> own_levels;
    for (const CellSummary& cell : summary.cells) {
      if (cell.detector != detector || cell.sweep != sweep || cell.pattern != pattern ||
          !cell.level) {
        continue;
      }
      own_levels.push_back(fmt::format("{}", *cell.level));
      rate.values.push_back(RateOf(cell));
      rate.low.push_back(cell.rates.hits.low);
      rate.high.push_back(cell.rates.hits.high);
      error.values.push_back(cell.corner_px.median);
    }
    if (own_levels.empty()) continue;
    levels = own_levels;
    rates.push_back(std::move(rate));
    errors.push_back(std::move(error));
  }
  if (levels.size() < 2) return {};
  const std::string title = pattern.empty() ? sweep : sweep + ", " + pattern;
  const std::string level_name = LevelName(sweep, pattern);
  return "<div class=\"charts\">" +
         exports::LevelChartSvg(title + ": rate of hits, 95 % intervals", level_name, levels, rates,
                                1.0) +
         exports::LevelChartSvg(title + ": median corner error, px", level_name, levels, errors,
                                0.0) +
         "</div>\n";
}

std::string CellTable(const RunSummary& summary, const std::string& sweep, bool by_level) {
  std::string html =
      "<table><tr><th>detector</th><th>pattern</th><th>level</th><th>markers</th><th>rate</th>"
      "<th>95 %</th><th>mis&shy;placed</th><th>false</th><th>flips</th><th>corner px, median</th>"
      "<th>95 %</th><th>outward px</th><th>rotation °, median</th><th>95 %</th>"
      "<th>translation %, median</th><th>95 %</th><th>NEES</th></tr>\n";
  for (const CellSummary& cell : summary.cells) {
    if (cell.sweep != sweep || cell.level.has_value() != by_level) continue;
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td><td>{}</td></tr>\n",
        cell.detector, cell.pattern, cell.level ? fmt::format("{}", *cell.level) : "",
        cell.counts.markers, Figure(RateOf(cell), 3),
        cell.counts.markers > 0
            ? fmt::format("{:.2f}–{:.2f}", cell.rates.hits.low, cell.rates.hits.high)
            : "–",
        cell.counts.misplaced, cell.counts.false_numbers, cell.counts.flips,
        Figure(cell.corner_px.median, 3), Figure(cell.corner_px.p95, 3),
        cell.counts.hits > 0 ? Figure(cell.bias_px.outward, 3) : "–",
        Figure(cell.rotation_deg.median, 3), Figure(cell.rotation_deg.p95, 2),
        Figure(100 * cell.translation_share.median, 3), Figure(100 * cell.translation_share.p95, 2),
        cell.nees ? fmt::format("{:.2f}{}", cell.nees->mean,
                                cell.nees->band.Contains(cell.nees->mean) ? "" : " !")
                  : "–");
  }
  return html + "</table>\n";
}

std::string SweepSections(const RunSummary& summary,
                          const std::vector<accuracy::FrameRecord>& records) {
  std::string html;
  for (const std::string& sweep : summary.sweeps) {
    html += "<h2>" + files::EscapeMarkup(sweep) + "</h2>\n";
    std::vector<std::string> patterns;
    for (const CellSummary& cell : summary.cells) {
      if (cell.sweep == sweep && cell.level &&
          std::find(patterns.begin(), patterns.end(), cell.pattern) == patterns.end()) {
        patterns.push_back(cell.pattern);
      }
    }
    for (const std::string& pattern : patterns) html += ChartsOf(summary, sweep, pattern);
    html += FilmPlots(sweep, summary.detectors, records);
    html += "<div class=\"wide\">" + CellTable(summary, sweep, false) +
            "<details><summary>by level</summary>" + CellTable(summary, sweep, true) +
            "</details></div>\n";
  }
  return html;
}

/// Axis maximum that includes 90 % of every detector's values: 1, 2 or 5 times a power of ten.
double TopOf(const std::vector<std::vector<double>>& values) {
  double top = 0.0;
  for (const std::vector<double>& sample : values) {
    if (!sample.empty()) top = std::max(top, accuracy::Percentile(sample, 0.9));
  }
  return top > 0.0 ? exports::TickStep(0.0, top, 1) : 1.0;
}

std::string Histograms(const RunSummary& summary,
                       const std::vector<accuracy::FrameRecord>& records) {
  std::vector<std::vector<double>> corners, rotations;
  for (const std::string& detector : summary.detectors) {
    std::vector<double>&corner = corners.emplace_back(), &rotation = rotations.emplace_back();
    for (const accuracy::FrameRecord& record : records) {
      if (record.detector != detector) continue;
      for (const accuracy::MarkerRecord& marker : record.markers) {
        if (!marker.pose) continue;
        corner.push_back(marker.CornerRms());
        rotation.push_back(marker.pose->rotation_error_deg);
      }
    }
  }
  return "<h2>Errors of all hits</h2>\n<div class=\"charts\">" +
         exports::HistogramSvg("Corner error (RMS of a marker)", "px", summary.detectors, corners,
                               TopOf(corners)) +
         exports::HistogramSvg("Rotation error", "°", summary.detectors, rotations,
                               TopOf(rotations)) +
         "</div>\n";
}

std::string Maps(const RunSummary& summary) {
  std::string html =
      "<h2>Where in the image</h2>\n<p class=\"lead\">Median error of corners by where they lie, "
      "px; full colour is four times the median of all cells.</p>\n<div class=\"charts\">";
  for (const accuracy::ErrorMap& map : summary.maps) {
    std::vector<double> seen;
    for (const double value : map.median_px) {
      if (std::isfinite(value)) seen.push_back(value);
    }
    const double full = seen.empty() ? 1.0 : 4.0 * accuracy::Percentile(seen, 0.5);
    html += exports::CellMapSvg(map.detector, map.columns, map.rows, map.median_px, full);
  }
  return html + "</div>\n";
}

std::string PeerTable(const AccuracyReport& report) {
  const RunSummary& summary = report.summary;
  std::string unread;
  for (const UnreadFilm& film : UnreadFilms(report)) {
    unread += fmt::format("<li>{}: {} cannot read its marker.</li>\n",
                          files::EscapeMarkup(film.film), film.peer);
  }
  if (!unread.empty()) unread = "<ul class=\"warnings\">\n" + unread + "</ul>\n";
  if (summary.peers.empty()) return unread.empty() ? "" : "<h2>Against others</h2>\n" + unread;
  std::string html =
      "<h2>Against others</h2>\n<p class=\"lead\">The same scenes, each detector with its own "
      "marker; in recordings all with the marker that is there. Ratios ours over theirs with 95 % "
      "bootstrap intervals (of errors: medians over the markers that both hit); p: McNemar's exact "
      "test.</p>\n<table><tr><th>sweep</th><th>peer</th><th>markers</th><th>both</th><th>only "
      "ours</th><th>only theirs</th><th>p</th><th>rate</th><th>corner error</th><th>rotation "
      "error</th><th>false, ours/theirs</th></tr>\n";
  for (const accuracy::PeerSummary& peer : summary.peers) {
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.2g}</td>"
        "<td>{}</td><td>{}</td><td>{}</td><td>{}/{}</td></tr>\n",
        files::EscapeMarkup(peer.film.empty() ? peer.sweep : peer.film), peer.peer,
        peer.hits.markers, peer.hits.both, peer.hits.only_ours, peer.hits.only_peer, peer.hits.p,
        RatioText(peer.rate.value, peer.rate.interval),
        RatioText(peer.corner.value, peer.corner.interval),
        RatioText(peer.rotation.value, peer.rotation.interval), peer.our_false, peer.peer_false);
  }
  return html + "</table>\n" + unread;
}

std::string JitterTable(const RunSummary& summary) {
  if (summary.jitter.empty()) return {};
  std::string html =
      "<h2>Jitter</h2>\n<p class=\"lead\">One scene, many draws of the noise.</p>\n<table><tr>"
      "<th>detector</th><th>tilt</th><th>size, px</th><th>hits</th><th>corner σ, px</th>"
      "<th>corner bias, px</th><th>translation σ, mm</th><th>rotation σ, °</th></tr>\n";
  for (const accuracy::JitterSummary& jitter : summary.jitter) {
    html += fmt::format(
        "<tr><td>{}</td><td>{}°</td><td>{}</td><td>{}</td><td>{:.4f}</td><td>{:.4f}</td>"
        "<td>{:.3f}</td><td>{:.4f}</td></tr>\n",
        jitter.detector, jitter.pattern.substr(1), jitter.level, jitter.frames,
        jitter.corner_std_px, jitter.corner_bias_px, jitter.translation_std_m * 1e3,
        jitter.rotation_std_deg);
  }
  return html + "</table>\n";
}

std::string FilmTable(const RunSummary& summary) {
  if (summary.films.empty()) return {};
  std::string html =
      "<h2>Films</h2>\n<p class=\"lead\">Absolute and relative trajectory errors as the TUM RGB-D "
      "benchmark defines them (Sturm et al. 2012); unaligned: in the marker's own frame. Lost: how "
      "often the marker was there and then not found; reported: the detector reported the "
      "loss.</p>\n<table><tr><th>film</th><th>detector</th><th>found</th><th>tracks</th><th>median "
      "length</th><th>longest</th><th>lost</th><th>of them reported</th><th>found "
      "again</th><th>longest gap</th><th>step jitter, px</th><th>ATE, mm</th><th>unaligned, "
      "mm</th><th>RPE, mm</th><th>RPE, °</th></tr>\n";
  for (const accuracy::FilmSummary& film : summary.films) {
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{} of {}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td></tr>\n",
        files::EscapeMarkup(film.film), film.detector, film.found, film.frames, film.tracks.count,
        Figure(film.median_track, 0), film.tracks.longest, film.losses.count,
        film.detector == summary.detectors[0] ? fmt::format("{}", film.losses.reported) : "–",
        film.losses.recovered, film.gaps.longest, Figure(film.step_jitter_px, 3),
        Figure(film.trajectory.ate_m * 1e3, 2),
        film.truth_aligned ? "–" : Figure(film.trajectory.ate_unaligned_m * 1e3, 2),
        Figure(film.trajectory.rpe_translation_m * 1e3, 2),
        Figure(film.trajectory.rpe_rotation_deg, 3));
  }
  return html + "</table>\n";
}

std::string AmbiguityTable(const RunSummary& summary) {
  std::string html =
      "<details><summary>as a table</summary><table><tr><th>detector</th><th>ratio</th>"
      "<th>poses</th><th>flips</th><th>wrong</th><th>share</th><th>95 %</th></tr>\n";
  for (const accuracy::AmbiguityBin& bin : summary.ambiguity) {
    if (bin.count == 0) continue;
    html += fmt::format(
        "<tr><td>{}</td><td>{:g}–{:g}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.4f}</td>"
        "<td>{:.4f}–{:.4f}</td></tr>\n",
        bin.detector, bin.low, bin.high, bin.count, bin.flips, bin.wrong,
        static_cast<double>(bin.wrong) / static_cast<double>(bin.count), bin.rate.low,
        bin.rate.high);
  }
  return html + "</table></details>\n";
}

std::string AmbiguityChart(const RunSummary& summary) {
  std::vector<std::string> levels;
  std::vector<exports::LevelSeries> series;
  for (const accuracy::AmbiguityBin& bin : summary.ambiguity) {
    if (series.empty() || series.back().name != bin.detector) {
      series.push_back({bin.detector, {}, {}, {}});
    }
    if (series.size() == 1) levels.push_back(fmt::format("{:g}–{:g}", bin.low, bin.high));
    series.back().values.push_back(
        bin.count > 0 ? static_cast<double>(bin.wrong) / static_cast<double>(bin.count) : kNone);
    series.back().low.push_back(bin.rate.low);
    series.back().high.push_back(bin.rate.high);
  }
  return "<h2>Ambiguity</h2>\n<p class=\"lead\">How often the other solution of the planar pose "
         "was the better one, by the likelihood ratio, which measures how ambiguous the pose is: "
         "below 0.001 it is certain.</p>\n"
         "<div class=\"charts\">" +
         exports::LevelChartSvg("Wrong solution chosen", "ambiguity ratio", levels, series, 0.6) +
         "</div>\n" + AmbiguityTable(summary);
}

}  // namespace

std::string AccuracyHtml(const AccuracyReport& report,
                         const std::vector<accuracy::FrameRecord>& records) {
  std::string html = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">";
  html += "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">";
  html +=
      "<title>pleinair accuracy</title><style>" + std::string(exports::kPageStyle) +
      ".charts{display:grid;grid-template-columns:repeat(auto-fill,minmax(20rem,1fr));gap:.8rem}"
      ".wide{overflow-x:auto}table{font-size:.82rem}th,td{padding:.25rem "
      ".4rem}td{white-space:nowrap}"
      ".thirds{display:grid;grid-template-columns:repeat(3,1fr);gap:.6rem}"
      ".light{width:100%;border-radius:8px}small{color:var(--soft)}"
      ".worst{position:relative}.worst img,.worst svg{width:100%;display:block}"
      ".worst svg{position:absolute;inset:0;height:100%}"
      "body{max-width:78rem}</style></head><body>\n<h1>pleinair accuracy</h1>\n";
  html += "<p class=\"lead\">pleinair " + files::EscapeMarkup(report.version) + ": <code>" +
          files::EscapeMarkup(CommandOf(report.config)) + " -o DIR</code></p>\n<p class=\"lead\">" +
          MachinesText(report.machines) +
          ". <a href=\"times.html\">Times of the stages</a>, which no two runs have alike, lie "
          "beside this page.</p>\n";
  if (!report.skipped.empty()) {
    html += "<h2>Skipped</h2>\n<ul class=\"warnings\">\n";
    for (const std::string& message : report.skipped) {
      html += "<li>" + files::EscapeMarkup(message) + "</li>\n";
    }
    html += "</ul>\n";
  }
  const RunSummary& summary = report.summary;
  if (records.empty()) {
    return html + LightSection(report) + "<p>No frame was measured.</p></body></html>\n";
  }
  html += Cards(report) + PeerTable(report) + SweepSections(summary, records) +
          JitterTable(summary) + FilmTable(summary) + Histograms(summary, records) + Maps(summary) +
          AmbiguityChart(summary) + LightSection(report) + WorstFrames(report, records);
  return html + "</body></html>\n";
}

}  // namespace pleinair::app
