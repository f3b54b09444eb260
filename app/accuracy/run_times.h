#pragma once

#include <set>
#include <string>
#include <vector>

#include "accuracy/frame_record.h"
#include "base/stage_times.h"

namespace pleinair::app {

/// What the stages of one detector took.
struct DetectorTimes {
  std::string detector;
  std::vector<StageTimes::Summary> stages;
};

/// By detector, in the order of names.
std::vector<DetectorTimes> TimesOf(const std::vector<accuracy::FrameRecord>& records);

/// times.json and times.html: kept apart from the report, since no two runs have the same.
std::string TimesJson(const std::set<std::string>& machines,
                      const std::vector<DetectorTimes>& times);
std::string TimesHtml(const std::set<std::string>& machines,
                      const std::vector<DetectorTimes>& times);

}  // namespace pleinair::app
