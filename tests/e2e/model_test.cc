// `pleinair model`: what it says of files, its sheets, and what it refuses.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>

#include "tests/e2e/command_output.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"
#include "tests/source_tree.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A pyramid on y = 0, in millimetres.
constexpr const char* kPyramid =
    "v -500 0 -500\nv 500 0 -500\nv 500 0 500\nv -500 0 500\nv 0 1200 0\n"
    "f 1 2 3 4\nf 5 2 1\nf 5 3 2\nf 5 4 3\nf 5 1 4\n";

TEST(ModelCommand, HasAHelpWhoseExamplesRunAsTheyStand) {
  std::istringstream help(RunPleinair({"model", "--help"}).out);
  int examples = 0;
  for (std::string line; std::getline(help, line);) {
    const std::string program = "  pleinair ";
    if (!line.starts_with(program)) continue;
    ++examples;
    const TemporaryFolder folder;
    WriteFile(folder / "chair.obj", kPyramid);
    fs::copy_file(tests::SourceTree() / "tests/fuzz/corpus/gltf/triangle.glb",
                  folder / "sculpture.glb");
    const RunResult run =
        RunCommandLine({"sh", "-c",
                        "cd '" + std::string(folder.path()) + "' && " + PleinairProgram() + " " +
                            line.substr(program.size())});
    EXPECT_EQ(run.exit_code, 0) << line << "\n" << run.err;
    EXPECT_FALSE(run.out.empty()) << line;
  }
  EXPECT_GE(examples, 4);
}

TEST(ModelCommand, SaysHowLargeTheModelIsAndWhatIsProbablyMeantOtherwise) {
  const TemporaryFolder folder;
  WriteFile(folder / "chair.obj", kPyramid);
  const RunResult plain = RunPleinair({"model", folder / "chair.obj"});
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_THAT(plain.out, AllOf(HasSubstr("1 km x 1.2 km x 1 km"), HasSubstr("unit = \"mm\""),
                               HasSubstr("up = \"y\""), HasSubstr("not drawn  nothing")));
  const auto json = RunJson(
      {"model", folder / "chair.obj", "--up", "y", "--unit", "mm", "-o", folder / "sheet.png"});
  EXPECT_NEAR(json["size_m"][2].get<double>(), 1.2, 1e-6);
  EXPECT_TRUE(json["notes"].empty());
  EXPECT_EQ(json["triangles"], 6);
  const cv::Mat sheet = cv::imread(folder / "sheet.png");
  EXPECT_EQ(sheet.size(), cv::Size(1280, 960));
}

TEST(ModelCommand, RefusesBadModelsInOneLine) {
  const auto refuse = [](const std::string& content, const std::string& name,
                         const std::string& message) {
    const TemporaryFolder folder;
    WriteFile(folder / name, content);
    ExpectRefused(RunPleinair({"model", folder / name, "-o", folder / "sheet.png"}), message);
    EXPECT_FALSE(fs::exists(folder / "sheet.png")) << name;
  };
  refuse("v 0 0 nan\n", "a.obj", "a.obj:1");
  refuse("v 0 0 1e11\n", "a.obj", "a.obj:1");
  refuse("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "a.obj", "degenerate");
  refuse("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 4\n", "a.obj", "vertex 4 of 3");
  refuse(
      "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"children\":"
      "[0]}]}",
      "a.gltf", "contains itself");
  refuse("mtllib ../none.mtl\n", "a.obj",
         "lies outside the folder of the model that names it; put it beside the model, remove");
  refuse("ply\nformat ascii 1.0\n", "a.ply", "is a PLY model, which is not read");
  ExpectRefused(RunPleinair({"model", "a.obj", "b.obj", "-o", "one.png"}), "name a folder");
  ExpectRefused(RunPleinair({"model", "a.obj", "-o", "one.jpg"}), "PNG");
  ExpectRefused(RunPleinair({"model", "a.obj", "--unit", "yd"}), "--unit");
}

TEST(ModelCommand, ReadsOutsideTheModelsFolderWhereAllowed) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "inner");
  WriteFile(folder / "a.mtl", "newmtl a\nKd 0.5\n");
  WriteFile(folder / "inner/a.obj",
            "mtllib ../a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  ExpectRefused(RunPleinair({"model", folder / "inner/a.obj"}),
                "trust the model with --allow-outside");
  EXPECT_EQ(RunPleinair({"model", folder / "inner/a.obj", "--allow-outside"}).exit_code, 0);
}

TEST(ModelCommand, ReadsTenThousandMaterials) {
  const TemporaryFolder folder;
  std::string materials, faces = "mtllib many.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 10'000; ++i) {
    const std::string name = "m" + std::to_string(i);
    materials += "newmtl " + name + "\nKd 0.5\n";
    faces += "usemtl " + name + "\nf 1 2 3\n";
  }
  WriteFile(folder / "many.mtl", materials);
  WriteFile(folder / "many.obj", faces);
  const auto json = RunJson({"model", folder / "many.obj"});
  EXPECT_EQ(json["materials"].size(), 10'000U);
}

}  // namespace
}  // namespace pleinair::e2e
