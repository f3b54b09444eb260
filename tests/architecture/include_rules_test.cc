#include "tests/architecture/include_rules.h"
#include "tests/source_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace pleinair::architecture {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(IncludeRules, HoldInTheWholeSourceTree) {
  EXPECT_GT(FindSources(tests::SourceTree()).size(), 60U);
  EXPECT_THAT(FindBreachesBelow(tests::SourceTree()), IsEmpty());
}

TEST(IncludeRules, CatchAnIncludeAgainstTheOrderOfModules) {
  EXPECT_THAT(FindBreaches("tracker/pose.cc", "\n#include \"gl/texture.h\"\n"),
              ElementsAre("tracker/pose.cc:2: includes gl/texture.h: tracker may not know gl"));
  EXPECT_THAT(FindBreaches("sky/sun.cc", "#include \"devices/frame.h\""),
              ElementsAre(HasSubstr("sky may not know devices")));
  EXPECT_THAT(FindBreaches("base/image.h", "#include \"session/marker_tracks.h\""),
              ElementsAre(HasSubstr("base may not know session")));
  EXPECT_THAT(FindBreaches("shadows/shaders/a.frag", "#include \"compositor/shaders/b.glsl\""),
              ElementsAre(HasSubstr("shadows may not know compositor")));
}

TEST(IncludeRules, CatchAnIncludeAgainstTheOrderOfFoldersInCompositor) {
  EXPECT_THAT(
      FindBreaches("compositor/models/model.cc", "#include \"compositor/light/lit_mesh.h\""),
      ElementsAre(HasSubstr("from the ground up")));
  EXPECT_THAT(FindBreaches("compositor/passes/a.cc", "#include \"compositor/composer.h\""),
              ElementsAre(HasSubstr("from the ground up")));
  EXPECT_THAT(FindBreaches("compositor/photometry/marker/a.cc",
                           "#include \"compositor/surfaces/scene_surfaces.h\""),
              ElementsAre(HasSubstr("from the ground up")));
  EXPECT_THAT(FindBreaches("compositor/composer.cc", "#include \"compositor/passes/a.h\""),
              IsEmpty());
  EXPECT_THAT(FindBreaches("compositor/passes/a.cc",
                           "#include \"compositor/composer_options.h\"\n"
                           "#include \"compositor/surfaces/b.h\"\n"),
              IsEmpty());
}

TEST(IncludeRules, LeaveNoLoopOfMoreThanFourUnits) {
  for (const auto& loop : FindLoops(ReadUnitIncludes(tests::SourceTree()))) {
    EXPECT_LE(loop.size(), 4U) << ::testing::PrintToString(loop);
  }
}

TEST(IncludeRules, LeaveNoFolderOfMoreThanThirtyUnits) {
  std::map<std::filesystem::path, std::size_t> units;
  for (const auto& [unit, includes] : ReadUnitIncludes(tests::SourceTree())) {
    ++units[std::filesystem::path(unit).parent_path()];
  }
  EXPECT_GT(units.size(), 30U);
  for (const auto& [folder, count] : units) EXPECT_LE(count, 30U) << folder;
}

TEST(FindLoops, GivesEachLoopOnceAndNoChain) {
  const UnitIncludes includes = {{"a", {"b"}}, {"b", {"c"}}, {"c", {"a", "d"}}, {"d", {"e"}},
                                 {"e", {"d"}}, {"f", {"a"}}, {"g", {}}};
  EXPECT_THAT(FindLoops(includes),
              ::testing::UnorderedElementsAre(ElementsAre("a", "b", "c"), ElementsAre("d", "e")));
}

TEST(PublicFace, ReachesNoLibraryThatStaysInside) {
  const std::vector<std::string> headers =
      HeadersReached(tests::SourceTree(), "pleinair/pleinair.h");
  EXPECT_THAT(headers, ::testing::Contains("session/pipeline.h"));
  for (const std::string& header : headers) {
    std::ifstream in(tests::SourceTree() / header);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    for (const Include& include : ParseIncludes(text)) {
      for (const char* library :
           {"glm/", "epoxy/", "GL/", "EGL/", "opencv2/", "Eigen/", "ceres/"}) {
        EXPECT_FALSE(include.path.starts_with(library)) << header << " includes " << include.path;
      }
    }
  }
}

TEST(IncludeRules, CatchOpenCvWhereABareMachineMustBuild) {
  EXPECT_THAT(FindBreaches("compositor/models/model.cc", "#include <opencv2/core.hpp>"),
              ElementsAre(HasSubstr("compositor may not know OpenCV")));
}

TEST(IncludeRules, CatchOpenGlInTheTracker) {
  EXPECT_THAT(FindBreaches("tracker/pose.cc", "  #  include <epoxy/gl.h>"),
              ElementsAre(HasSubstr("tracker may not know OpenGL")));
  // Only app/window draws; the rest of app leaves that to compositor.
  EXPECT_THAT(FindBreaches("session/marker_tracks.cc", "#include <epoxy/gl.h>"),
              ElementsAre(HasSubstr("session may not know OpenGL")));
  EXPECT_THAT(FindBreaches("app/window/live_window.cc", "#include <GLFW/glfw3.h>"), IsEmpty());
}

TEST(IncludeRules, CatchALibrarysTypesInAPublicHeader) {
  EXPECT_THAT(FindBreaches("tracker/pose.h", "#include <Eigen/Core>"),
              ElementsAre(HasSubstr("public headers may not show Eigen")));
  EXPECT_THAT(FindBreaches("tracker/pose.cc", "#include <Eigen/Core>"), IsEmpty());
  EXPECT_THAT(
      FindBreaches("tracker/pose.h", "// Internal: between .cc files.\n#include <Eigen/Core>"),
      IsEmpty());
}

TEST(IncludeRules, CatchPathsThatClimb) {
  EXPECT_THAT(FindBreaches("sky/sun.cc", "#include \"../sky/sun.h\""),
              ElementsAre(HasSubstr("from the root")));
}

TEST(IncludeRules, CatchAFileOutsideTheModules) {
  EXPECT_THAT(FindBreaches("misc/tool.cc", ""), ElementsAre(HasSubstr("is in no module")));
}

TEST(IncludeRules, AllowWhatTheOrderAllows) {
  EXPECT_THAT(FindBreaches("compositor/light.cc",
                           "#include <vector>\n#include \"base/image.h\"\n#include \"sky/a.h\"\n"
                           "#include \"shadows/b.h\"\n#include \"compositor/c.h\"\n"),
              IsEmpty());
}

TEST(IncludeRules, IgnoreIncludesInComments) {
  EXPECT_THAT(FindBreaches("sky/sun.cc", "// #include \"app/a.h\"\n/*\n#include \"app/b.h\"\n*/"),
              IsEmpty());
}

TEST(ParseIncludes, GivesLinesAndPathsOfBothForms) {
  const auto includes =
      ParseIncludes("/* one\n two */\n#include <vector>\n#  include \"base/a.h\"");
  ASSERT_EQ(includes.size(), 2U);
  EXPECT_EQ(includes[0].line, 3);
  EXPECT_EQ(includes[0].path, "vector");
  EXPECT_EQ(includes[1].line, 4);
  EXPECT_EQ(includes[1].path, "base/a.h");
}

}  // namespace
}  // namespace pleinair::architecture
