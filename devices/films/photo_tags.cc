#include <cmath>
#include <optional>
#include <string>

#include "devices/films/exif.h"
#include "devices/films/film_tags.h"

namespace pleinair::devices {
namespace {

// Tags that libexif 0.6.24 has no names for (Exif 2.31).
constexpr int kOffsetTimeOriginal = 0x9011;

std::optional<FilmTags::Place> PlaceOf(const Exif& exif) {
  const auto latitude = exif.Angle(EXIF_TAG_GPS_LATITUDE, EXIF_TAG_GPS_LATITUDE_REF, 'S');
  const auto longitude = exif.Angle(EXIF_TAG_GPS_LONGITUDE, EXIF_TAG_GPS_LONGITUDE_REF, 'W');
  if (!latitude || !longitude) return std::nullopt;
  FilmTags::Place place{*latitude, *longitude, {}};
  if (const auto height_m = exif.Number(EXIF_IFD_GPS, EXIF_TAG_GPS_ALTITUDE)) {
    const bool below = exif.Number(EXIF_IFD_GPS, EXIF_TAG_GPS_ALTITUDE_REF) == 1.0;
    place.height_m = below ? -*height_m : *height_m;
  }
  return place;
}

/// "2025:09:14 13:05:00" and "+02:00" as RFC 3339.
std::string TimeOf(std::string time, const std::string& offset) {
  constexpr std::size_t kYear = 4, kMonth = 7, kDay = 10;
  if (time.size() < 19) return {};
  time[kYear] = time[kMonth] = '-';
  time[kDay] = 'T';
  return Rfc3339OfTag(time.substr(0, 19) + offset);
}

}  // namespace

FilmTags TagsOfPhoto(std::string_view jpeg) {
  FilmTags tags;
  const std::optional<Exif> read = Exif::In(jpeg);
  if (!read) return tags;
  const Exif& exif = *read;
  tags.place = PlaceOf(exif);
  if (tags.place &&
      (std::abs(tags.place->latitude_deg) > 90.0 || std::abs(tags.place->longitude_deg) > 180.0)) {
    tags.place.reset();
    tags.rejected.emplace_back("Its place is none on Earth.");
  }
  const std::string time = exif.Text(EXIF_IFD_EXIF, EXIF_TAG_DATE_TIME_ORIGINAL);
  const std::string offset = exif.Text(EXIF_IFD_EXIF, kOffsetTimeOriginal);
  if (!time.empty()) {
    tags.time = TimeOf(time, offset);
    if (tags.time.empty()) {
      tags.rejected.push_back("Its time, \"" + time + offset +
                              "\", is no date with an offset from UTC.");
    }
  }
  if (const auto heading = exif.Number(EXIF_IFD_GPS, EXIF_TAG_GPS_IMG_DIRECTION)) {
    if (*heading >= 0.0 && *heading <= 360.0) {
      tags.view_heading_deg = *heading;
      tags.view_heading_is_magnetic =
          exif.Text(EXIF_IFD_GPS, EXIF_TAG_GPS_IMG_DIRECTION_REF).starts_with('M');
    } else {
      tags.rejected.emplace_back("Its direction is no angle of a compass.");
    }
  }
  tags.camera =
      CameraName(exif.Text(EXIF_IFD_0, EXIF_TAG_MAKE), exif.Text(EXIF_IFD_0, EXIF_TAG_MODEL));
  const auto focal = exif.Number(EXIF_IFD_EXIF, EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM);
  if (focal && *focal > 0.0) tags.focal_length_35mm = *focal;
  return tags;
}

}  // namespace pleinair::devices
