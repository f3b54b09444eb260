#include "app/project/lens_of_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "app/calibrate/film_lens.h"
#include "app/calibrate/picture_stream.h"
#include "devices/recordings/video_file.h"
#include "session/light_frames.h"

namespace pleinair::app {
namespace {

/// Frames spread evenly over a film.
class SpreadPictures : public PictureStream {
 public:
  explicit SpreadPictures(devices::OpenedVideo video) : video_(std::move(video)) {
    constexpr double kPixels = 50e6, kFewest = 8.0, kMost = 24.0;
    const double each = std::max(1.0, static_cast<double>(video_.size.width) * video_.size.height);
    const auto count = static_cast<std::size_t>(video_.frames->FrameCount().value_or(1));
    indices_ = session::EvenlySpread(
        count, static_cast<std::size_t>(std::clamp(kPixels / each, kFewest, kMost)));
  }

  Result<std::optional<NamedPicture>> Next() override {
    if (next_ >= indices_.size()) return std::nullopt;
    const auto wanted = static_cast<std::int64_t>(indices_[next_++]);
    video_.frames->SkipTo(wanted);
    for (;;) {
      PLEINAIR_ASSIGN_OR_RETURN(std::optional<devices::Frame> frame, video_.frames->Next());
      if (!frame) return std::nullopt;
      if (frame->index < wanted) continue;
      return NamedPicture{fmt::format("frame {}", frame->index), std::move(frame->grey)};
    }
  }
  std::optional<std::int64_t> Count() const override {
    return static_cast<std::int64_t>(indices_.size());
  }
  bool is_film() const override { return false; }  // The frames lie far apart.
  std::optional<double> FocalLength35mm() const override {
    return video_.facts.tags.focal_length_35mm;
  }

 private:
  devices::OpenedVideo video_;
  std::vector<std::size_t> indices_;
  std::size_t next_ = 0;
};

}  // namespace

Result<std::optional<KnownLens>> LensOfFilm(const std::filesystem::path& film,
                                            const std::vector<std::string>& families) {
  PLEINAIR_ASSIGN_OR_RETURN(devices::OpenedVideo video, devices::OpenVideo(film, {}));
  SpreadPictures pictures(std::move(video));
  tracker::MarkerViewOptions views;
  views.families = families;
  auto lens = EstimateFilmLens(pictures, film.string(), views);
  if (!lens) {
    // LookAt() says what is wrong with frames that cannot be read.
    if (lens.error().kind == ErrorKind::kInput) return std::nullopt;
    return tl::make_unexpected(std::move(lens).error());
  }
  return KnownLens{lens->lens.camera, "estimated from the film: " + FilmLensSentence(*lens)};
}

}  // namespace pleinair::app
