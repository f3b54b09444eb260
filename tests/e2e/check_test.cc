#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Verdict of each subject.
std::map<std::string, std::string> Verdicts(const std::string& lines) {
  std::map<std::string, std::string> verdicts;
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);) {
    const auto json = nlohmann::json::parse(line);
    verdicts[json["subject"]] = json["verdict"];
  }
  return verdicts;
}

/// Replaces a text of a project's scene.
void Edit(const TemporaryFolder& folder, const std::string& from, const std::string& to) {
  std::string scene = ReadFile(folder / "site/scene.toml");
  ASSERT_NE(scene.find(from), std::string::npos);
  scene.replace(scene.find(from), from.size(), to);
  WriteFile(folder / "site/scene.toml", scene);
}

TEST(Check, FindsTheBundledPlaceUsable) {
  const RunResult run = RunPleinair({"check", BundledRecording(), "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const auto& [subject, verdict] : Verdicts(run.out)) EXPECT_EQ(verdict, "good") << subject;
  EXPECT_EQ(Verdicts(run.out).size(), 10U);
}

TEST(Check, SaysWhatIsWrongAndExitsWithOne) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 3, true);
  Edit(folder, "T11:05:00Z", "T23:05:00Z");
  Edit(folder, "heading_deg = 342", "heading_deg = 342\nid = 17");
  const RunResult night = RunPleinair({"check", folder / "site"});
  EXPECT_EQ(night.exit_code, 1);
  EXPECT_THAT(night.out, HasSubstr("sun: bad: "));
  EXPECT_THAT(night.out, HasSubstr("\n    check the time with its offset"));
  EXPECT_THAT(night.err, HasSubstr("sun"));
  EXPECT_EQ(std::count(night.err.begin(), night.err.end(), '\n'), 1) << night.err;
  Edit(folder, "id = 17", "id = 18");
  const RunResult unseen = RunPleinair({"check", folder / "site", "--json"});
  EXPECT_EQ(unseen.exit_code, 1);
  EXPECT_EQ(Verdicts(unseen.out)["marker"], "bad");
}

TEST(Check, ContradictsADescribedSkyThatTheShadowsDeny) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 3, true);
  Edit(folder, "cloudiness = \"clear\"", "cloudiness = \"overcast\"");
  const RunResult run = RunPleinair({"check", folder / "site"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("sky: doubtful: the phantoms' shadows are visible"));
}

TEST(Check, NamesTheTimeThatFitsWhereItIsWrongByAnHour) {
  for (const std::string wrong : {"T12:05:00Z", "T10:05:00Z", "T13:05:00Z"}) {
    const TemporaryFolder folder;
    MakeShortRecording(folder / "site", 3, true);
    Edit(folder, "T11:05:00Z", wrong);
    const std::string out = RunPleinair({"check", folder / "site"}).out;
    EXPECT_THAT(out, HasSubstr("heading: doubtful: the shadows fit a sun elsewhere")) << wrong;
    EXPECT_THAT(out, HasSubstr("the time 2025-09-14T11:05Z at this heading fits")) << wrong;
  }
}

TEST(Check, SaysWhyNoShadowGivesTheHeading) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 3, true);
  std::string scene = ReadFile(folder / "site/scene.toml");
  const std::size_t phantom = scene.find("[[phantom]]");
  ASSERT_NE(phantom, std::string::npos);
  const std::size_t next = scene.find("[[", phantom + 2);
  scene.erase(phantom, next == std::string::npos ? next : next - phantom);
  WriteFile(folder / "site/scene.toml", scene);
  EXPECT_THAT(RunPleinair({"check", folder / "site"}).out,
              HasSubstr("heading: not checked: nothing is described that casts a shadow"));
  WriteFile(folder / "site/scene.toml",
            scene + "\n[ground]\n[[box]]\nfrom_m = [0.9, 0.9, 0.0]\nto_m = [0.95, 0.95, 0.03]\n");
  const std::string low = RunPleinair({"check", folder / "site"}).out;
  EXPECT_THAT(low, HasSubstr("heading: not checked: "));
  EXPECT_THAT(low, Not(HasSubstr("nothing is described")));
}

TEST(Check, WhatItCannotReadIsRefused) {
  const TemporaryFolder folder;
  ExpectRefused(RunPleinair({"check", folder / "none"}), "none");
  MakeShortRecording(folder / "site", 2, true);
  WriteFile(folder / "site/scene.toml", "place = 3\n");
  ExpectRefused(RunPleinair({"check", folder / "site"}), "scene.toml");
}

}  // namespace
}  // namespace pleinair::e2e
