#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "devices/recordings/frame_pack.h"
#include "devices/recordings/frame_pack_format.h"
#include "devices/recordings/frame_pack_scan.h"

namespace pleinair::devices {
namespace {

namespace fs = std::filesystem;

class FramePack : public FrameSource {
 public:
  FramePack(fs::path file, std::vector<FramePackPlace> places, ImageSize size)
      : file_(std::move(file)),
        stream_(file_, std::ios::binary),
        places_(std::move(places)),
        size_(size) {}

  Result<std::optional<Frame>> Next() override {
    if (next_ >= places_.size()) return std::nullopt;
    const std::size_t index = std::exchange(next_, places_.size());
    const std::string name = file_.string() + ", frame " + std::to_string(index);
    auto facts = ReadFramePackRecord(stream_, places_[index]);
    if (!facts) {
      return InputError(name, "has changed while it was read",
                        "wait until the recording has ended, then repeat the command");
    }
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
    const std::int64_t start_ns = places_.front().timestamp_ns;
    frame.index = static_cast<std::int64_t>(index);
    frame.timestamp_ns -= start_ns;
    if (frame.arrival_ns) *frame.arrival_ns -= start_ns;
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
  std::vector<FramePackPlace> places_;
  ImageSize size_;
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
  PLEINAIR_ASSIGN_OR_RETURN(FramePackScan scan, ScanFramePack(file));
  std::ifstream stream(file, std::ios::binary);
  const auto first = ReadFramePackRecord(stream, scan.places.front());
  if (!first) return InputError(file.string(), "has changed while it was read");
  if (size == ImageSize{}) size = {first->layout.width, first->layout.height};
  OpenedFramePack opened;
  opened.dropped_bytes = scan.LostBytes();
  opened.damage = scan.Damage(file);
  const std::int64_t span_ns = scan.places.back().timestamp_ns - scan.places.front().timestamp_ns;
  if (span_ns > 0) {
    opened.frame_rate_hz =
        static_cast<double>(scan.places.size() - 1) / (static_cast<double>(span_ns) * 1e-9);
  }
  opened.frames = std::make_unique<FramePack>(file, std::move(scan.places), size);
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
    if (!stream) return InputError(from.string(), "has changed while it was read");
    PLEINAIR_RETURN_IF_ERROR(writer->AddRecord(record));
  }
  PLEINAIR_RETURN_IF_ERROR(writer->Sync());
  return RecoveredFramePack{static_cast<std::int64_t>(scan.places.size()), scan.Damage(from)};
}

}  // namespace pleinair::devices
