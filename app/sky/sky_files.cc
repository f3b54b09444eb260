#include "app/sky/sky_files.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "app/terminal/interrupt.h"
#include "app/terminal/progress_bar.h"
#include "base/atomic_file.h"
#include "export/images/image_writer.h"
#include "export/images/light_writer.h"
#include "export/images/video_writer.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

/// Errors name the requested file, not the temporary one.
Error Renamed(Error error, const std::string& file) {
  error.where = file;
  return error;
}

Result<void> WriteScreenPicture(const LightImage& light, SkyExposure exposure,
                                const std::string& file) {
  const fs::path temporary = TemporarySibling(file);
  const Result<void> written = exports::WritePng(temporary, ToneMap(light, exposure).view());
  if (!written) return tl::make_unexpected(Renamed(written.error(), file));
  return CommitFile(temporary, file);
}

exports::LightFileFacts FactsOf(const SkyFileOptions& options) {
  exports::LightFileFacts facts;
  facts.white_cd_m2 = 1.0 / options.scale;
  facts.latitude_longitude = options.picture.projection == SkyProjection::kLatLong;
  facts.comment =
      facts.latitude_longitude
          ? fmt::format(
                "Azimuth clockwise from true north: column u (0 to 1) looks to {:g} + 360 "
                "(u - 1/2) degrees; row v (0 top) to the elevation 90 - 180 v.",
                options.picture.centre_azimuth_deg)
          : "Equidistant fisheye from below: zenith in the centre, north up, east left.";
  return facts;
}

}  // namespace

Result<SkyFileKind> SkyFileKindOf(const std::string& name) {
  const std::string ending = fs::path(name).extension().string();
  if (ending == ".png") return SkyFileKind::kPng;
  if (ending == ".exr") return SkyFileKind::kExr;
  if (ending == ".hdr") return SkyFileKind::kHdr;
  if (ending == ".mp4") return SkyFileKind::kMp4;
  return InputError(name, "is not a supported picture format",
                    "name a file that ends in .png, .exr, .hdr or .mp4");
}

SkyExposure ExposureFor(const SkyFileOptions& options, const SkyLight& light) {
  return options.exposure.value_or(AutomaticExposure(Lux(light.sky_horizontal_lx)));
}

Result<void> WriteSkyPicture(const sky::SkyModel& sky, const SkyLight& light,
                             const SkyFileOptions& options) {
  LightImage picture = DrawSky(sky, options.picture);
  if (options.kind == SkyFileKind::kPng) {
    return WriteScreenPicture(picture, ExposureFor(options, light), options.file);
  }
  for (std::size_t i = 0; i < picture.size(); ++i) {
    picture.data()[i] *= static_cast<float>(options.scale);
  }
  return options.kind == SkyFileKind::kExr
             ? exports::WriteExr(options.file, picture.view(), FactsOf(options))
             : exports::WriteRadianceHdr(options.file, picture.view());
}

Result<void> WriteSkyVideo(const SkyAt& sky_at, const std::vector<SkyMoment>& moments,
                           const SkyFileOptions& options) {
  const InterruptGuard guard;
  const fs::path temporary = TemporarySibling(options.file);
  const auto give_up = [&](Error error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    return tl::make_unexpected(Renamed(std::move(error), options.file));
  };
  const int height = options.picture.projection == SkyProjection::kFisheye
                         ? options.picture.width_px
                         : options.picture.width_px / 2;
  auto video = exports::VideoWriter::Create(
      temporary, {options.picture.width_px, height, options.frames_per_second});
  if (!video) return give_up(video.error());
  {
    ProgressBar bar("sky", static_cast<std::int64_t>(moments.size()));
    for (std::size_t i = 0; i < moments.size(); ++i) {
      if (InterruptGuard::Interrupted()) {
        return give_up(Error{ErrorKind::kSystem, {}, "interrupted", "nothing was written"});
      }
      const auto sky = sky_at(moments[i]);
      const SkyLight light = MeasureSky(*sky, moments[i]);
      const RgbImage frame = ToneMap(DrawSky(*sky, options.picture), ExposureFor(options, light));
      const auto stamp_ns = static_cast<std::int64_t>(
          std::llround(static_cast<double>(i) * 1e9 / options.frames_per_second));
      if (const auto added = (*video)->Add(frame.view(), stamp_ns); !added) {
        return give_up(added.error());
      }
      bar.Advance();
    }
  }
  if (const auto finished = (*video)->Finish(); !finished) return give_up(finished.error());
  return CommitFile(temporary, options.file);
}

}  // namespace pleinair::app
