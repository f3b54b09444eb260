#include "app/project/film_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "app/calibrate/film_lens.h"
#include "app/replay/given_trajectory.h"
#include "app/terminal/interrupt.h"
#include "devices/calibration/fitted_camera.h"
#include "devices/images/image_file.h"
#include "devices/recordings/image_sequence.h"
#include "devices/recordings/video_file.h"
#include "files/text_file.h"
#include "session/light_frames.h"
#include "session/scene_marker.h"
#include "tracker/parallel_trackers.h"
#include "tracker/tracker.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxPhotoFileBytes = std::uintmax_t{256} << 20;
/// So many frames are in memory at once, and are searched in parallel.
constexpr std::size_t kLooksAtOnce = 4;

/// Frames of a file, before any lens is known.
struct LookedAtFile {
  std::unique_ptr<devices::FrameSource> frames;
  ImageSize size;
  int clockwise_deg = 0;  ///< By which a film is turned for display.
  devices::FilmTags tags;
  bool is_photo = false;
};

Result<LookedAtFile> OpenLookedAtFile(const fs::path& file) {
  LookedAtFile opened;
  opened.is_photo = devices::IsImageFile(file);
  if (!opened.is_photo) {
    PLEINAIR_ASSIGN_OR_RETURN(devices::OpenedVideo video, devices::OpenVideo(file, {}));
    opened.size = video.size;
    opened.clockwise_deg = video.facts.clockwise_deg;
    opened.tags = std::move(video.facts.tags);
    opened.frames = std::move(video.frames);
    return opened;
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::string bytes,
                            files::ReadWholeFile(file, kMaxPhotoFileBytes));
  PLEINAIR_ASSIGN_OR_RETURN(opened.size, devices::InspectImage(bytes, file.string()));
  opened.tags = devices::TagsOfPhoto(bytes);
  PLEINAIR_ASSIGN_OR_RETURN(opened.frames,
                            devices::OpenImageSequence({{file, 0, std::nullopt}}, opened.size));
  return opened;
}

/// The given lens, scaled and turned for the file, or the assumed one.
Result<KnownLens> LensFor(const LookedAtFile& opened, const FilmLook& look,
                          const LookOptions& options) {
  if (!options.lens) return AssumedLens(opened.size, look.tags, look.file.filename().string());
  auto fitted = devices::FitCamera(options.lens->camera, opened.size, opened.clockwise_deg,
                                   look.file.string());
  if (!fitted && options.lens->is_by_trajectory) {
    return tl::make_unexpected(
        OtherLensThanTrajectorys(std::move(fitted).error(), options.lens->from));
  }
  if (!fitted) return tl::make_unexpected(std::move(fitted).error());
  return KnownLens{fitted->camera, options.lens->from, std::move(fitted->note)};
}

std::size_t CountOfLooks(ImageSize size, bool is_marker_rare) {
  constexpr std::size_t kRareFactor = 8;
  constexpr double kPixels = 25e6, kFewest = 4.0, kMost = 12.0;
  const double each = std::max(1.0, static_cast<double>(size.width) * size.height);
  const auto looks = static_cast<std::size_t>(std::clamp(kPixels / each, kFewest, kMost));
  return is_marker_rare ? kRareFactor * looks : looks;
}

/// The frames with these indices, which ascend; fewer if the film ends before.
Result<std::vector<devices::Frame>> ReadFrames(devices::FrameSource& source,
                                               std::span<const std::size_t> indices) {
  std::vector<devices::Frame> frames;
  for (const std::size_t index : indices) {
    const auto wanted = static_cast<std::int64_t>(index);
    source.SkipTo(wanted);
    std::optional<devices::Frame> frame;
    do {
      PLEINAIR_ASSIGN_OR_RETURN(frame, source.Next());
    } while (frame && frame->index < wanted);
    if (!frame) break;
    frames.push_back(*std::move(frame));
  }
  return frames;
}

}  // namespace

KnownLens AssumedLens(ImageSize size, const devices::FilmTags& tags, const std::string& file) {
  constexpr double kPhone_mm = 26.0;  // Main cameras of phones have 23 to 28 mm.
  KnownLens lens;
  const double focal_mm = tags.focal_length_35mm.value_or(kPhone_mm);
  lens.from = tags.focal_length_35mm ? fmt::format(
                                           "the tags of {}: {:g} mm on 35 mm film; film is "
                                           "often cropped, so calibrate the lens",
                                           file, focal_mm)
                                     : fmt::format(
                                           "assumed: {:g} mm on 35 mm film, as of a usual "
                                           "phone; calibrate the lens",
                                           focal_mm);
  CameraModel& camera = lens.camera;
  camera.width = size.width;
  camera.height = size.height;
  camera.fx = camera.fy = FocalFrom35mm(focal_mm, size);
  camera.cx = 0.5 * (size.width - 1);
  camera.cy = 0.5 * (size.height - 1);
  return lens;
}

Result<FilmLook> ReadTags(const fs::path& file) {
  PLEINAIR_ASSIGN_OR_RETURN(LookedAtFile opened, OpenLookedAtFile(file));
  return FilmLook{file, opened.is_photo, std::move(opened.tags), {}, 0, {}};
}

std::vector<std::string> FamiliesToLookFor(const std::optional<std::string>& wanted) {
  if (wanted) return {*wanted};
  return {session::kSgFamily, "tag36h11"};
}

Result<FilmLook> LookAt(const fs::path& file, const LookOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(LookedAtFile opened, OpenLookedAtFile(file));
  FilmLook look{file, opened.is_photo, std::move(opened.tags), {}, 0, {}};
  PLEINAIR_ASSIGN_OR_RETURN(look.lens, LensFor(opened, look, options));
  const CameraModel& camera = look.lens.camera;
  tracker::TrackerOptions tracking;
  tracking.families = FamiliesToLookFor(options.family);
  tracking.marker_size_m = 1.0;
  PLEINAIR_ASSIGN_OR_RETURN(auto trackers,
                            tracker::ParallelTrackers::Create(camera, tracking, kLooksAtOnce));
  look.frames = opened.frames->FrameCount().value_or(1);
  const std::vector<std::size_t> indices = session::EvenlySpread(
      static_cast<std::size_t>(look.frames), CountOfLooks(opened.size, options.is_marker_rare));
  for (std::size_t first = 0; first < indices.size(); first += kLooksAtOnce) {
    PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(file.string()));
    const std::size_t count = std::min(kLooksAtOnce, indices.size() - first);
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<devices::Frame> frames,
                              ReadFrames(*opened.frames, std::span(indices).subspan(first, count)));
    std::vector<ImageView<const std::uint8_t>> greys;
    greys.reserve(frames.size());
    for (const devices::Frame& frame : frames) greys.push_back(frame.grey.view());
    PLEINAIR_ASSIGN_OR_RETURN(auto markers, trackers.Track(greys));
    for (std::size_t i = 0; i < frames.size(); ++i) {
      look.looked_at.push_back({frames[i].index, std::move(markers[i])});
    }
  }
  return look;
}

double EdgeOf(const tracker::MarkerDetection& marker) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    sum += Norm(marker.corners_px[i] - marker.corners_px[(i + 1) % 4]);
  }
  return sum / 4.0;
}

std::optional<ChosenMarker> ChooseMarker(const FilmLook& look,
                                         const std::optional<session::MarkerName>& wanted) {
  std::map<session::MarkerName, ChosenMarker> seen;
  std::map<session::MarkerName, double> best_score;
  for (const LookedAtFrame& frame : look.looked_at) {
    for (const tracker::MarkerObservation& marker : frame.markers) {
      const auto named = session::NameOfDetected(marker.detection);
      if (!named) continue;
      const session::MarkerName& name = *named;
      ChosenMarker& chosen = seen[name];
      chosen.name = name;
      ++chosen.frames;
      const double edge_px = EdgeOf(marker.detection);
      const double score = edge_px * marker.detection.visible_fraction;
      if (score <= best_score[name]) continue;
      best_score[name] = score;
      chosen.best_frame = frame.index;
      chosen.best_edge_px = edge_px;
    }
  }
  auto best = seen.end();
  for (auto at = seen.begin(); at != seen.end(); ++at) {
    if (wanted && at->first != *wanted) continue;
    if (best == seen.end() || at->second.frames > best->second.frames) best = at;
  }
  if (best == seen.end()) return std::nullopt;
  ChosenMarker chosen = best->second;
  chosen.looked_at = look.looked_at.size();
  for (const auto& [name, other] : seen) {
    if (name != chosen.name) chosen.others.push_back(name);
  }
  return chosen;
}

}  // namespace pleinair::app
