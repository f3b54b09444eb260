#include "app/accuracy/run_times.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "export/plots/page_style.h"
#include "files/markup_escape.h"

namespace pleinair::app {

std::vector<DetectorTimes> TimesOf(const std::vector<accuracy::FrameRecord>& records) {
  std::map<std::string, StageTimes> by_detector;
  for (const accuracy::FrameRecord& record : records) {
    for (const auto& [stage, ms] : record.stages_ms) by_detector[record.detector].Add(stage, ms);
  }
  std::vector<DetectorTimes> times;
  times.reserve(by_detector.size());
  for (const auto& [detector, stages] : by_detector) {
    times.push_back({detector, stages.Summarize()});
  }
  return times;
}

std::string TimesJson(const std::set<std::string>& machines,
                      const std::vector<DetectorTimes>& times) {
  using Json = nlohmann::ordered_json;
  Json json{{"machines", machines}, {"stages", Json::array()}};
  for (const DetectorTimes& one : times) {
    for (const StageTimes::Summary& stage : one.stages) {
      json["stages"].push_back({{"detector", one.detector},
                                {"stage", stage.stage},
                                {"frames", stage.runs},
                                {"median_ms", stage.median_ms},
                                {"p95_ms", stage.p95_ms}});
    }
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string TimesHtml(const std::set<std::string>& machines,
                      const std::vector<DetectorTimes>& times) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
      "<title>pleinair accuracy: times</title><style>" +
      std::string(exports::kPageStyle) +
      "</style></head><body>\n<h1>Time per stage</h1>\n<p class=\"lead\">One thread a detector, on";
  for (const std::string& machine : machines) html += " " + files::EscapeMarkup(machine) + ";";
  html +=
      " <a href=\"report.html\">to the report</a></p>\n<table><tr><th>detector</th><th>stage</th>"
      "<th>frames</th><th>median, ms</th><th>95 %, ms</th></tr>\n";
  for (const DetectorTimes& one : times) {
    for (const StageTimes::Summary& stage : one.stages) {
      html +=
          fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{:.2f}</td><td>{:.2f}</td></tr>\n",
                      files::EscapeMarkup(one.detector), files::EscapeMarkup(stage.stage),
                      stage.runs, stage.median_ms, stage.p95_ms);
    }
  }
  return html + "</table></body></html>\n";
}

}  // namespace pleinair::app
