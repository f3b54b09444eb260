// Tests `pleinair marker` and `pleinair board` as processes, with files rendered by other programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "tests/e2e/command_output.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kPixelsPerMm = 12.0;

/// A page rendered by Poppler and by librsvg, 12 px/mm.
cv::Mat DrawPdf(const fs::path& pdf, int page = 1) {
  const fs::path png = pdf.string() + ".page" + std::to_string(page);
  const std::string number = std::to_string(page);
  const RunResult run = RunCommandLine({"pdftoppm", "-r", "304.8", "-f", number, "-l", number,
                                        "-gray", "-png", "-singlefile", pdf, png});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return cv::imread(png.string() + ".png", cv::IMREAD_GRAYSCALE);
}

cv::Mat DrawSvg(const fs::path& svg) {
  const std::string png = svg.string() + ".png";
  const RunResult run =
      RunCommandLine({"rsvg-convert", "-d", "304.8", "-p", "304.8", "-o", png, svg});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return cv::imread(png, cv::IMREAD_GRAYSCALE);
}

/// Length of black along a line of pixels, in mm. Antialiasing limits the error to a fraction of a
/// pixel for any gamma.
double BlackAlong(const cv::Mat& line) {
  double black_px = 0.0;
  for (int y = 0; y < line.rows; ++y) {
    for (int x = 0; x < line.cols; ++x) black_px += 1.0 - line.at<std::uint8_t>(y, x) / 255.0;
  }
  return black_px / kPixelsPerMm;
}

class PrintedSheet : public ::testing::TestWithParam<double> {};

TEST_P(PrintedSheet, IsTrueToScaleAndTheSameAsPdfSvgAndPng) {
  const std::string size = std::to_string(GetParam());
  const TemporaryFolder folder;
  nlohmann::json told;
  for (const char* name : {"m.pdf", "m.svg", "m.png"}) {
    const RunResult run = RunPleinair(
        {"marker", "1234", "--size-mm", size, "--page", "130x125", "-o", folder / name, "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    told = JsonLines(run.out).at(0);
  }
  const auto corner = [&](int i, int axis) {
    return told["corners_on_page_mm"][i][axis].get<double>();
  };
  EXPECT_NEAR(corner(2, 0) - corner(0, 0), GetParam(), 1e-6);
  const cv::Mat png = cv::imread(folder / "m.png", cv::IMREAD_GRAYSCALE);
  ASSERT_EQ(png.size(), cv::Size(1560, 1500));
  // The marker without half of its white margin.
  const double margin = 0.05 * GetParam();
  const cv::Rect print(
      cv::Point((corner(0, 0) - margin) * kPixelsPerMm, (corner(0, 1) - margin) * kPixelsPerMm),
      cv::Point((corner(2, 0) + margin) * kPixelsPerMm, (corner(2, 1) + margin) * kPixelsPerMm));
  for (const cv::Mat& page : {png, DrawPdf(folder / "m.pdf"), DrawSvg(folder / "m.svg")}) {
    // Other programs may round half a page pixel differently.
    ASSERT_NEAR(page.cols, png.cols, 1);
    ASSERT_NEAR(page.rows, png.rows, 1);
    // The rim is black from edge to edge: its length is the marker's size, its centre the position.
    const int rim_y = static_cast<int>((corner(0, 1) + 0.05 * GetParam()) * kPixelsPerMm);
    const int rim_x = static_cast<int>((corner(0, 0) + 0.05 * GetParam()) * kPixelsPerMm);
    const cv::Range across(print.x, print.x + print.width), down(print.y, print.y + print.height);
    EXPECT_NEAR(BlackAlong(page(cv::Range(rim_y, rim_y + 1), across)), GetParam(), 0.1);
    EXPECT_NEAR(BlackAlong(page(down, cv::Range(rim_x, rim_x + 1))), GetParam(), 0.1);
    const int middle = print.x + print.width / 2;
    EXPECT_NEAR(BlackAlong(page(cv::Range(rim_y, rim_y + 1), cv::Range(print.x, middle))),
                middle / kPixelsPerMm - corner(0, 0), 0.1);
    // Hairlines between modules or a module of the wrong color would differ by more.
    cv::Mat difference;
    cv::absdiff(page(print), png(print), difference);
    int grossly = 0;
    for (int y = 0; y < difference.rows; ++y) {
      for (int x = 0; x < difference.cols; ++x) grossly += difference.at<std::uint8_t>(y, x) > 140;
    }
    EXPECT_LE(grossly, 4);  // A module's corner may be rounded to another pixel.
    // The rim is black throughout: three modules deep, away from its edges.
    const double module_px = GetParam() / 40 * kPixelsPerMm;
    const cv::Rect rim(cv::Point(corner(0, 0) * kPixelsPerMm + 2, corner(0, 1) * kPixelsPerMm + 2),
                       cv::Size(40 * module_px - 4, 3 * module_px));
    double least = 0.0, most = 0.0;
    cv::minMaxLoc(page(rim), &least, &most);
    EXPECT_EQ(most, 0.0);
  }
}

// One layout with modules on whole pixels, one without.
INSTANTIATE_TEST_SUITE_P(Sizes, PrintedSheet, ::testing::Values(40.0, 37.3));

TEST(MarkerSheet, HasItsNumberItsSizeAndARulerOfAHundredMillimetres) {
  const TemporaryFolder folder;
  ASSERT_EQ(RunPleinair({"marker", "1234", "-o", folder / "m.pdf"}).exit_code, 0);
  const RunResult text = RunCommandLine({"pdftotext", "-layout", folder / "m.pdf", "-"});
  EXPECT_THAT(text.out, AllOf(HasSubstr("S-G marker 1234"), HasSubstr("version 1"),
                              HasSubstr("140 mm"), HasSubstr("outer edge"), HasSubstr("100 mm")));
  const RunResult info = RunCommandLine({"pdfinfo", folder / "m.pdf"});
  EXPECT_THAT(info.out, AllOf(HasSubstr("(A4)"), HasSubstr("S-G marker 1234")));
  EXPECT_THAT(info.err, IsEmpty());
  // The longest isolated black line below the marker thinner than a millimetre belongs to the ruler
  // or the arrow. The ruler has 101 ticks above it, two of them 100 mm apart.
  const cv::Mat page = DrawPdf(folder / "m.pdf");
  int ruler_rows = 0;
  for (int y = static_cast<int>(185 * kPixelsPerMm); y < page.rows; ++y) {
    const double black = BlackAlong(page.row(y));
    ruler_rows += std::abs(black - 100.2) < 0.2 ? 1 : 0;
  }
  EXPECT_GE(ruler_rows, 1);
}

TEST(MarkerSheet, OfSeveralNumbersIsOnePdfOrOneFileEach) {
  const TemporaryFolder folder;
  const RunResult pdf = RunPleinair({"marker", "3", "7-8", "-o", folder / "all.pdf", "--json"});
  ASSERT_EQ(pdf.exit_code, 0) << pdf.err;
  const auto lines = JsonLines(pdf.out);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[2]["id"], 8);
  EXPECT_EQ(lines[2]["page"], 3);
  EXPECT_THAT(RunCommandLine({"pdftotext", "-f", "3", folder / "all.pdf", "-"}).out,
              HasSubstr("S-G marker 8"));
  ASSERT_EQ(RunPleinair({"marker", "3", "7", "-o", folder / "m{id}.svg"}).exit_code, 0);
  ASSERT_EQ(
      RunPleinair({"marker", "3", "7", "--png", "--pixels", "96", "-o", folder / "d/"}).exit_code,
      0);
  EXPECT_THAT(Listing(folder.path()),
              ElementsAre("all.pdf", "d", "d/sg-3.png", "d/sg-7.png", "m3.svg", "m7.svg"));
}

TEST(MarkerImage, IsTheBarePrintAndSaysItsEdgeFraction) {
  const TemporaryFolder folder;
  const RunResult run =
      RunPleinair({"marker", "5", "--png", "--pixels", "480", "-o", folder / "m.png", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto line = JsonLines(run.out).at(0);
  EXPECT_EQ(line["id"], 5);
  EXPECT_EQ(line["pixels"], 480);
  EXPECT_DOUBLE_EQ(line["edge_fraction"].get<double>(), 40.0 / 48.0);
  const cv::Mat picture = cv::imread(folder / "m.png", cv::IMREAD_UNCHANGED);
  ASSERT_EQ(picture.size(), cv::Size(480, 480));
  ASSERT_EQ(picture.type(), CV_8UC1);
  const cv::Rect edge(40, 40, 400, 400);
  EXPECT_EQ(cv::countNonZero(picture.row(50)), 80);
  EXPECT_EQ(cv::countNonZero(picture.col(430)), 80);
  EXPECT_EQ(cv::countNonZero(255 - picture) - cv::countNonZero(255 - picture(edge)), 0);
}

TEST(Board, StandsOnThePageWhereItsDescriptionSays) {
  const TemporaryFolder folder;
  const RunResult run =
      RunPleinair({"board", "--columns", "2", "--rows", "2", "--first", "9", "--size-mm", "35",
                   "--gap-mm", "10", "--page", "150x160", "-o", folder / "b.pdf", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(JsonLines(run.out).at(0)["count"], 4);
  const auto board = nlohmann::json::parse(ReadFile(folder / "b.json"));
  ASSERT_EQ(board["markers"].size(), 4U);
  const cv::Mat page = DrawPdf(folder / "b.pdf");
  // Over the second marker's rim, right of the board's centre and above it.
  const auto& corners = board["markers"][1]["corners_m"];
  EXPECT_EQ(board["markers"][1]["id"], 10);
  const double left_mm = corners[0][0].get<double>() * 1e3;
  const double right_mm = corners[1][0].get<double>() * 1e3;
  EXPECT_DOUBLE_EQ(left_mm, 5.0);
  EXPECT_DOUBLE_EQ(right_mm, 40.0);
  // Both top markers' rims cross this row: 10 mm from the page's top, 5 mm of label, the margin.
  const int rim_y = static_cast<int>((10.0 + 5.0 + 3.5 + 1.5) * kPixelsPerMm);
  EXPECT_NEAR(BlackAlong(page.row(rim_y)), 70.0, 0.1);
  std::vector<int> edges;
  for (int x = 1; x < page.cols; ++x) {
    const bool before = page.at<std::uint8_t>(rim_y, x - 1) < 128;
    if (before != (page.at<std::uint8_t>(rim_y, x) < 128)) edges.push_back(x);
  }
  ASSERT_EQ(edges.size(), 4U);
  EXPECT_NEAR((edges[2] - edges[1]) / kPixelsPerMm, 10.0, 0.1);
  EXPECT_NEAR((edges[3] - edges[2]) / kPixelsPerMm, right_mm - left_mm, 0.1);
}

TEST(Board, HasSquaresTrueToScaleWhereAChessboardIsAskedFor) {
  const TemporaryFolder folder;
  const RunResult run = RunPleinair(
      {"board", "--chessboard", "9x6", "--square-mm", "15", "-o", folder / "c.pdf", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(JsonLines(run.out).at(0)["square_mm"], 15.0);
  const cv::Mat page = DrawPdf(folder / "c.pdf");
  // Through the centre of the first row: 10 mm of page, half a square of white, half a square.
  EXPECT_NEAR(BlackAlong(page.row(static_cast<int>(25.0 * kPixelsPerMm))), 5 * 15.0, 0.1);
  EXPECT_NEAR(BlackAlong(page.row(static_cast<int>(40.0 * kPixelsPerMm))), 5 * 15.0, 0.1);
}

TEST(Board, DoesNotReplaceAFileThatIsNoDescription) {
  const TemporaryFolder folder;
  WriteFile(folder / "b.json", "{\"precious\": 1}");
  const RunResult run = RunPleinair({"board", "-o", folder / "b.pdf"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("--description"));
  EXPECT_EQ(ReadFile(folder / "b.json"), "{\"precious\": 1}");
  ASSERT_EQ(RunPleinair({"board", "-o", folder / "c.pdf"}).exit_code, 0);
  EXPECT_EQ(RunPleinair({"board", "-o", folder / "c.pdf"}).exit_code, 0);
}

// Command lines copied from the help must work.
TEST(SheetHelp, HasExamplesThatRunAsTheyStand) {
  for (const char* command : {"marker", "board"}) {
    std::istringstream help(RunPleinair({command, "--help"}).out);
    int examples = 0;
    for (std::string line; std::getline(help, line);) {
      const std::string program = "  pleinair ";
      if (!line.starts_with(program)) continue;
      ++examples;
      const TemporaryFolder folder;
      const RunResult run =
          RunCommandLine({"sh", "-c",
                          "cd '" + std::string(folder.path()) + "' && " + PleinairProgram() + " " +
                              line.substr(program.size())});
      EXPECT_EQ(run.exit_code, 0) << line << "\n" << run.err;
      EXPECT_FALSE(Listing(folder.path()).empty()) << line;
    }
    EXPECT_GE(examples, 4) << command;
  }
}

struct BadUse {
  const char* name;
  std::vector<std::string> arguments;
  std::string message;
};

void PrintTo(const BadUse& use, std::ostream* out) { *out << use.name; }

class BadSheet : public ::testing::TestWithParam<BadUse> {};

TEST_P(BadSheet, IsRefusedInOneLineAndLeavesNothing) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = GetParam().arguments;
  for (std::string& argument : arguments) {
    if (argument.starts_with("OUT/")) argument = folder / argument.substr(4);
  }
  ExpectRefused(RunPleinair(arguments), GetParam().message);
  EXPECT_THAT(Listing(folder.path()), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    Uses, BadSheet,
    ::testing::Values(
        BadUse{"NumberBeyondTheLast", {"marker", "4096", "-o", "OUT/m.pdf"}, "0 to 4095"},
        BadUse{"NegativeNumber", {"marker", "-1", "-o", "OUT/m.pdf"}, "-1"},
        BadUse{"NoNumber", {"marker", "seventeen", "-o", "OUT/m.pdf"}, "seventeen"},
        BadUse{"NoOutput", {"marker", "17"}, "--output"},
        BadUse{"TooLargeForThePage",
               {"marker", "17", "--size-mm", "200", "-o", "OUT/m.pdf"},
               "--page A3"},
        BadUse{"SizeOfZero", {"marker", "17", "--size-mm", "0", "-o", "OUT/m.pdf"}, "--size-mm"},
        BadUse{"SizeNotANumber",
               {"marker", "17", "--size-mm", "nan", "-o", "OUT/m.pdf"},
               "--size-mm: \"nan\" is no length"},
        BadUse{"BoardOfNoSize",
               {"board", "--size-mm", "nan", "-o", "OUT/b.pdf"},
               "--size-mm: \"nan\" is no length"},
        BadUse{"BoardWithNoSquares",
               {"board", "--chessboard", "9x6", "--square-mm", "nan", "-o", "OUT/b.pdf"},
               "--square-mm: \"nan\" is no length"},
        BadUse{"UnknownPage", {"marker", "17", "--page", "A17", "-o", "OUT/m.pdf"}, "A17"},
        BadUse{"UnknownEnding", {"marker", "17", "-o", "OUT/m.gif"}, ".gif"},
        BadUse{"EndingAgainstOption", {"marker", "17", "--svg", "-o", "OUT/m.png"}, "--svg"},
        BadUse{"PixelsOfAPdf", {"marker", "17", "--pixels", "480", "-o", "OUT/m.pdf"}, "--png"},
        BadUse{"FewerPixelsThanModules",
               {"marker", "17", "--png", "--pixels", "47", "-o", "OUT/m.png"},
               "--pixels"},
        BadUse{"OnePictureForTwo", {"marker", "1", "2", "-o", "OUT/m.png"}, "{id}"},
        BadUse{"FolderNotThere", {"marker", "1", "-o", "OUT/none/m.png"}, "none"},
        BadUse{"BoardBeyondTheLastNumber", {"board", "--first", "4090", "-o", "OUT/b.pdf"}, "4095"},
        BadUse{"BoardWithoutMargin", {"board", "--gap-mm", "1", "-o", "OUT/b.pdf"}, "3.6 mm"},
        BadUse{"ChessboardTooLarge",
               {"board", "--chessboard", "9x6", "--square-mm", "30", "-o", "OUT/b.pdf"},
               "--page A2"},
        BadUse{"ChessboardOfMarkers",
               {"board", "--chessboard", "9x6", "--columns", "3", "-o", "OUT/b.pdf"},
               "--columns excludes --chessboard"},
        BadUse{"CharucoBoardWithTooFewCodes",
               {"board", "--charuco", "30x30", "--dictionary", "4x4_50", "-o", "OUT/b.pdf"},
               "has 50 markers"},
        BadUse{"CharucoBoardWithoutWhite",
               {"board", "--charuco", "8x6", "--square-mm", "20", "--marker-mm", "19", "-o",
                "OUT/b.pdf"},
               "give 8 to 18 mm"},
        BadUse{"BoardTooLarge", {"board", "--size-mm", "60", "-o", "OUT/b.pdf"}, "--page A2"}),
    [](const auto& use) { return std::string(use.param.name); });

}  // namespace
}  // namespace pleinair::e2e
