// `pleinair bench shadows` from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "refusal.h"
#include "run_program.h"

namespace pleinair::e2e {
namespace {

using nlohmann::json;
using ::testing::Contains;

TEST(BenchShadows, MeasuresAllMethodsAndOursIsTheBest) {
  const TemporaryFolder folder;
  const RunResult run = RunPleinair({"bench", "shadows", "--quick", "--scenes", "pole_and_box",
                                     "--json", "-o", (folder / "out").string()});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::map<std::string, json> rows;
  std::istringstream lines(run.out);
  for (std::string line; std::getline(lines, line);) {
    const json row = json::parse(line);
    rows[row.at("method")] = row;
  }
  ASSERT_EQ(rows.size(), 16U);
  const json& ours = rows.at("ours");
  for (const char* rival : {"plain", "pcf3", "pcf5", "pcf7", "csm-pcf5", "vsm", "vsm-reduced",
                            "csm-vsm", "evsm", "pcss", "zgaf"}) {
    EXPECT_LT(ours.at("rmse"), rows.at(rival).at("rmse")) << rival;
    EXPECT_LT(ours.at("penumbra_rmse"), rows.at(rival).at("penumbra_rmse")) << rival;
  }
  for (const char* leaky : {"pcf3", "pcf5", "pcf7", "csm-pcf5", "vsm", "evsm"}) {
    EXPECT_LT(ours.at("leak_mean"), rows.at(leaky).at("leak_mean")) << leaky;
  }
  for (const char* key : {"bias", "leak_p99", "over_darkening", "penumbra_width_slope", "shimmer",
                          "truth_shimmer", "contact_gap_px", "ms", "ratio_to_plain"}) {
    EXPECT_TRUE(ours.contains(key)) << key;
  }
  EXPECT_EQ(ours.at("edges").size(), 4U);
  const std::vector<std::string> files = Listing(folder / "out");
  for (const char* file :
       {"pole_and_box.jpg", "pole_and_box_methods.jpg", "shadows.jsonl",
        "pole_and_box_error_over_time.svg", "pole_and_box_ours_partitions.jpg"}) {
    EXPECT_THAT(files, Contains(file));
  }
}

TEST(BenchShadows, RefusesWhatItDoesNotKnow) {
  ExpectRefused(RunPleinair({"bench", "shadows", "--quick", "--methods", "raytracing"}),
                "no method 'raytracing'");
  ExpectRefused(RunPleinair({"bench", "shadows", "--quick", "--scenes", "courtyard", "--recording",
                             "/no/such/folder"}),
                "/no/such/folder");
}

}  // namespace
}  // namespace pleinair::e2e
