#pragma once

#include <unistd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace pleinair::compositor::testing {

/// A temporary folder for each test, removed afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "pleinair_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path Write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline void AppendBigEndian(std::uint32_t value, std::string* to) {
  for (int shift = 24; shift >= 0; shift -= 8) to->push_back(static_cast<char>(value >> shift));
}

inline void AppendPngChunk(const std::string& type, const std::string& data, std::string* png) {
  AppendBigEndian(static_cast<std::uint32_t>(data.size()), png);
  const std::string body = type + data;
  std::uint32_t crc = ~0U;  // PNG specification, annex D.
  for (const char c : body) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  *png += body;
  AppendBigEndian(~crc, png);
}

/// A PNG whose header has this size, without pixels.
inline std::string PngHeader(std::uint32_t width, std::uint32_t height) {
  std::string png("\x89PNG\r\n\x1a\n", 8);
  std::string header;
  AppendBigEndian(width, &header);
  AppendBigEndian(height, &header);
  header += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits, RGB.
  AppendPngChunk("IHDR", header, &png);
  return png;
}

/// A small RGB image as PNG, stored without compression (RFC 1950, RFC 1951).
inline std::string MakePng(std::uint32_t width, std::uint32_t height,
                           const std::vector<std::array<std::uint8_t, 3>>& pixels) {
  std::string rows;
  for (std::uint32_t y = 0; y < height; ++y) {
    rows.push_back('\0');
    for (std::uint32_t x = 0; x < width; ++x) {
      for (const std::uint8_t value : pixels[y * width + x])
        rows.push_back(static_cast<char>(value));
    }
  }
  std::string stream("\x78\x01\x01", 3);
  const auto size = static_cast<std::uint16_t>(rows.size());
  for (const std::uint16_t length : {size, static_cast<std::uint16_t>(~size)}) {
    stream.push_back(static_cast<char>(length & 255));
    stream.push_back(static_cast<char>(length >> 8));
  }
  stream += rows;
  std::uint32_t a = 1, b = 0;
  for (const char c : rows) {
    a = (a + static_cast<std::uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  AppendBigEndian((b << 16) | a, &stream);
  std::string png = PngHeader(width, height);
  AppendPngChunk("IDAT", stream, &png);
  AppendPngChunk("IEND", "", &png);
  return png;
}

}  // namespace pleinair::compositor::testing
