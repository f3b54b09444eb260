#include "devices/recordings/frame_pack_scan.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

namespace pleinair::devices {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxSentences = 8;

/// Reads `count` bytes; false if the file is too short.
bool ReadPackBytes(std::ifstream& file, std::int64_t at, void* to, std::size_t count) {
  file.clear();
  file.seekg(at);
  file.read(static_cast<char*>(to), static_cast<std::streamsize>(count));
  return static_cast<std::size_t>(file.gcount()) == count;
}

/// The record at a position by its header alone. Nullopt: there is no header, or its lengths lead
/// beyond the end of the file.
std::optional<FramePackPlace> PlaceAt(std::ifstream& file, std::int64_t at,
                                      std::int64_t file_bytes) {
  std::array<char, FrameRecordHead::kBytes> bytes{};
  if (!ReadPackBytes(file, at, bytes.data(), bytes.size())) return std::nullopt;
  const auto head = FrameRecordHead::Decode({bytes.data(), bytes.size()});
  if (!head) return std::nullopt;
  const FramePackPlace place{at, *head, 0};
  if (place.bytes() > file_bytes - at) return std::nullopt;
  return place;
}

/// Finds the first whole record at or behind a position.
class RecordSearch {
 public:
  RecordSearch(const fs::path& file, std::int64_t file_bytes)
      : stream_(file, std::ios::binary), file_bytes_(file_bytes), budget_(4 * file_bytes) {}

  std::optional<FramePackPlace> From(std::int64_t at) {
    if (auto here = RecordAt(at)) return here;
    std::string block;
    while (budget_ > 0) {
      constexpr std::int64_t kBlock = std::int64_t{1} << 20;
      const auto magic = static_cast<std::int64_t>(FrameRecordHead::kMagic.size());
      ++at;
      const std::int64_t count = std::min(kBlock, file_bytes_ - at);
      if (count < magic) return std::nullopt;
      block.resize(static_cast<std::size_t>(count));
      if (!ReadPackBytes(stream_, at, block.data(), block.size())) return std::nullopt;
      const std::size_t found = block.find(FrameRecordHead::kMagic);
      if (found == std::string::npos) {
        budget_ -= count;
        at += count - magic;  // The magic may begin in this block and end in the next.
        continue;
      }
      budget_ -= static_cast<std::int64_t>(found);
      at += static_cast<std::int64_t>(found);
      if (auto here = RecordAt(at)) return here;
    }
    return std::nullopt;
  }

 private:
  std::optional<FramePackPlace> RecordAt(std::int64_t at) {
    auto place = PlaceAt(stream_, at, file_bytes_);
    if (!place) return std::nullopt;
    const auto read = ReadFramePackRecord(stream_, *place);
    if (!read) {
      budget_ -= place->bytes();
      return std::nullopt;
    }
    place->timestamp_ns = read->frame.timestamp_ns;
    return place;
  }

  std::ifstream stream_;
  std::int64_t file_bytes_;
  std::int64_t budget_;  ///< Bytes that failed searches may still read.
};

std::string SecondsText(std::int64_t ns) {
  std::string text = std::to_string(static_cast<double>(ns) * 1e-9);
  text.erase(text.size() - 4);  // Hundredths.
  return text + " s";
}

}  // namespace

std::optional<FrameMetadata> ReadFramePackRecord(std::ifstream& file, const FramePackPlace& place) {
  std::string facts(place.head.metadata_bytes, '\0');
  std::vector<std::uint8_t> image(place.head.image_bytes);
  const auto start = static_cast<std::int64_t>(FrameRecordHead::kBytes) + place.at;
  if (!ReadPackBytes(file, start, facts.data(), facts.size()) ||
      !ReadPackBytes(file, start + place.head.metadata_bytes, image.data(), image.size())) {
    return std::nullopt;
  }
  uLong sum = crc32(0, reinterpret_cast<const Bytef*>(facts.data()), place.head.metadata_bytes);
  sum = crc32_z(sum, image.data(), image.size());
  if (sum != place.head.checksum) return std::nullopt;
  auto read = ParseFrameMetadata(facts);
  if (read) read->layout.bytes = std::move(image);
  return read;
}

std::int64_t FramePackScan::LostBytes() const {
  auto lost = file_bytes - static_cast<std::int64_t>(kFramePackStart.size());
  for (const FramePackPlace& place : places) lost -= place.bytes();
  return lost;
}

std::vector<std::string> FramePackScan::Damage(const fs::path& file) const {
  std::vector<std::string> sentences;
  const auto tell = [&](std::int64_t bytes, const std::string& where) {
    if (bytes > 0) {
      sentences.push_back(file.string() + ": " + std::to_string(bytes) + " bytes " + where);
    }
  };
  auto at = static_cast<std::int64_t>(kFramePackStart.size());
  const std::int64_t start_ns = places.front().timestamp_ns;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const FramePackPlace& place = places[i];
    tell(place.at - at, i == 0 ? "before the first whole frame are damaged"
                               : "before frame " + std::to_string(i) +
                                     " are damaged: no whole frame between " +
                                     SecondsText(places[i - 1].timestamp_ns - start_ns) + " and " +
                                     SecondsText(place.timestamp_ns - start_ns));
    at = place.at + place.bytes();
  }
  tell(file_bytes - at, "behind the last whole frame, " + std::to_string(places.size() - 1) +
                            ", are cut or damaged");
  if (sentences.size() > kMaxSentences) {
    const std::size_t more = sentences.size() - kMaxSentences;
    sentences.resize(kMaxSentences);
    sentences.push_back(file.string() + ": is damaged at " + std::to_string(more) +
                        " further places");
  }
  if (!sentences.empty()) {
    sentences.back() +=
        "; all whole frames are used, 'pleinair recover' makes a clean copy of them";
  }
  return sentences;
}

std::optional<FramePackScan> WalkFramePack(const fs::path& file) {
  std::error_code error;
  FramePackScan chain;
  chain.file_bytes = static_cast<std::int64_t>(fs::file_size(file, error));
  if (error) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  auto at = static_cast<std::int64_t>(kFramePackStart.size());
  while (at != chain.file_bytes) {
    const auto place = PlaceAt(stream, at, chain.file_bytes);
    if (!place) return std::nullopt;
    chain.places.push_back(*place);
    at += place->bytes();
  }
  if (chain.places.empty()) return std::nullopt;
  for (FramePackPlace* place : {&chain.places.front(), &chain.places.back()}) {
    const auto read = ReadFramePackRecord(stream, *place);
    if (!read) return std::nullopt;
    place->timestamp_ns = read->frame.timestamp_ns;
  }
  return chain;
}

Result<FramePackScan> ScanFramePack(const fs::path& file) {
  std::error_code error;
  FramePackScan scan;
  scan.file_bytes = static_cast<std::int64_t>(fs::file_size(file, error));
  if (error) return InputError(file.string(), "cannot be read: " + error.message());
  RecordSearch search(file, scan.file_bytes);
  auto at = static_cast<std::int64_t>(kFramePackStart.size());
  while (const std::optional<FramePackPlace> place = search.From(at)) {
    scan.places.push_back(*place);
    at = place->at + place->bytes();
  }
  if (scan.places.empty()) {
    return InputError(file.string(), "holds no whole frame", "record it again");
  }
  return scan;
}

}  // namespace pleinair::devices
