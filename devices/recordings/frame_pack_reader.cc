#include <algorithm>
#include <cstddef>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "devices/recordings/frame_pack.h"
#include "devices/recordings/frame_pack_format.h"
#include "devices/recordings/frame_pack_scan.h"

namespace pleinair::devices {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> HasChanged(const std::string& name) {
  return InputError(name, "has changed while it was read",
                    "wait until the recording has ended, then repeat the command");
}

class FramePack : public FrameSource {
 public:
  /// Adds to `damage` what is found while reading. `is_scanned`: all checksums hold.
  FramePack(fs::path file, std::vector<FramePackPlace> places, bool is_scanned, ImageSize size,
            std::shared_ptr<std::vector<std::string>> damage)
      : file_(std::move(file)),
        stream_(file_, std::ios::binary),
        places_(std::move(places)),
        is_scanned_(is_scanned),
        damage_(std::move(damage)),
        size_(size),
        start_ns_(places_.front().timestamp_ns),
        count_(static_cast<std::int64_t>(places_.size())) {}

  Result<std::optional<Frame>> Next() override {
    if (next_ >= places_.size()) return std::nullopt;
    const std::size_t index = std::exchange(next_, places_.size());
    const std::string name = file_.string() + ", frame " + std::to_string(index);
    auto facts = ReadFramePackRecord(stream_, places_[index]);
    if (!facts && !is_scanned_) {
      PLEINAIR_RETURN_IF_ERROR(ScanFrom(index));
      if (index == places_.size()) return std::nullopt;
      facts = ReadFramePackRecord(stream_, places_[index]);
    }
    if (!facts) return HasChanged(name);
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

  // A constant: another thread may ask while this one reads.
  std::optional<std::int64_t> FrameCount() const override { return count_; }

 private:
  /// Replaces the places by the whole frames, and goes to their end. Those before `index` have been
  /// delivered.
  Result<void> ScanFrom(std::size_t index) {
    PLEINAIR_ASSIGN_OR_RETURN(FramePackScan scan, ScanFramePack(file_));
    const auto delivered = places_.begin() + static_cast<std::ptrdiff_t>(index);
    if (scan.places.size() < index ||
        !std::equal(places_.begin(), delivered, scan.places.begin(),
                    [](const auto& a, const auto& b) { return a.at == b.at; })) {
      return HasChanged(file_.string());
    }
    *damage_ = scan.Damage(file_);
    places_ = std::move(scan.places);
    next_ = places_.size();
    is_scanned_ = true;
    return {};
  }

  fs::path file_;
  std::ifstream stream_;
  std::vector<FramePackPlace> places_;
  bool is_scanned_;
  std::shared_ptr<std::vector<std::string>> damage_;
  ImageSize size_;
  std::int64_t start_ns_;
  std::int64_t count_;
  std::size_t next_ = 0;
};

tl::unexpected<Error> IsNoFramePack(const fs::path& file) {
  return InputError(file.string(), "is no frame pack",
                    "docs/guide/reference/recordings.md describes recordings");
}

}  // namespace

bool IsFramePack(const fs::path& file) {
  // A damaged header must not make it a film.
  if (file.extension() == ".pack") return true;
  std::ifstream stream(file, std::ios::binary);
  std::string start(kFramePackStart.size(), '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  return stream && start == kFramePackStart;
}

Result<OpenedFramePack> OpenFramePack(const fs::path& file, ImageSize size) {
  if (!IsFramePack(file)) return IsNoFramePack(file);
  std::optional<FramePackScan> chain = WalkFramePack(file);
  const bool is_scanned = !chain;
  if (is_scanned) {
    PLEINAIR_ASSIGN_OR_RETURN(chain, ScanFramePack(file));
  }
  FramePackScan& scan = *chain;
  std::ifstream stream(file, std::ios::binary);
  const auto first = ReadFramePackRecord(stream, scan.places.front());
  if (!first) return HasChanged(file.string());
  if (size == ImageSize{}) size = {first->layout.width, first->layout.height};
  OpenedFramePack opened;
  opened.dropped_bytes = scan.LostBytes();
  const auto damage = std::make_shared<std::vector<std::string>>(scan.Damage(file));
  opened.damage = damage;
  const std::int64_t span_ns = scan.places.back().timestamp_ns - scan.places.front().timestamp_ns;
  if (span_ns > 0) {
    opened.frame_rate_hz =
        static_cast<double>(scan.places.size() - 1) / (static_cast<double>(span_ns) * 1e-9);
  }
  opened.frames =
      std::make_unique<FramePack>(file, std::move(scan.places), is_scanned, size, damage);
  return opened;
}

Result<RecoveredFramePack> RecoverFramePack(const fs::path& from, const fs::path& to,
                                            const std::function<Result<void>()>& check) {
  if (!IsFramePack(from)) return IsNoFramePack(from);
  PLEINAIR_ASSIGN_OR_RETURN(const FramePackScan scan, ScanFramePack(from));
  PLEINAIR_ASSIGN_OR_RETURN(const auto writer, FramePackWriter::Create(to));
  std::ifstream stream(from, std::ios::binary);
  std::string record;
  for (const FramePackPlace& place : scan.places) {
    PLEINAIR_RETURN_IF_ERROR(check());
    record.resize(static_cast<std::size_t>(place.bytes()));
    stream.seekg(place.at);
    stream.read(record.data(), static_cast<std::streamsize>(record.size()));
    if (!stream) return HasChanged(from.string());
    PLEINAIR_RETURN_IF_ERROR(writer->AddRecord(record));
  }
  PLEINAIR_RETURN_IF_ERROR(writer->Sync());
  return RecoveredFramePack{static_cast<std::int64_t>(scan.places.size()), scan.Damage(from)};
}

}  // namespace pleinair::devices
