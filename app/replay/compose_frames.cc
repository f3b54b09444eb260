#include "app/replay/compose_frames.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "app/output/composite_writer.h"
#include "app/output/light_csv.h"
#include "app/replay/report_frames.h"
#include "app/terminal/pass_bar.h"
#include "base/atomic_file.h"
#include "devices/images/image_file.h"
#include "export/images/image_writer.h"
#include "export/images/video_writer.h"
#include "session/recording_passes.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr int kReportPictureWidth_px = 800;
constexpr int kReportJpegQuality = 85;

/// Opens the requested video; null: none.
Result<std::unique_ptr<exports::VideoWriter>> OpenVideo(
    const std::optional<devices::RecordedSound>& sound, ReplayState& state) {
  if (!state.write.video) return nullptr;
  ReplayReport& report = state.report;
  exports::VideoWriter::Options options{
      report.film.width, report.film.height, report.film.frame_rate_hz, report.film.curve, {}};
  if (sound) {
    constexpr double kSecond_ns = 1e9;
    options.sound = exports::CopiedSound{
        sound->film, sound->start_s + static_cast<double>(state.read.first_stamp_ns) / kSecond_ns};
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      auto video, exports::VideoWriter::Create(state.folder.staging() / "composite.mp4", options));
  if (!video->why_silent().empty()) report.warnings.push_back(video->why_silent());
  report.files.video_encoder = video->encoder_name();
  report.files.outputs.emplace_back("composite.mp4");
  if (report.film.width % 2 != 0 || report.film.height % 2 != 0) {
    report.warnings.emplace_back(
        "composite.mp4 repeats the last column or row: H.264 needs even sizes.");
  }
  return video;
}

/// Creates the folder of the composited frames; empty if none is needed.
Result<fs::path> MakeFrameFolder(ReplayState& state) {
  if (!state.write.frames && !state.write.is_resumable) return fs::path();
  PLEINAIR_RETURN_IF_ERROR(state.folder.MakeFolder("frames"));
  if (state.write.frames) state.report.files.outputs.emplace_back("frames/%04d.png");
  return state.folder.staging() / "frames";
}

/// A frame that an interrupted replay composed.
std::optional<RgbImage> EarlierFrame(const ReplayState& state, const fs::path& frames,
                                     std::int64_t index) {
  if (!state.write.is_resumable) return std::nullopt;
  const fs::path file = frames / fmt::format("{:04}.png", index);
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  Result<devices::DecodedImage> image = devices::DecodeImageFile(file);
  if (!image || image->rgb.width() != state.report.film.width ||
      image->rgb.height() != state.report.film.height) {
    return std::nullopt;
  }
  return std::move(image->rgb);
}

void AddPicture(const devices::Frame& frame, const RgbImage& composed, ReplayReport* report) {
  report->files.pictures.push_back(
      {frame.index,
       exports::EncodeJpeg(frame.rgb.view(), kReportPictureWidth_px, kReportJpegQuality),
       exports::EncodeJpeg(composed.view(), kReportPictureWidth_px, kReportJpegQuality)});
}

Result<void> WriteLight(ReplayState& state) {
  const std::vector<LightRow>& rows = state.report.light_changes.rows;
  if (rows.empty()) return {};
  state.report.files.outputs.emplace_back("light.csv");
  return WriteFileAtomically(state.folder.staging() / "light.csv", LightCsv(rows));
}

}  // namespace

Result<void> ComposeFrames(ReplayState& state) {
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, state.OpenRecording());
  PLEINAIR_ASSIGN_OR_RETURN(auto video, OpenVideo(recording.sound, state));
  PLEINAIR_ASSIGN_OR_RETURN(const fs::path frames, MakeFrameFolder(state));
  CompositeWriter writer(frames, std::move(video));
  std::set<std::int64_t> composed_before;
  const auto earlier = [&](std::int64_t index) {
    std::optional<RgbImage> image = EarlierFrame(state, frames, index);
    if (image) composed_before.insert(index);
    return image;
  };
  std::vector<std::pair<std::int64_t, std::int64_t>> frames_seen;
  std::vector<LightRow> rows;
  const std::set<std::int64_t> shown =
      ReportFrames(state.report.path, state.report.film.first_frame, state.report.film.frames);
  const auto take = [&](const devices::Frame& frame,
                        session::ComposedFrame composed) -> Result<void> {
    frames_seen.emplace_back(frame.index, frame.timestamp_ns);
    if (composed.light) {
      rows.push_back(LightRowOf(frame.index, frame.timestamp_ns, *composed.light));
      state.report.light = composed.light;
    }
    if (shown.contains(frame.index)) AddPicture(frame, composed.image, &state.report);
    return writer.Add(frame.index, frame.timestamp_ns, std::move(composed.image),
                      composed_before.contains(frame.index));
  };
  PassBar bar("Composing", state.report.call.recording);
  PLEINAIR_RETURN_IF_ERROR(session::ComposeFrames(*state.pipeline, std::move(recording), take,
                                                  {bar.Progress(), &state.times}, earlier));
  PLEINAIR_RETURN_IF_ERROR(writer.Finish());
  state.times.Add(writer.times());
  if (state.ink) state.report.scene.maps = state.ink->facts();
  state.report.light_changes.mode = state.options.light.changes;
  state.report.light_changes.rows = WithMissingFrames(rows, frames_seen);
  return WriteLight(state);
}

}  // namespace pleinair::app
