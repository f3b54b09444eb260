#pragma once

#include <array>
#include <string>

#include "base/error.h"
#include "base/vector.h"
#include "devices/films/film_curve.h"

namespace pleinair::devices {

/// What a film states of its colors: code points of ITU-T H.273 (ISO/IEC 23091-2), 8.1 to 8.3; 2:
/// not stated.
struct FilmColorTags {
  int primaries = 2;
  int transfer = 2;
  int matrix = 2;
  bool full_range = false;
  bool is_rgb = false;  ///< The pixels are R, G and B, without a matrix.
};

/// Curve from the film's signal to scene light.
enum class FilmTransfer { kSrgb, kBt709, kGamma22, kGamma28, kLinear, kHlg, kPq };

/// How a film's values become pixels in Rec.709 primaries.
struct FilmColors {
  int matrix = 2;  ///< As in the tags, resolved by the number of rows.
  bool full_range = false;
  FilmTransfer transfer = FilmTransfer::kSrgb;
  /// From linear light in the film's primaries.
  Mat3 rec709_from_film;

  /// Understands the tags of a film with `rows` rows. An unstated matrix is BT.709 from 720 rows
  /// on, else BT.601; unstated primaries are BT.709; an unstated transfer is sRGB. Errors, with the
  /// remedy: tags that are not supported, and BT.2020 primaries without a transfer.
  static Result<FilmColors> Create(const FilmColorTags& tags, int rows, const std::string& name);

  /// True for HLG, PQ, linear light and primaries that differ from BT.709: pixels are then
  /// converted through linear light.
  bool IsConverted() const;
  bool IsHdr() const;

  /// Scene light of a signal; HDR reference white and SDR's peak are 1.
  double Light(double signal) const;

  /// Curve of the converted pixels.
  FilmCurve curve() const;
  /// Signal (0…1) of scene light by that curve; clamps.
  double Encoded(double light) const;

  /// "HLG, BT.2020 colors, BT.2020 matrix, limited range".
  std::string Text() const;

 private:
  std::string primaries_text_;
};

/// ITU-R BT.709 light from light in other primaries with the same white, D65, by their
/// chromaticities: x and y of red, green and blue (ITU-R BT.2087-0, Annex 1, gives the inverse for
/// BT.2020).
Mat3 Rec709FromPrimaries(const std::array<double, 6>& chromaticities);

}  // namespace pleinair::devices
