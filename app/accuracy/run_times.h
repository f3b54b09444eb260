#pragma once

#include <set>
#include <string>
#include <vector>

#include "accuracy/frame_record.h"
#include "base/stage_times.h"

namespace pleinair::app {

/// Durations of the stages of one detector.
struct DetectorTimes {
  std::string detector;
  std::vector<StageTimes::Summary> stages;
};

/// One entry per detector, sorted by name.
std::vector<DetectorTimes> TimesOf(const std::vector<accuracy::FrameRecord>& records);

/// times.json and times.html. They are separate from the report, since they differ between runs.
std::string TimesJson(const std::set<std::string>& machines,
                      const std::vector<DetectorTimes>& times);
std::string TimesHtml(const std::set<std::string>& machines,
                      const std::vector<DetectorTimes>& times);

}  // namespace pleinair::app
