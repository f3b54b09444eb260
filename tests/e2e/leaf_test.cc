// Tests `pleinair leaf` as a process: its output and its errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "tests/e2e/command_output.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

using nlohmann::json;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pointwise;

// Miao et al. 2016, Table 1.
TEST(Leaf, PrintsTheTableOfThePaper) {
  const TemporaryFolder folder;
  WriteFile(folder / "in.csv",
            "carotenoids_ug_cm2,chlorophyll_ug_cm2,name,model\n"
            "10.6,31.7,one,plate\n7.27,59.2,two,plate\n9.10,0,\"three, white\",plate\n"
            "3.17,11.62,four,plate\n");
  const RunResult run = RunPleinair({"leaf", "--csv", folder / "in.csv"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<std::string> lines = Lines(run.out);
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0],
            "name,model,reflectance_r,reflectance_g,reflectance_b,transmittance_r,"
            "transmittance_g,transmittance_b");
  const std::vector<std::vector<double>> expected = {{.0437, .1252, .0436, .0632, .2875, .0095},
                                                     {.0382, .0788, .0435, .0159, .1990, .0031},
                                                     {.3933, .3041, .0540, .6067, .5378, .0808},
                                                     {.0940, .2329, .0578, .2034, .4464, .0942}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::string& line = lines[i + 1];
    const std::string numbers = line.substr(line.find(",plate,") + 7);
    EXPECT_THAT(Numbers(numbers), Pointwise(DoubleNear(0.0005), expected[i])) << line;
  }
  EXPECT_THAT(lines[3], HasSubstr("\"three, white\",plate,"));
}

TEST(Leaf, WritesSpectraAndAPicture) {
  const TemporaryFolder folder;
  const json leaf =
      RunJson({"leaf", "--chlorophyll", "45", "--carotenoids", "9", "--dry", "0.005", "--spectra",
               folder / "spectra.csv", "--nm", "540..550", "-o", folder / "leaf.png"});
  EXPECT_EQ(leaf.at("model"), "prospect-d");
  const auto reflectance = leaf.at("reflectance_rgb").get<std::vector<double>>();
  ASSERT_EQ(reflectance.size(), 3U);
  EXPECT_GT(reflectance[1], reflectance[0]);  // Green.
  EXPECT_GT(reflectance[1], reflectance[2]);
  const std::vector<std::string> lines = Lines(ReadFile(folder / "spectra.csv"));
  ASSERT_EQ(lines.size(), 12U);
  EXPECT_EQ(lines[0], "name,wavelength_nm,reflectance,transmittance");
  EXPECT_THAT(lines[1], HasSubstr("leaf,540,0."));
  const cv::Mat picture = cv::imread(folder / "leaf.png");
  ASSERT_FALSE(picture.empty());
  EXPECT_EQ(picture.at<cv::Vec3b>(2, 2), cv::Vec3b(255, 255, 255));
  for (const int x : {picture.cols / 4, 3 * picture.cols / 4}) {  // Both sides are green.
    const cv::Vec3b side = picture.at<cv::Vec3b>(picture.rows / 2, x);
    EXPECT_GT(side[1], side[0]);
    EXPECT_GT(side[1], side[2]);
  }
}

TEST(Leaf, FitsTheSpectrumThatItWrote) {
  const TemporaryFolder folder;
  RunJson({"leaf", "--chlorophyll", "33", "--carotenoids", "8", "--water", "0.013", "--dry",
           "0.006", "--structure", "1.7", "--spectra", folder / "leaf.csv"});
  // The measured table has no names.
  std::string measured;
  for (const std::string& line : Lines(ReadFile(folder / "leaf.csv"))) {
    measured += line.substr(line.find(',') + 1) + "\n";
  }
  WriteFile(folder / "measured.csv", measured);
  const json fit = RunJson({"leaf", "fit", folder / "measured.csv"});
  EXPECT_NEAR(fit.at("chlorophyll_ug_cm2").get<double>(), 33.0, 0.02);
  EXPECT_NEAR(fit.at("structure").get<double>(), 1.7, 0.001);
  EXPECT_LT(fit.at("standard_deviation").at("chlorophyll_ug_cm2").get<double>(), 0.02);
  EXPECT_LT(fit.at("rms").get<double>(), 1e-5);
  EXPECT_THAT(RunPleinair({"leaf", "fit", folder / "measured.csv"}).out,
              HasSubstr("chlorophyll_ug_cm2   33 ± "));
}

TEST(Leaf, MakesMapsOfAStructureImage) {
  const TemporaryFolder folder;
  cv::Mat structure(8, 16, CV_8UC3, cv::Scalar(255, 0, 0));  // Mesophyll is blue.
  structure.rowRange(3, 5).setTo(cv::Scalar(0, 0, 255));     // The main vein is red.
  cv::imwrite(folder / "structure.png", structure);
  const RunResult run =
      RunPleinair({"leaf", "maps", folder / "structure.png", "-o", folder / "maps"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(Listing(folder / "maps"), ElementsAre("gloss.png", "pigment.png", "thickness.png"));
  const cv::Mat thickness = cv::imread(folder / "maps" / "thickness.png", cv::IMREAD_GRAYSCALE);
  EXPECT_EQ(thickness.at<std::uint8_t>(0, 0), 128);
  EXPECT_GT(thickness.at<std::uint8_t>(4, 0), 128);
}

class LeafRefusal : public ::testing::TestWithParam<Refusal> {};
TEST_P(LeafRefusal, IsOneLine) { ExpectRefusal("leaf", GetParam()); }
INSTANTIATE_TEST_SUITE_P(
    BadInput, LeafRefusal,
    ::testing::Values(
        Refusal{"Milligrams", {"--dry", "20"}, "dry_g_cm2 is 20: 0 to 0.05 g/cm²; milligrams?"},
        Refusal{"Nan", {"--dry", "nan"}, "--dry: \"nan\" is not a number"},
        Refusal{"HalfAPlate", {"--structure", "0.5"}, "structure is 0.5: 1 to 4"},
        Refusal{"Spad", {"--spad", "90"}, "--spad: spad is 90: 0 to 82"},
        Refusal{"SpadBesideChlorophyll", {"--spad", "40", "--chlorophyll", "30"}, "excludes"},
        Refusal{"Model", {"--model", "cube"}, "the model \"cube\" is unknown"},
        Refusal{"WaterOfAPlate", {"--model", "plate", "--water", "0.01"}, "--water"},
        Refusal{"RangeWithoutSpectra", {"--nm", "400..500"}, "--nm: has no effect here"},
        Refusal{"Range", {"--spectra", "OUT/a.csv", "--nm", "300..500"}, "within 400..2500"},
        Refusal{"SpectrumOfAPlate", {"--model", "plate", "--spectra", "OUT/a.csv"}, "no spectrum"},
        Refusal{"Picture", {"-o", "OUT/leaf.gif"}, "is not the name of a PNG picture"},
        Refusal{"SpectraToOutput", {"--spectra", "-"}, "cannot be standard output"},
        Refusal{"EmptyName", {"fit", ""}, "SPECTRUM"},
        Refusal{"NoTable", {"--csv", "OUT/none.csv"}, "none.csv: there is no such file"},
        Refusal{"NoSpectrum", {"fit", "OUT/none.csv"}, "none.csv: there is no such file"},
        Refusal{"NoStructure", {"maps", "OUT/none.png", "-o", "OUT/maps"}, "none.png"}),
    [](const auto& refusal) { return std::string(refusal.param.name); });

TEST(Leaf, NeverOverwritesItsInput) {
  const TemporaryFolder folder;
  const cv::Mat structure(8, 16, CV_8UC3, cv::Scalar(255, 0, 0));
  cv::imwrite(folder / "pigment.png", structure);
  const std::string before = ReadFile(folder / "pigment.png");
  ExpectRefused(RunPleinair({"leaf", "maps", folder / "pigment.png", "-o", folder / "."}),
                "will not be overwritten");
  EXPECT_EQ(ReadFile(folder / "pigment.png"), before);
  WriteFile(folder / "a.csv", "name,chlorophyll_ug_cm2\na,40\n");
  ExpectRefused(RunPleinair({"leaf", "--csv", folder / "a.csv", "--spectra", folder / "a.csv"}),
                "would be overwritten");
}

TEST(Leaf, NamesTheLineOfABrokenTable) {
  const TemporaryFolder folder;
  for (const std::string row : {"20", "x", "nan", "0.001,2", "-1"}) {
    WriteFile(folder / "in.csv", "dry_g_cm2\n0.01\n" + row + "\n");
    ExpectRefused(RunPleinair({"leaf", "--csv", folder / "in.csv"}), "in.csv:3: ");
  }
  WriteFile(folder / "in.csv", "name,weight\n");
  ExpectRefused(RunPleinair({"leaf", "--csv", folder / "in.csv"}),
                "in.csv:1: the column \"weight\" is unknown");
  WriteFile(folder / "in.csv", "wavelength_nm,reflectance\n400,0.1\n410,35\n");
  ExpectRefused(RunPleinair({"leaf", "fit", folder / "in.csv"}), "in.csv:3: reflectance \"35\"");
  WriteFile(folder / "in.csv", "wavelength_nm,reflectance\n400,0.1\n410,0.2\n");
  ExpectRefused(RunPleinair({"leaf", "fit", folder / "in.csv"}), "has 2 wavelengths");
}

}  // namespace
}  // namespace pleinair::e2e
