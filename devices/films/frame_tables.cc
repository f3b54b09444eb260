#include "devices/films/frame_tables.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/big_endian.h"

namespace pleinair::devices {
namespace {

/// Larger headers are not checked: 64 MiB describe a day of film.
constexpr std::uint64_t kMaxHeader = std::uint64_t{64} << 20;
constexpr std::size_t kBoxHead = 8, kFullBoxHead = 4, kCount = 4;

std::uint64_t NumberAt(std::string_view bytes, std::size_t at, std::size_t count) {
  return at + count > bytes.size() ? 0 : BigEndian(bytes.substr(at, count));
}

/// The contents of all boxes of a type directly within `content`.
std::vector<std::string_view> BoxesOf(std::string_view content, std::string_view type) {
  std::vector<std::string_view> boxes;
  while (content.size() >= kBoxHead) {
    const std::uint64_t length = NumberAt(content, 0, 4);
    if (length < kBoxHead || length > content.size()) break;
    if (content.substr(4, 4) == type) {
      boxes.push_back(content.substr(kBoxHead, length - kBoxHead));
    }
    content.remove_prefix(length);
  }
  return boxes;
}

std::string_view BoxOf(std::string_view content, std::string_view type) {
  const std::vector<std::string_view> boxes = BoxesOf(content, type);
  return boxes.empty() ? std::string_view() : boxes.front();
}

/// Sum of the first column of a table of (count, value) rows: `stts`. Nothing without one.
std::optional<std::uint64_t> SumOfCounts(std::string_view table) {
  if (table.size() < kFullBoxHead + kCount) return std::nullopt;
  const std::uint64_t rows = NumberAt(table, kFullBoxHead, kCount);
  constexpr std::size_t kRow = 8;
  std::uint64_t sum = 0;
  for (std::uint64_t row = 0; row < rows; ++row) {
    const std::size_t at = kFullBoxHead + kCount + row * kRow;
    if (at + kRow > table.size()) break;
    sum += NumberAt(table, at, 4);
  }
  return sum;
}

/// Frames in all chunks: each row of `stsc` holds from its first chunk to the next row's.
std::optional<std::uint64_t> FramesInChunks(std::string_view stsc, std::uint64_t chunks) {
  if (stsc.size() < kFullBoxHead + kCount) return std::nullopt;
  constexpr std::size_t kRow = 12, kFirst = kFullBoxHead + kCount;
  const std::uint64_t rows =
      std::min<std::uint64_t>(NumberAt(stsc, kFullBoxHead, kCount), (stsc.size() - kFirst) / kRow);
  std::uint64_t frames = 0;
  for (std::uint64_t row = 0; row < rows; ++row) {
    const std::size_t at = kFirst + row * kRow;
    const std::uint64_t first = NumberAt(stsc, at, 4);
    const std::uint64_t next = row + 1 < rows ? NumberAt(stsc, at + kRow, 4) : chunks + 1;
    const std::uint64_t end = std::min(next, chunks + 1);  // A row may stand for no chunk.
    if (end > first) frames += (end - first) * NumberAt(stsc, at + 4, 4);
  }
  return frames;
}

/// The movie's header; empty if there is none, or if it is too large.
std::string ReadMovieHeader(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 16> head{};
  std::uint64_t at = 0;
  while (stream.seekg(static_cast<std::streamoff>(at)) && stream.read(head.data(), head.size())) {
    const std::string_view bytes(head.data(), head.size());
    const bool is_long = NumberAt(bytes, 0, 4) == 1;
    const std::uint64_t length = is_long ? NumberAt(bytes, 8, 8) : NumberAt(bytes, 0, 4);
    const std::uint64_t start = is_long ? 16 : kBoxHead;
    if (length < start || length > INT64_MAX - at) return {};
    if (bytes.substr(4, 4) == "moov") {
      if (length > kMaxHeader) return {};
      std::string header(length - start, '\0');
      stream.seekg(static_cast<std::streamoff>(at + start));
      if (!stream.read(header.data(), static_cast<std::streamsize>(header.size()))) return {};
      return header;
    }
    at += length;
  }
  return {};
}

}  // namespace

Result<void> CheckFrameTables(const std::filesystem::path& file) {
  const std::string header = ReadMovieHeader(file);
  for (const std::string_view track : BoxesOf(header, "trak")) {
    const std::string_view media = BoxOf(track, "mdia");
    const std::string_view handler = BoxOf(media, "hdlr");
    if (handler.size() < 12 || handler.substr(8, 4) != "vide") continue;
    const std::string_view table = BoxOf(BoxOf(media, "minf"), "stbl");
    const std::string_view sizes = BoxOf(table, "stsz");
    if (sizes.empty()) continue;
    const std::uint64_t frames = NumberAt(sizes, kFullBoxHead + 4, kCount);
    const std::string_view offsets32 = BoxOf(table, "stco");
    const std::uint64_t chunks = offsets32.empty()
                                     ? NumberAt(BoxOf(table, "co64"), kFullBoxHead, kCount)
                                     : NumberAt(offsets32, kFullBoxHead, kCount);
    for (const std::optional<std::uint64_t> other :
         {SumOfCounts(BoxOf(table, "stts")), FramesInChunks(BoxOf(table, "stsc"), chunks)}) {
      if (!other || *other == frames) continue;
      return InputError(file.string(),
                        "is damaged: its header announces " +
                            std::to_string(std::max(frames, *other)) + " frames in one table and " +
                            std::to_string(std::min(frames, *other)) + " in another",
                        "get a whole copy of it");
    }
  }
  return {};
}

}  // namespace pleinair::devices
