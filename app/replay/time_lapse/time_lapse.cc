#include "app/replay/time_lapse/time_lapse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "app/terminal/interrupt.h"
#include "app/terminal/progress_bar.h"
#include "base/atomic_file.h"
#include "devices/images/resize_image.h"
#include "export/images/image_writer.h"
#include "export/images/video_writer.h"
#include "export/plots/vector_drawing.h"
#include "files/base64.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr double kPicturesPerSecond = 12.0;
// Layout of the sheet.
constexpr std::size_t kColumns = 4, kMaxTiles = 16;
constexpr int kTileWidth_px = 320, kCaption_px = 22;

/// A strip with a time in it.
RgbImage Caption(const std::string& text) {
  exports::VectorDrawing drawing;
  drawing.width = kTileWidth_px;
  drawing.height = kCaption_px;
  drawing.texts.push_back(
      {{kTileWidth_px / 2.0, kCaption_px / 2.0}, 0.65 * kCaption_px, text, {34, 38, 43}});
  return exports::RasterizeDrawing(drawing, kTileWidth_px);
}

void Paste(const RgbImage& from, int left, int top, RgbImage* onto) {
  for (int y = 0; y < from.height(); ++y) {
    std::copy_n(from.view().row(y), static_cast<std::size_t>(from.width()) * 3,
                onto->view().row(top + y) + static_cast<std::ptrdiff_t>(left) * 3);
  }
}

class ContactSheet {
 public:
  ContactSheet(std::size_t pictures, double aspect)
      : tiles_(std::min(pictures, kMaxTiles)),
        pictures_(pictures),
        tile_height_(static_cast<int>(std::lround(kTileWidth_px * aspect))) {
    const std::size_t columns = std::min(tiles_, kColumns);
    const std::size_t rows = (tiles_ + kColumns - 1) / kColumns;
    sheet_ = RgbImage(static_cast<int>(columns) * kTileWidth_px,
                      static_cast<int>(rows) * (tile_height_ + kCaption_px), 3);
    std::fill_n(sheet_.data(), sheet_.size(), std::uint8_t{255});
  }

  /// Adds an image if it belongs to the sheet: the first, the last, and evenly between.
  void Offer(std::size_t index, const RgbImage& picture, const std::string& caption) {
    if (taken_ >= tiles_ || index != Wanted(taken_)) return;
    const int left = static_cast<int>(taken_ % kColumns) * kTileWidth_px;
    const int top = static_cast<int>(taken_ / kColumns) * (tile_height_ + kCaption_px);
    Paste(devices::ResizeRgb(picture.view(), kTileWidth_px, tile_height_), left, top, &sheet_);
    Paste(Caption(caption), left, top + tile_height_, &sheet_);
    ++taken_;
  }

  const RgbImage& sheet() const { return sheet_; }

 private:
  std::size_t Wanted(std::size_t tile) const {
    if (tiles_ < 2) return 0;
    return (tile * (pictures_ - 1) + (tiles_ - 1) / 2) / (tiles_ - 1);
  }

  std::size_t tiles_, pictures_;
  int tile_height_;
  std::size_t taken_ = 0;
  RgbImage sheet_;
};

/// "06:10" by a clock.
std::string ClockTime(UtcTime time, UtcOffset clock) {
  constexpr std::size_t kAfterDate = 11, kLength = 5;
  return FormatLocal(time, clock).substr(kAfterDate, kLength);
}

Result<std::vector<std::uint8_t>> Bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) return InputError(file.string(), "cannot be read", "check its permissions");
  return bytes;
}

}  // namespace

Result<std::vector<std::string>> WriteTimeLapse(const RendererAt& renderer_at,
                                                const TimeLapseMoments& moments,
                                                const Transform<Camera, Marker>& camera_from_marker,
                                                const fs::path& folder, bool pictures) {
  std::vector<std::string> written{kTimeLapseVideo, kTimeLapseSheet};
  LinearRgb brightest;
  PLEINAIR_ASSIGN_OR_RETURN(DayRenderer * renderer, renderer_at(moments.times.front()));
  for (const UtcTime time : moments.times) {
    const LinearRgb light = renderer->LevelLight(time);
    if (Luminance(light) > Luminance(brightest)) brightest = light;
  }
  if (pictures) {
    std::error_code error;
    fs::create_directories(folder / kTimeLapsePictures, error);
    if (error) return tl::make_unexpected(WriteError(folder / kTimeLapsePictures, error.value()));
  }
  std::unique_ptr<exports::VideoWriter> video;
  std::optional<ContactSheet> sheet;
  ProgressBar bar("Drawing the time-lapse", static_cast<std::int64_t>(moments.times.size()),
                  "pictures");
  for (std::size_t i = 0; i < moments.times.size(); ++i) {
    PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(""));
    const UtcTime time = moments.times[i];
    PLEINAIR_ASSIGN_OR_RETURN(renderer, renderer_at(time));
    PLEINAIR_ASSIGN_OR_RETURN(
        const RgbImage picture,
        renderer->Render(camera_from_marker, time,
                         ExposureScaleOfDay(renderer->LevelLight(time), brightest)));
    if (!video) {
      PLEINAIR_ASSIGN_OR_RETURN(
          video,
          exports::VideoWriter::Create(folder / kTimeLapseVideo,
                                       {picture.width(), picture.height(), kPicturesPerSecond}));
      sheet.emplace(moments.times.size(), static_cast<double>(picture.height()) / picture.width());
    }
    PLEINAIR_RETURN_IF_ERROR(video->Add(
        picture.view(), std::llround(static_cast<double>(i) * 1e9 / kPicturesPerSecond)));
    sheet->Offer(
        i, picture,
        moments.over_dates ? FormatLocalDate(time, moments.clock) : ClockTime(time, moments.clock));
    if (pictures) {
      const std::string name = fmt::format("{}/{:04}.png", kTimeLapsePictures, i);
      PLEINAIR_RETURN_IF_ERROR(exports::WritePng(folder / name, picture.view()));
      written.push_back(name);
    }
    bar.Advance();
  }
  PLEINAIR_RETURN_IF_ERROR(video->Finish());
  PLEINAIR_RETURN_IF_ERROR(exports::WritePng(folder / kTimeLapseSheet, sheet->sheet().view()));
  return written;
}

Result<std::string> TimeLapseHtml(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / kTimeLapseVideo, error) ||
      !fs::exists(folder / kTimeLapseSheet, error)) {
    return std::string();
  }
  PLEINAIR_ASSIGN_OR_RETURN(const auto video, Bytes(folder / kTimeLapseVideo));
  PLEINAIR_ASSIGN_OR_RETURN(const auto sheet, Bytes(folder / kTimeLapseSheet));
  return fmt::format(
      "<h2>The scene over time</h2>\n<p class=\"lead\">Rendered from the models alone, in the "
      "light estimated from the frames.</p>\n<video controls autoplay loop muted "
      "style=\"width:100%;border-radius:8px\" src=\"data:video/mp4;base64,{}\"></video>\n"
      "<figure><img alt=\"the time-lapse in pictures\" style=\"width:100%;border-radius:8px\" "
      "src=\"data:image/png;base64,{}\"><figcaption>the time-lapse in "
      "pictures</figcaption></figure>\n",
      files::Base64(video), files::Base64(sheet));
}

}  // namespace pleinair::app
