#include "devices/films/film_tags.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

namespace pleinair::devices {
namespace {

constexpr double kMaxHeight_m = 10'000.0;

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/// Takes "+DDMM.mmm" and the like from the front of `text`. `degree_digits`: 2 or 3.
std::optional<double> TakeAngle(std::string_view* text, std::size_t degree_digits) {
  if (text->empty() || ((*text)[0] != '+' && (*text)[0] != '-')) return std::nullopt;
  const bool negative = (*text)[0] == '-';
  std::string_view rest = text->substr(1);
  std::size_t whole = 0;
  while (whole < rest.size() && IsDigit(rest[whole])) ++whole;
  std::size_t length = whole;
  if (length < rest.size() && rest[length] == '.') {
    ++length;
    while (length < rest.size() && IsDigit(rest[length])) ++length;
  }
  // Pairs of digits after the degrees are minutes and seconds; the fraction belongs to the last.
  if (whole < degree_digits || whole > degree_digits + 4 || (whole - degree_digits) % 2 != 0) {
    return std::nullopt;
  }
  double angle = 0.0, unit = 1.0;
  std::size_t at = 0;
  for (std::size_t end = degree_digits; end <= whole; end += 2, unit /= 60.0) {
    const std::string_view part = rest.substr(at, (end == whole ? length : end) - at);
    double value = 0.0;
    if (std::from_chars(part.data(), part.data() + part.size(), value).ec != std::errc()) {
      return std::nullopt;
    }
    if (unit < 1.0 && value >= 60.0) return std::nullopt;
    angle += value * unit;
    at = end;
  }
  *text = rest.substr(length);
  return negative ? -angle : angle;
}

/// The first of some keys that is present.
std::string First(const std::map<std::string, std::string>& metadata,
                  std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    const auto at = metadata.find(key);
    if (at != metadata.end() && !at->second.empty()) return CleanTag(at->second);
  }
  return {};
}

}  // namespace

std::string CleanTag(std::string text) {
  const auto end = std::find_if(text.rbegin(), text.rend(), [](char c) { return c > ' '; });
  text.erase(end.base(), text.end());
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return text;
}

std::string CameraName(const std::string& make, const std::string& model) {
  if (make.empty() || model.starts_with(make)) return model;
  return model.empty() ? make : make + " " + model;
}

std::optional<FilmTags::Place> ParseIso6709(std::string_view text) {
  FilmTags::Place place;
  const auto latitude = TakeAngle(&text, 2);
  if (!latitude) return std::nullopt;
  const auto longitude = TakeAngle(&text, 3);
  if (!longitude || std::abs(*latitude) > 90.0 || std::abs(*longitude) > 180.0) {
    return std::nullopt;
  }
  place.latitude_deg = *latitude;
  place.longitude_deg = *longitude;
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) {
    const bool negative = text[0] == '-';
    double height_m = 0.0;
    const auto read = std::from_chars(text.data() + 1, text.data() + text.size(), height_m);
    if (read.ec == std::errc() && std::abs(height_m) <= kMaxHeight_m) {
      place.height_m = negative ? -height_m : height_m;
    }
  }
  return place;
}

std::string Rfc3339OfTag(std::string_view text) {
  std::string time(text);
  // "+0200" at the end: RFC 3339 has a colon in it.
  const std::size_t size = time.size();
  if (size > 5 && (time[size - 5] == '+' || time[size - 5] == '-') &&
      std::all_of(time.end() - 4, time.end(), IsDigit)) {
    time.insert(size - 2, ":");
  }
  return UtcTime::Parse(time) ? time : std::string();
}

FilmTags TagsOfFilm(const std::map<std::string, std::string>& metadata) {
  FilmTags tags;
  const std::string place =
      First(metadata, {"com.apple.quicktime.location.ISO6709", "location", "location-eng"});
  if (!place.empty()) {
    tags.place = ParseIso6709(place);
    if (!tags.place) tags.rejected.push_back("Its place, \"" + place + "\", is none on Earth.");
  }
  // Apple's has the local offset; the container's own is in UTC.
  const std::string time =
      First(metadata, {"com.apple.quicktime.creationdate", "creation_time", "date"});
  if (!time.empty()) {
    tags.time = Rfc3339OfTag(time);
    if (tags.time.empty()) {
      tags.rejected.push_back("Its time, \"" + time + "\", is no date with an offset from UTC.");
    } else if (tags.time.starts_with("1904") || tags.time.starts_with("1970-01-01")) {
      tags.rejected.push_back("Its time, \"" + time + "\", is that of an unset clock.");
      tags.time.clear();
    }
  }
  tags.camera =
      CameraName(First(metadata, {"com.apple.quicktime.make", "make", "com.android.manufacturer"}),
                 First(metadata, {"com.apple.quicktime.model", "model", "com.android.model"}));
  const std::string focal =
      First(metadata, {"com.apple.quicktime.camera.focal_length.35mm_equivalent"});
  double focal_mm = 0.0;
  const auto read = std::from_chars(focal.data(), focal.data() + focal.size(), focal_mm);
  if (read.ec == std::errc() && focal_mm > 1.0 && focal_mm < 10'000.0) {
    tags.focal_length_35mm = focal_mm;
  }
  return tags;
}

}  // namespace pleinair::devices
