#include "devices/recordings/video_container.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "base/little_endian.h"

namespace pleinair::devices {
namespace {

constexpr int kMaxBoxes = 100'000;

// Big-endian number of `count` bytes.
std::uint64_t BigEndian(std::string_view bytes) {
  std::uint64_t number = 0;
  for (const char c : bytes) number = number << 8 | static_cast<std::uint8_t>(c);
  return number;
}

tl::unexpected<Error> CutShort(const std::filesystem::path& file, std::uint64_t bytes,
                               std::uint64_t promised) {
  return InputError(file.string(),
                    "is cut short: " + std::to_string(bytes) + " of at least " +
                        std::to_string(promised) + " bytes are there",
                    "get a whole copy of it");
}

}  // namespace

Result<void> CheckContainerIsWhole(const std::filesystem::path& file) {
  std::error_code error;
  const std::uint64_t bytes = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 16> buffer{};
  std::uint64_t at = 0;
  for (int box = 0; !error && box < kMaxBoxes && bytes - at >= buffer.size(); ++box) {
    stream.seekg(static_cast<std::streamoff>(at));
    if (!stream.read(buffer.data(), buffer.size())) return {};
    const std::string_view head(buffer.data(), buffer.size());
    const std::string_view type = head.substr(4, 4);
    if (box == 0 && head.starts_with("RIFF")) {
      // A recorder that was interrupted leaves the length at zero.
      const std::uint64_t end = std::uint64_t{LittleEndianReader(type).Get<std::uint32_t>()} + 8;
      if (end > 8 && end > bytes) return CutShort(file, bytes, end);
      return {};
    }
    if (box == 0 && type != "ftyp" && type != "moov" && type != "mdat" && type != "wide") return {};
    std::uint64_t length = BigEndian(head.substr(0, 4));
    if (length == 1) length = BigEndian(head.substr(8, 8));
    if (length < 8) return {};  // Zero: the box extends to the end of the file.
    if (length > bytes - at) {
      return CutShort(file, bytes, length < UINT64_MAX - at ? at + length : length);
    }
    at += length;
  }
  return {};
}

}  // namespace pleinair::devices
