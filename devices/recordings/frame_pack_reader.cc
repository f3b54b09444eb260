#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "devices/recordings/frame_pack.h"
#include "devices/recordings/frame_pack_format.h"

namespace pleinair::devices {
namespace {

namespace fs = std::filesystem;

/// Position of a frame's record in the file.
struct Place {
  std::int64_t at = 0;
  FrameRecordHead head;

  std::int64_t bytes() const {
    return static_cast<std::int64_t>(FrameRecordHead::kBytes + head.metadata_bytes +
                                     head.image_bytes);
  }
};

/// Reads `count` bytes; false if the file is too short.
bool ReadAt(std::ifstream& file, std::int64_t at, void* to, std::size_t count) {
  file.clear();
  file.seekg(at);
  file.read(static_cast<char*>(to), static_cast<std::streamsize>(count));
  return static_cast<std::size_t>(file.gcount()) == count;
}

std::optional<FrameMetadata> ReadFrame(std::ifstream& file, const Place& place) {
  std::string facts(place.head.metadata_bytes, '\0');
  std::vector<std::uint8_t> image(place.head.image_bytes);
  const auto start = static_cast<std::int64_t>(FrameRecordHead::kBytes) + place.at;
  if (!ReadAt(file, start, facts.data(), facts.size()) ||
      !ReadAt(file, start + place.head.metadata_bytes, image.data(), image.size())) {
    return std::nullopt;
  }
  uLong sum = crc32(0, reinterpret_cast<const Bytef*>(facts.data()), place.head.metadata_bytes);
  sum = crc32_z(sum, image.data(), image.size());
  if (sum != place.head.checksum) return std::nullopt;
  auto read = ParseFrameMetadata(facts);
  if (read) read->layout.bytes = std::move(image);
  return read;
}

class FramePack : public FrameSource {
 public:
  FramePack(fs::path file, std::ifstream stream, std::vector<Place> places, ImageSize size,
            std::int64_t start_ns)
      : file_(std::move(file)),
        stream_(std::move(stream)),
        places_(std::move(places)),
        size_(size),
        start_ns_(start_ns) {}

  Result<std::optional<Frame>> Next() override {
    if (next_ >= places_.size()) return std::nullopt;
    const std::size_t index = std::exchange(next_, places_.size());
    const std::string name = file_.string() + ", frame " + std::to_string(index);
    auto facts = ReadFrame(stream_, places_[index]);
    if (!facts) return InputError(name, "is damaged", "get a whole copy of it");
    Frame frame = std::move(facts->frame);
    if (ImageSize{facts->layout.width, facts->layout.height} != size_) {
      return InputError(name,
                        "has " + std::to_string(facts->layout.width) + "x" +
                            std::to_string(facts->layout.height) +
                            " pixels, but the calibration is for " + std::to_string(size_.width) +
                            "x" + std::to_string(size_.height),
                        "use the calibration of this camera at this size");
    }
    DecodedImage image;
    if (auto converted = ConvertRawImage(facts->layout, &image); !converted) {
      return InputError(name, converted.error().what, "get a whole copy of it");
    }
    frame.index = static_cast<std::int64_t>(index);
    frame.timestamp_ns -= start_ns_;
    if (frame.arrival_ns) *frame.arrival_ns -= start_ns_;
    frame.rgb = std::move(image.rgb);
    frame.grey = std::move(image.grey);
    frame.raw = std::make_shared<const RawImage>(std::move(facts->layout));
    next_ = index + 1;
    return frame;
  }

  std::optional<std::int64_t> FrameCount() const override {
    return static_cast<std::int64_t>(places_.size());
  }

 private:
  fs::path file_;
  std::ifstream stream_;
  std::vector<Place> places_;
  ImageSize size_;
  std::int64_t start_ns_;
  std::size_t next_ = 0;
};

}  // namespace

bool IsFramePack(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string start(kFramePackStart.size(), '\0');
  return ReadAt(stream, 0, start.data(), start.size()) && start == kFramePackStart;
}

Result<OpenedFramePack> OpenFramePack(const fs::path& file, ImageSize size) {
  if (!IsFramePack(file)) {
    return InputError(file.string(), "is no frame pack",
                      "docs/guide/reference/recordings.md describes recordings");
  }
  std::error_code error;
  const auto total = static_cast<std::int64_t>(fs::file_size(file, error));
  if (error) return InputError(file.string(), "cannot be read: " + error.message());
  std::ifstream stream(file, std::ios::binary);
  std::vector<Place> places;
  std::int64_t at = static_cast<std::int64_t>(kFramePackStart.size());
  while (true) {
    std::array<char, FrameRecordHead::kBytes> bytes{};
    if (!ReadAt(stream, at, bytes.data(), bytes.size())) break;
    const auto head = FrameRecordHead::Decode({bytes.data(), bytes.size()});
    if (!head) break;
    const Place place{at, *head};
    if (place.bytes() > total - at) break;
    places.push_back(place);
    at += place.bytes();
  }
  // After a power cut the file may have its full length but not yet its bytes.
  std::optional<FrameMetadata> last;
  while (!places.empty() && !(last = ReadFrame(stream, places.back()))) {
    at = places.back().at;
    places.pop_back();
  }
  if (places.empty()) {
    return InputError(file.string(), "holds no whole frame", "record it again");
  }
  const auto first = ReadFrame(stream, places.front());
  if (!first) {
    return InputError(file.string() + ", frame 0", "is damaged", "get a whole copy of it");
  }
  if (size == ImageSize{}) size = {first->layout.width, first->layout.height};
  OpenedFramePack opened;
  opened.dropped_bytes = total - at;
  const std::int64_t start_ns = first->frame.timestamp_ns;
  const double span_s = static_cast<double>(last->frame.timestamp_ns - start_ns) * 1e-9;
  if (span_s > 0.0) opened.frame_rate_hz = static_cast<double>(places.size() - 1) / span_s;
  opened.frames =
      std::make_unique<FramePack>(file, std::move(stream), std::move(places), size, start_ns);
  return opened;
}

}  // namespace pleinair::devices
