#include "devices/recordings/image_sequence.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <system_error>
#include <utility>

namespace pleinair::devices {
namespace {

bool IsImageName(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

// The number at the end of a file's name, before the extension.
std::optional<std::int64_t> NumberOf(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t last_other = stem.find_last_not_of("0123456789");
  const std::size_t first = last_other == std::string::npos ? 0 : last_other + 1;
  std::int64_t number = 0;
  const auto [stop, error] =
      std::from_chars(stem.data() + first, stem.data() + stem.size(), number);
  if (error != std::errc() || stop != stem.data() + stem.size()) return std::nullopt;
  return number;
}

tl::unexpected<Error> WrongSize(const std::string& file, ImageSize is, ImageSize should) {
  return InputError(file,
                    "has " + std::to_string(is.width) + "x" + std::to_string(is.height) +
                        " pixels, but the calibration is for " + std::to_string(should.width) +
                        "x" + std::to_string(should.height),
                    "use the calibration of this camera at this size");
}

class ImageSequence : public FrameSource {
 public:
  ImageSequence(std::vector<SequenceFrame> frames, ImageSize size)
      : frames_(std::move(frames)), size_(size) {}

  Result<std::optional<Frame>> Next() override {
    if (next_ >= frames_.size()) return std::nullopt;
    const std::size_t index = std::exchange(next_, frames_.size());
    const SequenceFrame& from = frames_[index];
    PLEINAIR_ASSIGN_OR_RETURN(DecodedImage image, DecodeImageFile(from.file));
    const ImageSize is{image.rgb.width(), image.rgb.height()};
    if (is != size_) return WrongSize(from.file.string(), is, size_);
    Frame frame;
    frame.index = static_cast<std::int64_t>(index);
    frame.timestamp_ns = from.timestamp_ns;
    frame.device_timestamp_ns = from.device_timestamp_ns;
    frame.rgb = std::move(image.rgb);
    frame.grey = std::move(image.grey);
    next_ = index + 1;
    return frame;
  }

  void SkipTo(std::int64_t index) override {
    if (index > 0) next_ = std::clamp(static_cast<std::size_t>(index), next_, frames_.size());
  }

  std::optional<std::int64_t> FirstFrameFrom(std::int64_t timestamp_ns) const override {
    const auto first = std::find_if(
        frames_.begin(), frames_.end(),
        [&](const SequenceFrame& frame) { return frame.timestamp_ns >= timestamp_ns; });
    return first - frames_.begin();
  }

  std::optional<std::int64_t> FrameCount() const override {
    return static_cast<std::int64_t>(frames_.size());
  }

 private:
  std::vector<SequenceFrame> frames_;
  ImageSize size_;
  std::size_t next_ = 0;
};

}  // namespace

Result<std::vector<std::filesystem::path>> ListNumberedImages(const std::filesystem::path& folder,
                                                              std::optional<int> promised) {
  std::error_code error;
  std::map<std::int64_t, std::filesystem::path> by_number;
  std::filesystem::directory_iterator entries(folder, error);
  if (error) {
    return InputError(folder.string(), "cannot be listed: " + error.message(),
                      "the frames belong there");
  }
  for (const std::filesystem::directory_iterator end; entries != end; entries.increment(error)) {
    const std::filesystem::path& file = entries->path();
    if (!IsImageName(file)) continue;
    const std::optional<std::int64_t> number = NumberOf(file);
    if (!number) continue;
    const auto [place, is_new] = by_number.emplace(*number, file);
    if (!is_new) {
      return InputError(folder.string(),
                        "has frame " + std::to_string(*number) +
                            " twice: " + std::min(place->second, file).filename().string() +
                            " and " + std::max(place->second, file).filename().string(),
                        "remove one of them");
    }
  }
  if (error) return InputError(folder.string(), "cannot be listed: " + error.message());
  if (by_number.empty()) {
    return InputError(folder.string(), "has no numbered PNG or JPEG images",
                      "the frames belong there, as 0000.png and so on");
  }
  std::vector<std::filesystem::path> files;
  std::int64_t expected = by_number.begin()->first;
  for (const auto& [number, file] : by_number) {
    if (number != expected) {
      return InputError(folder.string(),
                        "lacks frame " + std::to_string(expected) + ": after it comes " +
                            file.filename().string(),
                        "put the missing image there or renumber the rest");
    }
    ++expected;
    files.push_back(file);
  }
  if (promised && static_cast<std::size_t>(*promised) != files.size()) {
    return InputError(folder.string(),
                      "has " + std::to_string(files.size()) + " frames, but the recording has " +
                          std::to_string(*promised),
                      "get the missing frames, or correct frame_count and timestamps_s");
  }
  return files;
}

Result<std::unique_ptr<FrameSource>> OpenImageSequence(std::vector<SequenceFrame> frames,
                                                       ImageSize size) {
  for (const SequenceFrame& frame : frames) {
    PLEINAIR_ASSIGN_OR_RETURN(const ImageSize is, InspectImageFile(frame.file));
    if (is != size) return WrongSize(frame.file.string(), is, size);
  }
  return std::make_unique<ImageSequence>(std::move(frames), size);
}

}  // namespace pleinair::devices
