#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pleinair::devices {

/// A JPEG's APP1 segment with little-endian TIFF data: one directory of entries {tag, type, count,
/// value or bytes}.
class ExifBytes {
 public:
  struct Entry {
    int tag, type, count;
    std::string bytes;
  };

  /// Directories 0, Exif and GPS.
  static std::string Jpeg(std::vector<Entry> main, std::vector<Entry> exif,
                          std::vector<Entry> gps) {
    std::string tiff("II*\0\x08\0\0\0", 8);
    main.push_back({0x8769, 4, 1, Number(0, 4)});
    main.push_back({0x8825, 4, 1, Number(0, 4)});
    const std::size_t exif_at = 8 + Size(main), gps_at = exif_at + Size(exif);
    main[main.size() - 2].bytes = Number(exif_at, 4);
    main[main.size() - 1].bytes = Number(gps_at, 4);
    for (const auto* directory : {&main, &exif, &gps}) Append(*directory, &tiff);
    const std::string segment = std::string("Exif\0\0", 6) + tiff;
    const std::size_t length = segment.size() + 2;
    return std::string("\xFF\xD8\xFF\xE1") + static_cast<char>(length >> 8) +
           static_cast<char>(length) + segment + "\xFF\xD9";
  }

  static std::string Number(std::uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i));
    return text;
  }
  static Entry Text(int tag, const std::string& text) {
    return {tag, 2, static_cast<int>(text.size()) + 1, text + '\0'};
  }
  static Entry Rational(int tag, std::vector<std::pair<int, int>> values) {
    std::string bytes;
    for (const auto& [n, d] : values) bytes += Number(n, 4) + Number(d, 4);
    return {tag, 5, static_cast<int>(values.size()), bytes};
  }

 private:
  static std::size_t Size(const std::vector<Entry>& entries) {
    std::size_t size = 2 + 12 * entries.size() + 4;
    for (const Entry& entry : entries) {
      if (entry.bytes.size() > 4) size += entry.bytes.size();
    }
    return size;
  }
  static void Append(const std::vector<Entry>& entries, std::string* tiff) {
    std::size_t data = tiff->size() + 2 + 12 * entries.size() + 4;
    std::string values;
    *tiff += Number(entries.size(), 2);
    for (const Entry& entry : entries) {
      *tiff += Number(entry.tag, 2) + Number(entry.type, 2) + Number(entry.count, 4);
      if (entry.bytes.size() <= 4) {
        *tiff += entry.bytes + std::string(4 - entry.bytes.size(), '\0');
      } else {
        *tiff += Number(data + values.size(), 4);
        values += entry.bytes;
      }
    }
    *tiff += std::string(4, '\0') + values;
  }
};

}  // namespace pleinair::devices
