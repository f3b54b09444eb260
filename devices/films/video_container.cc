#include "devices/films/video_container.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "base/big_endian.h"
#include "base/little_endian.h"

namespace pleinair::devices {
namespace {

constexpr int kMaxBoxes = 100'000;

tl::unexpected<Error> CutShort(const std::filesystem::path& file, std::uint64_t bytes,
                               std::uint64_t promised) {
  return InputError(file.string(),
                    "is cut short: " + std::to_string(bytes) + " of at least " +
                        std::to_string(promised) + " bytes are there",
                    "get a whole copy of it");
}

/// An element's length (RFC 8794, 4: the leading zeros of the first byte count the further ones).
struct EbmlLength {
  std::size_t bytes = 0;
  std::uint64_t value = 0;
  bool is_known = false;
};

std::optional<EbmlLength> ReadEbmlLength(std::string_view at) {
  if (at.empty() || at[0] == 0) return std::nullopt;
  EbmlLength length;
  length.bytes = static_cast<std::size_t>(std::countl_zero(static_cast<std::uint8_t>(at[0]))) + 1;
  if (at.size() < length.bytes) return std::nullopt;
  const std::uint64_t mask = (std::uint64_t{1} << (7 * length.bytes)) - 1;
  length.value = BigEndian(at.substr(0, length.bytes)) & mask;
  length.is_known = length.value != mask;  // All ones: a stream.
  return length;
}

constexpr std::string_view kEbmlHeader = "\x1a\x45\xdf\xa3";
constexpr std::string_view kMatroskaSegment = "\x18\x53\x80\x67";

/// Matroska and WebM: an EBML header, then one segment with everything else (RFC 9559, 4.5).
Result<void> CheckMatroska(const std::filesystem::path& file, std::string_view start,
                           std::uint64_t bytes) {
  const auto header = ReadEbmlLength(start.substr(kEbmlHeader.size()));
  if (!header) return {};
  const std::uint64_t segment = kEbmlHeader.size() + header->bytes + header->value;
  if (segment >= start.size()) return {};
  const std::string_view rest = start.substr(segment);
  if (!rest.starts_with(kMatroskaSegment)) return {};
  const auto length = ReadEbmlLength(rest.substr(kMatroskaSegment.size()));
  if (!length || !length->is_known) return {};
  const std::uint64_t end = segment + kMatroskaSegment.size() + length->bytes + length->value;
  if (end > bytes) return CutShort(file, bytes, end);
  return {};
}

}  // namespace

Result<void> CheckContainerIsWhole(const std::filesystem::path& file) {
  std::error_code error;
  const std::uint64_t bytes = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 256> start{};
  stream.read(start.data(), start.size());
  const std::string_view begun(start.data(), static_cast<std::size_t>(stream.gcount()));
  if (begun.starts_with(kEbmlHeader)) return CheckMatroska(file, begun, bytes);
  stream.clear();
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
