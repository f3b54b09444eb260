#include "gl/shader_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace pleinair::gl {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr EmbeddedShader kShaders[] = {
    {"library_test/root.frag",
     "#version 450 core\n#include \"library_test/a.glsl\"\n#include \"library_test/b.glsl\"\n"
     "void main() {}\n"},
    {"library_test/a.glsl", "#include \"library_test/b.glsl\"\nfloat A() { return B(); }\n"},
    {"library_test/b.glsl", "float B() { return 1.0; }\n"},
    {"library_test/loop.frag", "#version 450 core\n#include \"library_test/loop.glsl\"\n"},
    {"library_test/loop.glsl", "#include \"library_test/loop.glsl\"\nint x;\n"},
    {"library_test/no_version.frag", "void main() {}\n"},
    {"library_test/lost.frag", "#version 450 core\n#include \"library_test/missing.glsl\"\n"},
};

class ShaderLibraryTest : public ::testing::Test {
 protected:
  void SetUp() override { ShaderLibrary::Register(kShaders); }
  void TearDown() override { ShaderLibrary::SetOverrideDirectory({}); }
};

TEST_F(ShaderLibraryTest, IncludesEachFileOnceAndKeepsLineNumbers) {
  const Result<ShaderSource> source = ShaderLibrary::Load("library_test/root.frag");
  ASSERT_TRUE(source.has_value()) << source.error().Message();
  EXPECT_EQ(source->text,
            "#version 450 core\n#line 2 0\n#line 1 1\n#line 1 2\nfloat B() { return 1.0; }\n"
            "#line 2 1\nfloat A() { return B(); }\n#line 3 0\n#line 4 0\nvoid main() {}\n");
  EXPECT_THAT(source->files,
              ElementsAre("library_test/root.frag", "library_test/a.glsl", "library_test/b.glsl"));
}

TEST_F(ShaderLibraryTest, PutsDefinesRightAfterTheVersion) {
  const std::string defines[] = {"SLICES 3", "GAUSSIAN"};
  const Result<ShaderSource> source = ShaderLibrary::Load("library_test/root.frag", defines);
  ASSERT_TRUE(source.has_value());
  EXPECT_TRUE(source->text.starts_with(
      "#version 450 core\n#define SLICES 3\n#define GAUSSIAN\n#line 2 0\n"));
}

TEST_F(ShaderLibraryTest, EndsOnFilesThatIncludeThemselves) {
  EXPECT_TRUE(ShaderLibrary::Load("library_test/loop.frag").has_value());
}

TEST_F(ShaderLibraryTest, NamesWhatIsMissing) {
  const Result<ShaderSource> lost = ShaderLibrary::Load("library_test/lost.frag");
  ASSERT_FALSE(lost.has_value());
  EXPECT_EQ(lost.error().where, "library_test/missing.glsl");
  const Result<ShaderSource> bare = ShaderLibrary::Load("library_test/no_version.frag");
  ASSERT_FALSE(bare.has_value());
  EXPECT_THAT(bare.error().what, HasSubstr("#version"));
}

TEST_F(ShaderLibraryTest, PrefersFilesOfTheOverrideDirectory) {
  const std::filesystem::path directory =
      std::filesystem::path(::testing::TempDir()) / "pleinair_shader_override";
  std::filesystem::create_directories(directory / "library_test");
  std::ofstream(directory / "library_test/b.glsl") << "float B() { return 2.0; }\n";
  ShaderLibrary::SetOverrideDirectory(directory);
  const Result<ShaderSource> source = ShaderLibrary::Load("library_test/root.frag");
  std::filesystem::remove_all(directory);
  ASSERT_TRUE(source.has_value());
  EXPECT_THAT(source->text, HasSubstr("return 2.0"));
  EXPECT_THAT(source->text, Not(HasSubstr("return 1.0")));
}

}  // namespace
}  // namespace pleinair::gl
