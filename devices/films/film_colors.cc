#include "devices/films/film_colors.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/srgb.h"
#include "devices/films/film_transfer.h"

namespace pleinair::devices {
namespace {

constexpr int kHdRows = 720;

// Code points of ITU-T H.273, 8.1 (primaries).
constexpr int kPrimariesBt709 = 1, kPrimariesBt601Pal = 5, kPrimariesBt601Ntsc = 6,
              kPrimariesBt2020 = 9, kPrimariesP3D65 = 12;
// 8.2 (transfer characteristics).
constexpr int kTransferBt709 = 1, kTransferGamma22 = 4, kTransferGamma28 = 5, kTransferBt601 = 6,
              kTransferLinear = 8, kTransferXvYcc = 11, kTransferSrgb = 13,
              kTransferBt2020Of10 = 14, kTransferBt2020Of12 = 15, kTransferPq = 16,
              kTransferHlg = 18;
// 8.3 (matrix coefficients).
constexpr int kMatrixRgb = 0, kMatrixBt709 = 1, kMatrixFcc = 4, kMatrixBt601Pal = 5,
              kMatrixBt601Ntsc = 6, kMatrix240M = 7, kMatrixBt2020 = 9;

/// 2 is "unspecified"; 0 and 3 are reserved, but 0 is a matrix. Writers that know nothing put 0.
bool IsUnstated(int code) { return code < 4 && code != 1; }

constexpr std::array<double, 6> kBt709{0.640, 0.330, 0.300, 0.600, 0.150, 0.060};
constexpr std::array<double, 6> kBt601Pal{0.640, 0.330, 0.290, 0.600, 0.150, 0.060};
constexpr std::array<double, 6> kBt601Ntsc{0.630, 0.340, 0.310, 0.595, 0.155, 0.070};
constexpr std::array<double, 6> kBt2020{0.708, 0.292, 0.170, 0.797, 0.131, 0.046};
constexpr std::array<double, 6> kP3{0.680, 0.320, 0.265, 0.690, 0.150, 0.060};
constexpr double kD65X = 0.3127, kD65Y = 0.3290;

Mat3 Inverse(const Mat3& a) {
  const auto cofactor = [&](int r, int c) {
    const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return a(r1, c1) * a(r2, c2) - a(r1, c2) * a(r2, c1);
  };
  const double determinant =
      a(0, 0) * cofactor(0, 0) + a(0, 1) * cofactor(0, 1) + a(0, 2) * cofactor(0, 2);
  Mat3 inverse;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) inverse(r, c) = cofactor(c, r) / determinant;
  }
  return inverse;
}

/// CIE XYZ of linear light, for Y = 1 of white (SMPTE RP 177-1993, 3.3).
Mat3 XyzFromRgb(const std::array<double, 6>& xy) {
  Mat3 columns;
  for (int c = 0; c < 3; ++c) {
    const double x = xy[2 * c], y = xy[2 * c + 1];
    columns(0, c) = x / y;
    columns(1, c) = 1.0;
    columns(2, c) = (1.0 - x - y) / y;
  }
  const Vec3 white{kD65X / kD65Y, 1.0, (1.0 - kD65X - kD65Y) / kD65Y};
  const Vec3 scale = Inverse(columns) * white;
  const double scales[] = {scale.x, scale.y, scale.z};
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) columns(r, c) *= scales[c];
  }
  return columns;
}

struct Primaries {
  std::array<double, 6> chromaticities;
  const char* text;
};

std::optional<Primaries> PrimariesOf(int code) {
  if (IsUnstated(code)) return Primaries{kBt709, "unstated (BT.709)"};
  switch (code) {
    case kPrimariesBt709:
      return Primaries{kBt709, "BT.709"};
    case kPrimariesBt601Pal:
      return Primaries{kBt601Pal, "BT.601 (625 lines)"};
    case kPrimariesBt601Ntsc:
      return Primaries{kBt601Ntsc, "BT.601 (525 lines)"};
    case kPrimariesBt2020:
      return Primaries{kBt2020, "BT.2020"};
    case kPrimariesP3D65:
      return Primaries{kP3, "Display P3"};
    default:
      return std::nullopt;
  }
}

std::optional<FilmTransfer> TransferOf(int code) {
  if (IsUnstated(code)) return FilmTransfer::kSrgb;
  switch (code) {
    case kTransferBt709:
    case kTransferBt601:
    case kTransferXvYcc:
    case kTransferBt2020Of10:
    case kTransferBt2020Of12:
      return FilmTransfer::kBt709;
    case kTransferGamma22:
      return FilmTransfer::kGamma22;
    case kTransferGamma28:
      return FilmTransfer::kGamma28;
    case kTransferLinear:
      return FilmTransfer::kLinear;
    case kTransferSrgb:
      return FilmTransfer::kSrgb;
    case kTransferPq:
      return FilmTransfer::kPq;
    case kTransferHlg:
      return FilmTransfer::kHlg;
    default:
      return std::nullopt;
  }
}

std::optional<int> MatrixOf(const FilmColorTags& tags, int rows) {
  if (tags.is_rgb) return kMatrixRgb;
  switch (tags.matrix) {
    case kMatrixBt709:
    case kMatrixFcc:
    case kMatrixBt601Pal:
    case kMatrixBt601Ntsc:
    case kMatrix240M:
    case kMatrixBt2020:
      return tags.matrix;
    case kMatrixRgb:  // The pixels are not R'G'B'.
      return std::nullopt;
    default:
      if (!IsUnstated(tags.matrix)) return std::nullopt;
      return rows >= kHdRows ? kMatrixBt709 : kMatrixBt601Ntsc;
  }
}

const char* TransferText(FilmTransfer transfer) {
  switch (transfer) {
    case FilmTransfer::kSrgb:
      return "sRGB";
    case FilmTransfer::kBt709:
      return "BT.709";
    case FilmTransfer::kGamma22:
      return "gamma 2.2";
    case FilmTransfer::kGamma28:
      return "gamma 2.8";
    case FilmTransfer::kLinear:
      return "linear";
    case FilmTransfer::kHlg:
      return "HLG";
    case FilmTransfer::kPq:
      return "PQ";
  }
  return "";
}

const char* MatrixText(int matrix) {
  switch (matrix) {
    case kMatrixRgb:
      return "RGB";
    case kMatrixBt709:
      return "BT.709 matrix";
    case kMatrixBt2020:
      return "BT.2020 matrix";
    case kMatrixFcc:
      return "FCC matrix";
    case kMatrix240M:
      return "SMPTE 240M matrix";
    default:
      return "BT.601 matrix";
  }
}

tl::unexpected<Error> Unsupported(const std::string& name, const std::string& what, int code) {
  return InputError(name,
                    "states " + what + " number " + std::to_string(code) +
                        " of ITU-T H.273, which cannot be read",
                    "convert it to BT.709 in a video editor");
}

}  // namespace

Mat3 Rec709FromPrimaries(const std::array<double, 6>& chromaticities) {
  return Inverse(XyzFromRgb(kBt709)) * XyzFromRgb(chromaticities);
}

Result<FilmColors> FilmColors::Create(const FilmColorTags& tags, int rows,
                                      const std::string& name) {
  const auto primaries = PrimariesOf(tags.primaries);
  if (!primaries) return Unsupported(name, "color primaries", tags.primaries);
  const auto transfer = TransferOf(tags.transfer);
  if (!transfer) return Unsupported(name, "the transfer curve", tags.transfer);
  const auto matrix = MatrixOf(tags, rows);
  if (!matrix) return Unsupported(name, "the color matrix", tags.matrix);
  if (tags.primaries == kPrimariesBt2020 && IsUnstated(tags.transfer)) {
    return InputError(name, "states BT.2020 colors, but no transfer curve (HLG, PQ or BT.2020)",
                      "export it again with its color tags, or convert it to BT.709");
  }
  FilmColors colors;
  colors.matrix = *matrix;
  colors.full_range = tags.full_range;
  colors.transfer = *transfer;
  if (primaries->chromaticities != kBt709) {
    colors.rec709_from_film = Rec709FromPrimaries(primaries->chromaticities);
  }
  colors.primaries_text_ = primaries->text;
  return colors;
}

bool FilmColors::IsHdr() const {
  return transfer == FilmTransfer::kHlg || transfer == FilmTransfer::kPq;
}

bool FilmColors::IsConverted() const {
  return IsHdr() || transfer == FilmTransfer::kLinear || rec709_from_film != Mat3();
}

double FilmColors::Light(double signal) const {
  switch (transfer) {
    case FilmTransfer::kSrgb:
      return LinearFromSrgb(signal);
    case FilmTransfer::kBt709:
      return LightFromBt709(signal);
    case FilmTransfer::kGamma22:
      return LightFromGamma(signal, 2.2);
    case FilmTransfer::kGamma28:
      return LightFromGamma(signal, 2.8);
    case FilmTransfer::kLinear:
      return signal;
    case FilmTransfer::kHlg:
      return LightFromHlg(signal) / HlgReferenceWhite();
    case FilmTransfer::kPq:
      return LightFromPq(signal) / PqReferenceWhite();
  }
  return signal;
}

FilmCurve FilmColors::curve() const {
  switch (transfer) {
    case FilmTransfer::kBt709:
      return FilmCurve::kBt709;
    case FilmTransfer::kGamma22:
      return FilmCurve::kGamma22;
    case FilmTransfer::kGamma28:
      return FilmCurve::kGamma28;
    default:
      return FilmCurve::kSrgb;
  }
}

double FilmColors::Encoded(double light) const {
  const double clamped = std::clamp(light, 0.0, 1.0);
  switch (curve()) {
    case FilmCurve::kBt709:
      return Bt709FromLight(clamped);
    case FilmCurve::kGamma22:
      return std::pow(clamped, 1.0 / 2.2);
    case FilmCurve::kGamma28:
      return std::pow(clamped, 1.0 / 2.8);
    default:
      return SrgbFromLinear(clamped);
  }
}

std::string FilmColors::Text() const {
  return std::string(TransferText(transfer)) + ", " + primaries_text_ + " colors, " +
         MatrixText(matrix) + ", " + (full_range ? "full" : "limited") + " range";
}

}  // namespace pleinair::devices
