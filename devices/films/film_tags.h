#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/utc_time.h"

namespace pleinair::devices {

/// Place, time, direction and lens that a film or a photograph states of itself. They are offered
/// to the user, and never used by themselves: clocks are wrong, and places may be those of an
/// editor.
struct FilmTags {
  struct Place {
    double latitude_deg = 0.0;   ///< North positive.
    double longitude_deg = 0.0;  ///< East positive.
    std::optional<double> height_m;
  };
  std::optional<Place> place;
  /// Time as stated, RFC 3339 with an offset: of the first frame, or of the end by some recorders.
  std::string time;
  /// Direction of the camera's view, clockwise from north, degrees; photographs only.
  std::optional<double> view_heading_deg;
  bool view_heading_is_magnetic = false;
  std::string camera;  ///< Maker and model; may be empty.
  std::optional<double> focal_length_35mm;
  /// Tags that cannot be true, as sentences.
  std::vector<std::string> rejected;
};

/// Parses a place of ISO 6709:2022, Annex H: "+50.0875+014.4213+220/", in degrees, degrees and
/// minutes (+5005.25+01425.28/) or degrees, minutes and seconds. Nullopt: another form, or beyond
/// the poles or the date line.
std::optional<FilmTags::Place> ParseIso6709(std::string_view text);

/// The offset's colon is optional in QuickTime ("2025-09-14T13:05:00+0200"). Returns RFC 3339, or
/// empty: another form, or no offset. Errors are not told apart.
std::string Rfc3339OfTag(std::string_view text);

/// A tag's text without trailing blanks; control characters become blanks.
std::string CleanTag(std::string text);

/// Maker and model of a camera, without saying the maker twice; empty without either.
std::string CameraName(const std::string& make, const std::string& model);

/// Understands the metadata of a film's container (QuickTime, MP4, Matroska), keys as libavformat
/// names them.
FilmTags TagsOfFilm(const std::map<std::string, std::string>& metadata);

/// Understands the EXIF data of a JPEG image (Exif 2.32: DateTimeOriginal with its offset, GPS
/// place and GPSImgDirection, focal length), by libexif. Without EXIF: no tags.
FilmTags TagsOfPhoto(std::string_view jpeg);

}  // namespace pleinair::devices
