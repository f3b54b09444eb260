#include "app/calibrate/picture_stream.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <fstream>
#include <iostream>
#include <system_error>
#include <utility>

#include "app/terminal/interrupt.h"
#include "devices/cameras/camera_uri.h"
#include "devices/cameras/live_camera.h"
#include "devices/images/image_file.h"
#include "devices/recordings/frame_pack.h"
#include "devices/recordings/video_file.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

class PictureFiles final : public PictureStream {
 public:
  explicit PictureFiles(std::vector<fs::path> files) : files_(std::move(files)) {}

  Result<std::optional<NamedPicture>> Next() override {
    if (next_ == files_.size()) return std::nullopt;
    const fs::path& file = files_[next_++];
    PLEINAIR_ASSIGN_OR_RETURN(devices::DecodedImage picture, devices::DecodeImageFile(file));
    return NamedPicture{file.string(), std::move(picture.grey)};
  }
  std::optional<std::int64_t> Count() const override {
    return static_cast<std::int64_t>(files_.size());
  }
  bool is_film() const override { return false; }

 private:
  const std::vector<fs::path> files_;
  std::size_t next_ = 0;
};

class Film final : public PictureStream {
 public:
  /// `damage` grows while the frames are read; each sentence is printed once.
  Film(std::string name, std::unique_ptr<devices::FrameSource> frames,
       std::optional<double> focal_length_35mm,
       std::shared_ptr<const std::vector<std::string>> damage)
      : name_(std::move(name)),
        frames_(std::move(frames)),
        focal_length_35mm_(focal_length_35mm),
        damage_(std::move(damage)) {}

  Result<std::optional<NamedPicture>> Next() override {
    PLEINAIR_ASSIGN_OR_RETURN(auto frame, frames_->Next());
    for (; told_ < damage_->size(); ++told_) {
      std::cerr << "warning: " << (*damage_)[told_] << '\n';
    }
    if (!frame) return std::nullopt;
    return NamedPicture{name_ + ", frame " + std::to_string(frame->index), std::move(frame->grey)};
  }
  std::optional<std::int64_t> Count() const override { return frames_->FrameCount(); }
  bool is_film() const override { return true; }
  std::optional<double> FocalLength35mm() const override { return focal_length_35mm_; }

 private:
  const std::string name_;
  std::unique_ptr<devices::FrameSource> frames_;
  const std::optional<double> focal_length_35mm_;
  const std::shared_ptr<const std::vector<std::string>> damage_;
  std::size_t told_ = 0;
};

class CameraStream final : public PictureStream {
 public:
  explicit CameraStream(std::unique_ptr<devices::LiveCamera> camera) : camera_(std::move(camera)) {}

  Result<std::optional<NamedPicture>> Next() override {
    while (!InterruptGuard::Interrupted()) {
      auto frame = camera_->NextWithin(std::chrono::milliseconds(200));
      for (const devices::CameraEvent& event : camera_->TakeEvents()) Report(event);
      if (frame) {
        return NamedPicture{"frame " + std::to_string(frame->index), std::move(frame->grey)};
      }
    }
    return std::nullopt;
  }
  std::optional<std::int64_t> Count() const override { return std::nullopt; }
  bool is_film() const override { return true; }
  bool is_live() const override { return true; }

 private:
  static void Report(const devices::CameraEvent& event) {
    using Kind = devices::CameraEvent::Kind;
    if (event.kind == Kind::kGone) std::cerr << "The camera is disconnected; waiting for it.\n";
    if (event.kind == Kind::kStalled) std::cerr << "The camera sends no images; waiting for it.\n";
    if (event.kind == Kind::kConnected && !event.details.empty())
      std::cerr << event.details << ".\n";
  }

  std::unique_ptr<devices::LiveCamera> camera_;
};

bool IsImageName(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg";
}

bool IsPicture(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  char start[4] = {};
  stream.read(start, sizeof start);
  return std::string_view(start, 4) == "\x89PNG" || std::string_view(start, 2) == "\xff\xd8";
}

/// Images of a folder, sorted by name with numbers in numeric order.
Result<std::vector<fs::path>> PicturesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (IsImageName(entry.path()) && entry.is_regular_file(error)) files.push_back(entry.path());
  }
  if (error) return InputError(folder.string(), "cannot be read: " + error.message());
  if (files.empty() && fs::is_directory(folder / "frames", error))
    return PicturesIn(folder / "frames");
  if (files.empty()) {
    return InputError(folder.string(), "holds no image (.png, .jpg)", "name the folder with them");
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    const std::string left = a.filename().string(), right = b.filename().string();
    return std::pair(left.size(), left) < std::pair(right.size(), right);
  });
  return files;
}

std::optional<Result<devices::CameraUri>> CameraNamed(const std::string& source) {
  for (const char* scheme : {"v4l2:", "libcamera:", "aravis:", "file:"}) {
    if (source.starts_with(scheme)) return devices::ParseCameraUri(source);
  }
  return std::nullopt;
}

Result<std::unique_ptr<PictureStream>> OpenCamera(const devices::CameraUri& uri,
                                                  const devices::FormatRequest& requested) {
  devices::LiveCameraOptions options;
  options.uri = uri;
  options.pictures = requested;
  options.wait_for_camera = false;
  PLEINAIR_ASSIGN_OR_RETURN(auto camera, devices::LiveCamera::Open(std::move(options)));
  return std::make_unique<CameraStream>(std::move(camera));
}

Result<std::unique_ptr<PictureStream>> OpenFilm(const fs::path& file) {
  if (devices::IsFramePack(file)) {
    PLEINAIR_ASSIGN_OR_RETURN(devices::OpenedFramePack pack, devices::OpenFramePack(file, {}));
    return std::make_unique<Film>(file.string(), std::move(pack.frames), std::nullopt, pack.damage);
  }
  PLEINAIR_ASSIGN_OR_RETURN(devices::OpenedVideo video, devices::OpenVideo(file, {}));
  return std::make_unique<Film>(file.string(), std::move(video.frames),
                                video.facts.tags.focal_length_35mm,
                                std::make_shared<const std::vector<std::string>>());
}

/// Opens one source: images, which are added to `files`, or a video.
Result<std::unique_ptr<PictureStream>> OpenOne(const fs::path& path, std::vector<fs::path>* files) {
  std::error_code error;
  if (!fs::exists(path, error)) return InputError(path.string(), "is not there", "check the name");
  if (fs::is_directory(path, error)) {
    if (fs::exists(path / "frames.pack", error)) return OpenFilm(path / "frames.pack");
    PLEINAIR_ASSIGN_OR_RETURN(const auto found, PicturesIn(path));
    files->insert(files->end(), found.begin(), found.end());
    return nullptr;
  }
  // A file with an image's name and other content is reported as an invalid image.
  if (!IsImageName(path) && !IsPicture(path)) return OpenFilm(path);
  files->push_back(path);
  return nullptr;
}

}  // namespace

Result<std::unique_ptr<PictureStream>> OpenPictures(const std::vector<std::string>& sources,
                                                    const devices::FormatRequest& requested) {
  const auto alone = [&](const std::string& source) -> Result<void> {
    if (sources.size() == 1) return {};
    return InputError(source, "can only be calibrated alone: cameras and films are not mixed",
                      "name it alone, or images only");
  };
  std::vector<fs::path> files;
  for (const std::string& source : sources) {
    if (const auto uri = CameraNamed(source)) {
      if (!*uri) return tl::make_unexpected(uri->error());
      PLEINAIR_RETURN_IF_ERROR(alone(source));
      if ((*uri)->backend != devices::CameraUri::Backend::kFile)
        return OpenCamera(**uri, requested);
      return OpenPictures({(*uri)->value}, requested);
    }
    PLEINAIR_ASSIGN_OR_RETURN(auto film, OpenOne(source, &files));
    if (!film) continue;
    PLEINAIR_RETURN_IF_ERROR(alone(source));
    return film;
  }
  return std::make_unique<PictureFiles>(std::move(files));
}

}  // namespace pleinair::app
