// Values changed in the text of a user's file, with everything else kept.

#include "scene/toml_text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace pleinair::scene {
namespace {

std::string Changed(const std::string& text, const std::vector<TomlChange>& changes) {
  const auto changed = ChangeToml(text, "scene.toml", changes);
  return changed ? *changed : "error: " + changed.error().Message();
}

TEST(TomlText, ChangesOneValueAndKeepsEveryOtherByte) {
  const std::string before = R"(# The yard. x = [1]
time = 2025-09-14 13:05:00+02:00  # noon, nearly

[place]   # by the well
latitude_deg = 50.08_75
longitude_deg =	14.42

[[object]] # a chair
file = "a # [b] = 'c'.glb"   # not a comment before here
translation_m = [
  0.5,   # east
  1,     # north
  0.0,
]

[[object]]
"file" = '''
lamp\.glb'''
scale = 2  )";
  std::string after = before;
  after.replace(after.find("1,     # north"), 1, "1.25");
  after.replace(after.find("scale = 2 ") + 8, 1, "3.0");
  EXPECT_EQ(Changed(before, {{"object", 0, "translation_m", "[0.50001, 1.25, 0.0]", 1e-4},
                             {"object", 1, "scale", "3.0"},
                             {"place", 0, "latitude_deg", "50.0875", 1e-7}}),
            after);
}

TEST(TomlText, AddsAMissingKeyAtTheEndOfItsTable) {
  EXPECT_EQ(Changed("# top\n\n[[object]]\nfile = 'a'  # a\n\n# lamp\n[[object]]\nfile = 'b'",
                    {{"object", 0, "scale", "2.0"},
                     {"object", 1, "scale", "3.0"},
                     {"", 0, "turbidity", "4.0"}}),
            "turbidity = 4.0\n# top\n\n[[object]]\nfile = 'a'  # a\nscale = 2.0\n\n# lamp\n"
            "[[object]]\nfile = 'b'\nscale = 3.0\n");
  EXPECT_EQ(Changed("a = 1\r\n[marker]\r\n[x]\r\n", {{"marker", 0, "heading_deg", "5.0"}}),
            "a = 1\r\n[marker]\r\nheading_deg = 5.0\r\n[x]\r\n");
}

TEST(TomlText, AddsAMissingTableAtTheEnd) {
  EXPECT_EQ(
      Changed("a = 1", {{"place", 0, "latitude_deg", "5.0"}, {"place", 0, "longitude_deg", "6.0"}}),
      "a = 1\n[place]\nlatitude_deg = 5.0\nlongitude_deg = 6.0\n");
  EXPECT_NE(Changed("a = 1", {{"object", 1, "scale", "5.0"}}).find("has no object 2"),
            std::string::npos);
}

TEST(TomlText, FindsInlineAndDottedTables) {
  EXPECT_EQ(Changed("object = [ {file = 'a'}, # first\n {file = 'b', scale = 2} ]\n"
                    "place.latitude_deg = 1\nground = true\nmarker = {}\n",
                    {{"object", 0, "scale", "4.0"},
                     {"object", 1, "scale", "3.0"},
                     {"place", 0, "latitude_deg", "7.0"},
                     {"place", 0, "longitude_deg", "8.0"},
                     {"ground", 0, "height_m", "1.5"},
                     {"marker", 0, "heading_deg", "9.0"}}),
            "object = [ {file = 'a', scale = 4.0}, # first\n {file = 'b', scale = 3.0} ]\n"
            "place.latitude_deg = 7.0\nground = { height_m = 1.5 }\n"
            "marker = { heading_deg = 9.0 }\nplace.longitude_deg = 8.0\n");
}

TEST(TomlText, PutsAKeyInThePlaceOfAnother) {
  EXPECT_EQ(Changed("[marker]\nheading_magnetic_deg  = 338  # compass\nid = 3\n",
                    {{"marker", 0, "heading_deg", "12.5", 0.0, "heading_magnetic_deg"}}),
            "[marker]\nheading_deg  = 12.5  # compass\nid = 3\n");
}

TEST(TomlText, TextThatIsNotTomlIsAnErrorWithItsLine) {
  EXPECT_EQ(Changed("a = 1\nb = [1,\n", {{"", 0, "a", "2"}}).substr(0, 19), "error: scene.toml:2");
  // A change that would leave no TOML is refused as a whole.
  EXPECT_EQ(Changed("object = 3\n", {{"", 0, "b", "1 2"}}).substr(0, 18), "error: scene.toml:");
}

TEST(TomlText, TextCutAtAnyByteEndsWithoutHarm) {
  const std::string whole =
      "\xEF\xBB\xBF"
      "a.\"b\" = '''x''''\n[[c]]\nd = { e = [[1, 2], [3]], f = \"\"\"q\\\"\"\"\"\" }\n";
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    const auto changed = ChangeToml(whole.substr(0, length), "f", {{"c", 0, "g", "1"}});
    EXPECT_TRUE(!changed || changed->find("g = 1") != std::string::npos) << length;
  }
}

}  // namespace
}  // namespace pleinair::scene
