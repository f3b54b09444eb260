#pragma once

// Internal: shared by the readers of this folder.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <libexif/exif-data.h>

#include "devices/films/film_tags.h"

namespace pleinair::devices {

/// Values of one image's EXIF data.
class Exif {
 public:
  /// Reads a JPEG image, or its beginning; nothing without EXIF.
  static std::optional<Exif> In(std::string_view jpeg) {
    ExifData* data = exif_data_new_from_data(reinterpret_cast<const unsigned char*>(jpeg.data()),
                                             static_cast<unsigned>(jpeg.size()));
    if (data == nullptr) return std::nullopt;
    return Exif(data);
  }

  std::string Text(ExifIfd group, int tag) const {
    const ExifEntry* entry = Entry(group, tag);
    if (entry == nullptr || entry->format != EXIF_FORMAT_ASCII) return {};
    std::string text(reinterpret_cast<const char*>(entry->data), entry->size);
    text.resize(std::min(text.size(), text.find('\0')));
    return CleanTag(std::move(text));
  }

  std::optional<double> Number(ExifIfd group, int tag, unsigned index = 0) const {
    const ExifEntry* entry = Entry(group, tag);
    if (entry == nullptr || index >= entry->components) return std::nullopt;
    const std::size_t bytes = exif_format_get_size(entry->format);
    if (entry->size < (index + 1) * bytes) return std::nullopt;
    const unsigned char* at = entry->data + index * bytes;
    if (entry->format == EXIF_FORMAT_SHORT) return exif_get_short(at, order_);
    if (entry->format == EXIF_FORMAT_BYTE) return *at;
    if (entry->format != EXIF_FORMAT_RATIONAL) return std::nullopt;
    const ExifRational fraction = exif_get_rational(at, order_);
    if (fraction.denominator == 0) return std::nullopt;
    return static_cast<double>(fraction.numerator) / fraction.denominator;
  }

  /// True for a fraction whose numerator is FFFFFFFF, by which Exif writes infinity.
  bool IsInfinite(ExifIfd group, int tag) const {
    const ExifEntry* entry = Entry(group, tag);
    constexpr unsigned kInfinity = 0xFFFFFFFF, kBytes = 8;
    return entry != nullptr && entry->format == EXIF_FORMAT_RATIONAL && entry->size >= kBytes &&
           exif_get_rational(entry->data, order_).numerator == kInfinity;
  }

  /// Degrees, minutes and seconds, with the letter of the negative direction.
  std::optional<double> Angle(int tag, int reference, char negative) const {
    double angle = 0.0, unit = 1.0;
    for (unsigned i = 0; i < 3; ++i, unit /= 60.0) {
      const auto part = Number(EXIF_IFD_GPS, tag, i);
      if (!part) return std::nullopt;
      angle += *part * unit;
    }
    return Text(EXIF_IFD_GPS, reference).starts_with(negative) ? -angle : angle;
  }

 private:
  struct Deleter {
    void operator()(ExifData* data) const { exif_data_unref(data); }
  };

  explicit Exif(ExifData* data) : data_(data), order_(exif_data_get_byte_order(data)) {}

  const ExifEntry* Entry(ExifIfd group, int tag) const {
    return exif_content_get_entry(data_->ifd[group], static_cast<ExifTag>(tag));
  }

  std::unique_ptr<ExifData, Deleter> data_;
  ExifByteOrder order_;
};

}  // namespace pleinair::devices
