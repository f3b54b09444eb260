// Velocities of VTK files, written here by the formats' rules.
#include "content/flow/files/vtk_flow.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "content/flow/files/flow_file.h"
#include "tests/content/flow/flow_files.h"

namespace pleinair::content {
namespace {

using ::testing::HasSubstr;

/// A rotation on 5 x 4 x 3 points with spacing 0.5, 1, 2 from the origin −1, 0, 10.
std::string Numbers(bool cells = false) {
  std::string text;
  for (int k = 0; k < (cells ? 2 : 3); ++k) {
    for (int j = 0; j < (cells ? 3 : 4); ++j) {
      for (int i = 0; i < (cells ? 4 : 5); ++i) {
        const double off = cells ? 0.5 : 0.0;
        const double x = -1.0 + 0.5 * (i + off), y = 1.0 * (j + off), z = 10.0 + 2.0 * (k + off);
        text += std::to_string(-y) + " " + std::to_string(x) + " " + std::to_string(0.1 * z) + "\n";
      }
    }
  }
  return text;
}

void ExpectRotation(const FlowFile& flow) {
  ASSERT_TRUE(flow.field);
  const Velocity v = flow.field->At({0.3, 1.7, 12.5}, 0.0);
  EXPECT_NEAR(v.x, -1.7, 1e-6);
  EXPECT_NEAR(v.y, 0.3, 1e-6);
  EXPECT_NEAR(v.z, 1.25, 1e-6);
}

const std::string kVtiHead =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" "
    "byte_order=\"LittleEndian\" header_type=\"UInt32\">\n<ImageData WholeExtent=\"0 4 0 3 0 2\" "
    "Origin=\"-1 0 10\" Spacing=\"0.5 1 2\">\n<Piece Extent=\"0 4 0 3 0 2\">\n";
const std::string kVtiTail = "</Piece>\n</ImageData>\n</VTKFile>\n";

std::string Vti(const std::string& data) { return kVtiHead + data + kVtiTail; }
std::string AsciiArray(const std::string& name, const std::string& numbers) {
  return "<DataArray type=\"Float64\" Name=\"" + name +
         "\" NumberOfComponents=\"3\" format=\"ascii\">\n" + numbers + "</DataArray>\n";
}

TEST_F(FlowFiles, ReadImageDataOfPointsAndCells) {
  ExpectRotation(Read(Write("a.vti", Vti("<PointData Vectors=\"U\">\n" +
                                         AsciiArray("U", Numbers()) + "</PointData>\n"))));
  ExpectRotation(Read(Write("b.vti", Vti("<CellData Vectors=\"U\">\n" +
                                         AsciiArray("U", Numbers(true)) + "</CellData>\n"))));
}

TEST_F(FlowFiles, ChooseAmongVectors) {
  const std::string two = "<PointData>\n" + AsciiArray("U", Numbers()) +
                          AsciiArray("other", Numbers()) + "</PointData>\n";
  EXPECT_THAT(ErrorOf(Write("two.vti", Vti(two))),
              ::testing::AllOf(HasSubstr("U, other"), HasSubstr("--vectors")));
  ExpectRotation(Read(Write("two.vti", Vti(two)), {.vectors = "U"}));
  EXPECT_THAT(ErrorOf(Write("two.vti", Vti(two)), {.vectors = "V"}), HasSubstr("other [3 comp"));
}

std::string FloatBytes() {
  std::string bytes;
  const std::string text = Numbers();
  const char* at = text.c_str();
  for (int i = 0; i < 5 * 4 * 3 * 3; ++i) {
    char* end = nullptr;
    const float value = std::strtof(at, &end);
    at = end;
    bytes.append(reinterpret_cast<const char*>(&value), 4);
  }
  return bytes;
}

std::string Header32(std::size_t size) {
  const auto value = static_cast<std::uint32_t>(size);
  return std::string(reinterpret_cast<const char*>(&value), 4);
}

std::string Base64(const std::string& bytes) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t n = 0; n < 3; ++n) {
      bits = bits << 8U | (i + n < bytes.size() ? static_cast<unsigned char>(bytes[i + n]) : 0U);
    }
    for (std::size_t n = 0; n < 4; ++n) {
      text += i + n > bytes.size() ? '=' : digits[bits >> (18 - 6 * n) & 63U];
    }
  }
  return text;
}

TEST_F(FlowFiles, ReadBase64AndAppendedArrays) {
  const std::string bytes = FloatBytes();
  const std::string open =
      "<PointData Vectors=\"U\"><DataArray type=\"Float32\" Name=\"U\" NumberOfComponents=\"3\" ";
  ExpectRotation(Read(
      Write("a.vti", Vti(open + "format=\"binary\">\n" + Base64(Header32(bytes.size()) + bytes) +
                         "\n</DataArray></PointData>\n"))));
  const std::string appended = kVtiHead + open +
                               "format=\"appended\" offset=\"0\"/></PointData>\n" +
                               "</Piece></ImageData>\n<AppendedData encoding=\"raw\">\n _" +
                               Header32(bytes.size()) + bytes + "\n</AppendedData></VTKFile>\n";
  ExpectRotation(Read(Write("b.vti", appended)));
  // Cut short.
  EXPECT_THAT(ErrorOf(Write("c.vti", appended.substr(0, appended.size() - 100))),
              HasSubstr("damaged"));
}

TEST_F(FlowFiles, ReadRectilinearAndStructuredGrids) {
  const std::string data =
      "<PointData Vectors=\"U\">\n" + AsciiArray("U", Numbers()) + "</PointData>\n";
  const auto axis = [](const std::string& numbers) {
    return "<DataArray type=\"Float64\" format=\"ascii\">" + numbers + "</DataArray>\n";
  };
  const std::string vtr =
      "<VTKFile type=\"RectilinearGrid\" byte_order=\"LittleEndian\"><RectilinearGrid "
      "WholeExtent=\"0 4 0 3 0 2\"><Piece Extent=\"0 4 0 3 0 2\">" +
      data + "<Coordinates>" + axis("-1 -0.5 0 0.5 1") + axis("0 1 2 3") + axis("10 12 14") +
      "</Coordinates></Piece></RectilinearGrid></VTKFile>";
  ExpectRotation(Read(Write("a.vtr", vtr)));
  std::string points;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 5; ++i) {
        points += std::to_string(-1.0 + 0.5 * i) + " " + std::to_string(1.0 * j) + " " +
                  std::to_string(10.0 + 2.0 * k) + "\n";
      }
    }
  }
  const std::string vts =
      "<VTKFile type=\"StructuredGrid\" byte_order=\"LittleEndian\"><StructuredGrid "
      "WholeExtent=\"0 4 0 3 0 2\"><Piece Extent=\"0 4 0 3 0 2\">" +
      data + "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" +
      points + "</DataArray></Points></Piece></StructuredGrid></VTKFile>";
  ExpectRotation(Read(Write("a.vts", vts)));
}

TEST_F(FlowFiles, ReadLegacyFiles) {
  const std::string head =
      "# vtk DataFile Version 3.0\nrotation\nASCII\nDATASET STRUCTURED_POINTS\n"
      "DIMENSIONS 5 4 3\nORIGIN -1 0 10\nSPACING 0.5 1 2\nPOINT_DATA 60\n";
  ExpectRotation(Read(Write("a.vtk", head + "VECTORS U double\n" + Numbers())));
  ExpectRotation(Read(Write("b.vtk", head + "FIELD FieldData 1\nU 3 60 double\n" + Numbers())));
  std::string big = FloatBytes();
  for (std::size_t i = 0; i < big.size(); i += 4) {
    std::reverse(big.begin() + static_cast<std::ptrdiff_t>(i),
                 big.begin() + static_cast<std::ptrdiff_t>(i) + 4);
  }
  std::string binary = head + "VECTORS U float\n" + big + "\n";
  binary.replace(binary.find("ASCII"), 5, "BINARY");
  ExpectRotation(Read(Write("c.vtk", binary)));
  EXPECT_THAT(ErrorOf(Write("d.vtk", binary.substr(0, binary.size() - 50))),
              HasSubstr("cut short"));
  std::string unstructured = head;
  unstructured.replace(unstructured.find("STRUCTURED_POINTS"), 17, "UNSTRUCTURED_GRID");
  EXPECT_THAT(ErrorOf(Write("e.vtk", unstructured)), HasSubstr("Resample To Image"));
}

TEST(ParseVtkFlow, RefusesHostileSizes) {
  const auto error = [](const std::string& text) {
    const auto flow = ParseVtkFlow(text, "x.vti", {});
    EXPECT_FALSE(flow);
    return flow ? "" : flow.error().Message();
  };
  EXPECT_THAT(
      error("<VTKFile type=\"ImageData\"><ImageData Origin=\"0 0 0\" Spacing=\"1 1 1\">"
            "<Piece Extent=\"0 2000000000 0 2000000000 0 9\"></Piece></ImageData></VTKFile>"),
      HasSubstr("grid of"));
  EXPECT_THAT(error("# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n"
                    "DIMENSIONS 1000000 1000000 1000000\n"),
              HasSubstr("grid of"));
  EXPECT_THAT(error("<a><b>"), HasSubstr("x.vti"));
  EXPECT_THAT(error(""), HasSubstr("x.vti"));
}

}  // namespace
}  // namespace pleinair::content
