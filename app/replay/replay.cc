#include "app/replay/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "app/options/light_options.h"
#include "app/output/composite_writer.h"
#include "app/output/observed_trajectory.h"
#include "app/output/output_folder.h"
#include "app/output/trajectory_export.h"
#include "app/replay/frame_choice.h"
#include "app/replay/replay_warnings.h"
#include "app/replay/report/report_html.h"
#include "app/replay/report/report_json.h"
#include "app/replay/time_lapse/time_lapse.h"
#include "app/replay/track_recording.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress_bar.h"
#include "base/atomic_file.h"
#include "devices/recordings/recording.h"
#include "export/images/image_writer.h"
#include "export/images/video_writer.h"
#include "export/trajectories/trajectory_files.h"
#include "session/frame_prefetch.h"
#include "session/scene_marker.h"
#include "session/scene_renderer.h"
#include "tracker/tracker.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr int kReportPictureWidth_px = 800;
constexpr int kReportJpegQuality = 85;

/// One replay from opening to report; its members are what the two passes share.
class Replayer {
 public:
  Replayer(const ReplayOptions& options, OutputFolder folder)
      : options_(options), folder_(std::move(folder)) {}

  Result<ReplayReport> Run() {
    auto report = RunPasses();
    if (!report) return tl::make_unexpected(folder_.InTermsOfTarget(report.error()));
    return report;
  }

 private:
  Result<ReplayReport> RunPasses() {
    PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, OpenRecording());
    if (!recording.scene) {
      return InputError(options_.recording.string(), "has no scene",
                        "write one (docs/guide/reference/recordings.md) and give it with --scene");
    }
    scene_ = session::WithGiven(*recording.scene, options_.light);
    report_.recording = options_.recording.string();
    report_.command = options_.command;
    report_.version = PLEINAIR_VERSION;
    report_.scene_file = scene_.file.string();
    report_.place_time = scene_.place_time;
    report_.cloudiness = scene_.cloudiness;
    report_.virtual_objects = scene_.objects.size();
    report_.phantoms = scene_.phantoms.size();
    report_.frame_rate_hz = recording.frame_rate_hz;
    const ImageSize size =
        options_.size.value_or(ImageSize{recording.camera.width, recording.camera.height});
    report_.width = size.width;
    report_.height = size.height;
    output_camera_ = ScaleCamera(recording.camera, size);
    if (options_.time_lapse) {
      PLEINAIR_ASSIGN_OR_RETURN(day_moments_, MomentsOf(*options_.time_lapse, scene_.place_time));
    }
    PLEINAIR_RETURN_IF_ERROR(CheckFrameOfDay(*recording.frames));
    PLEINAIR_RETURN_IF_ERROR(CheckExports(options_.exports, output_camera_));
    PLEINAIR_ASSIGN_OR_RETURN(const tracker::TrackerOptions tracking, session::TrackingOf(scene_));
    auto tracker = tracker::Tracker::Create(recording.camera, tracking);
    if (!tracker) {
      // What it refuses is what the scene says of the marker.
      Error error = std::move(tracker).error();
      if (error.where.empty()) error.where = scene_.file.string();
      return tl::make_unexpected(std::move(error));
    }
    PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(report_.recording));
    // Models are loaded before a long search for markers begins: their errors come at once.
    PLEINAIR_ASSIGN_OR_RETURN(
        renderer_,
        session::SceneRenderer::Create(output_camera_, scene_, options_.composer, options_.light));
    PLEINAIR_RETURN_IF_ERROR(SeekMarkers(std::move(recording), **tracker));
    PLEINAIR_RETURN_IF_ERROR(ChooseReferenceMarker());
    PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(report_.recording));
    PLEINAIR_RETURN_IF_ERROR(ObserveLight());
    PLEINAIR_RETURN_IF_ERROR(TraceLight());
    PLEINAIR_ASSIGN_OR_RETURN(recording, OpenRecording());
    PLEINAIR_RETURN_IF_ERROR(ComposeFrames(std::move(recording.frames)));
    PLEINAIR_RETURN_IF_ERROR(DrawDay());
    PLEINAIR_RETURN_IF_ERROR(WriteReports());
    PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(report_.recording));
    PLEINAIR_RETURN_IF_ERROR(folder_.Commit());
    return std::move(report_);
  }

  Result<devices::Recording> OpenRecording() const {
    return devices::OpenRecording(options_.recording, {options_.calibration, options_.scene});
  }

  Result<void> SeekMarkers(devices::Recording recording, tracker::Tracker& tracker) {
    const TrackRecordingOptions search{report_.recording, scene_,
                                       folder_.staging() / "detections.jsonl",
                                       options_.exports.contains(exports::TrajectoryFormat::kMcap)};
    PLEINAIR_ASSIGN_OR_RETURN(found_,
                              TrackRecording(search, std::move(recording), tracker, &times_));
    report_.outputs.emplace_back("detections.jsonl");
    report_.frames = found_->marker_tracks.frames();
    return {};
  }

  Result<void> ChooseReferenceMarker() {
    report_.reference_marker = found_->marker_tracks.ReferenceMarker();
    if (report_.reference_marker) {
      report_.path = found_->marker_tracks.TrackOf(*report_.reference_marker);
      renderer_->SetMarkerReflectance(
          session::MarkerReflectanceOf(scene_.marker, *report_.reference_marker));
    }
    PLEINAIR_RETURN_IF_ERROR(folder_.MakeFolder("poses"));
    for (const auto& [marker, observed] : found_->marker_tracks.tracks()) {
      report_.markers.push_back(marker);
      PLEINAIR_ASSIGN_OR_RETURN(const std::vector<std::string> written,
                                WriteMarkerTrajectory(marker, ObservedTrajectory(observed),
                                                      options_.exports, folder_.staging()));
      report_.outputs.insert(report_.outputs.end(), written.begin(), written.end());
    }
    exports::CameraTrajectory path = ObservedTrajectory(report_.path);
    path.camera = output_camera_;
    PLEINAIR_ASSIGN_OR_RETURN(
        const std::vector<std::string> exported,
        ExportTrajectory({std::move(path), scene_, std::exchange(found_->messages, {})},
                         options_.exports, folder_.staging()));
    report_.outputs.insert(report_.outputs.end(), exported.begin(), exported.end());
    if (options_.time_lapse && DrawsDay()) PLEINAIR_RETURN_IF_ERROR(ViewOfDay());
    Warn();
    pictured_ = ReportFrames(report_.path, report_.frames);
    return {};
  }

  Result<void> ObserveLight() {
    const std::vector<std::size_t> chosen = LightFrames(report_.path);
    if (chosen.empty() || !renderer_->CanMeasureLight()) return {};
    PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, OpenRecording());
    ProgressBar bar("Reading the light", static_cast<std::int64_t>(chosen.size()));
    for (auto next = chosen.begin(); next != chosen.end();) {
      const session::Observation& at = report_.path[*next];
      recording.frames->SkipTo(at.frame_index);
      PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(report_.recording));
      PLEINAIR_ASSIGN_OR_RETURN(std::optional<devices::Frame> frame,
                                times_.Measure("read", [&] { return recording.frames->Next(); }));
      if (!frame) break;
      if (frame->index != at.frame_index) continue;
      ++next;
      Resize(*frame);
      times_.Measure("look at light", [&] {
        renderer_->ObserveLight(frame->rgb.view(), at.camera_from_marker, MomentOf(*frame));
        return 0;
      });
      bar.Advance();
    }
    times_.Measure("settle light", [&] {
      renderer_->EstimateLight();
      return 0;
    });
    return {};
  }

  std::shared_ptr<const compositor::DaylightCoefficients> TraceCoefficients() {
    constexpr int kSteps = 100;
    ProgressBar bar("Tracing light", kSteps, "%");
    int done = 0;
    return renderer_->Coefficients([&](double share) {
      for (; done < static_cast<int>(share * kSteps); ++done) bar.Advance();
    });
  }

  /// Before frames are composed, so that it has a bar of its own.
  Result<void> TraceLight() {
    if (report_.path.empty() || scene_.objects.empty()) return {};
    if (!options_.light.cache.empty()) {
      times_.Measure("trace light", [&] { return TraceCoefficients() != nullptr; });
    }
    const ProgressBar bar("Tracing light", 1, "sun");
    return times_.Measure("light",
                          [&] { return renderer_->PrepareLight(MomentOf(report_.path.front())); });
  }

  void Resize(devices::Frame& frame) {
    if (frame.rgb.width() == report_.width && frame.rgb.height() == report_.height) return;
    frame.rgb = times_.Measure("resize", [&] {
      return exports::ResizeRgb(frame.rgb.view(), report_.width, report_.height);
    });
  }

  template <typename Timed>
  UtcTime MomentOf(const Timed& frame) const {
    return UtcTime(scene_.place_time.start.nanoseconds_since_1970() + frame.timestamp_ns);
  }

  void Warn() {
    report_.warnings = MarkerWarnings(report_, found_->marker_tracks, scene_);
    for (std::string& sentence : found_->warnings.Sentences()) {
      report_.warnings.push_back(std::move(sentence));
    }
    if (found_->lost_frames > 0) {
      report_.warnings.push_back(
          fmt::format("{} frames were lost when this was recorded.", found_->lost_frames));
    }
    for (std::string& sentence : ModelWarnings(renderer_->placed())) {
      report_.warnings.push_back(std::move(sentence));
    }
    for (std::string& sentence : DrawingWarnings(renderer_->samples())) {
      report_.warnings.push_back(std::move(sentence));
    }
    if (scene_.objects.empty()) {
      report_.warnings.emplace_back("The scene has no virtual object: the frames are unchanged.");
    } else if (scene_.phantoms.empty()) {
      report_.warnings.emplace_back(
          "The scene has no phantom: the objects cast no shadow on real surfaces.");
    }
  }

  Result<void> ComposeFrames(std::unique_ptr<devices::FrameSource> source) {
    std::unique_ptr<exports::VideoWriter> video;
    fs::path pictures;
    if (options_.write_video) {
      PLEINAIR_ASSIGN_OR_RETURN(video, exports::VideoWriter::Create(
                                           folder_.staging() / "composite.mp4",
                                           {report_.width, report_.height, report_.frame_rate_hz}));
      report_.video_encoder = video->encoder_name();
      report_.outputs.emplace_back("composite.mp4");
      if (report_.width % 2 != 0 || report_.height % 2 != 0) {
        report_.warnings.emplace_back(
            "composite.mp4 repeats the last column or row: H.264 needs even sizes.");
      }
    }
    if (options_.write_frames) {
      PLEINAIR_RETURN_IF_ERROR(folder_.MakeFolder("frames"));
      pictures = folder_.staging() / "frames";
      report_.outputs.emplace_back("frames/%04d.png");
    }
    session::FramePrefetcher frames(std::move(source));
    CompositeWriter writer(std::move(pictures), std::move(video));
    auto pose = report_.path.begin();
    ProgressBar bar("Composing", report_.frames);
    for (std::int64_t count = 0;; ++count) {
      PLEINAIR_ASSIGN_OR_RETURN(std::optional<devices::Frame> frame,
                                NextFrame(report_.recording, frames));
      if (!frame && count != report_.frames) {
        return InputError(options_.recording.string(), "changed while it was being replayed",
                          "replay it again when nothing writes to it");
      }
      if (!frame) break;
      Resize(*frame);
      while (pose != report_.path.end() && pose->frame_index < frame->index) ++pose;
      std::optional<RgbImage> composed;
      if (pose != report_.path.end() && pose->frame_index == frame->index) {
        PLEINAIR_ASSIGN_OR_RETURN(composed, Render(*frame, *pose));
      }
      if (pictured_.contains(frame->index)) {
        Picture(*frame, composed ? composed->view() : frame->rgb.view());
      }
      PLEINAIR_RETURN_IF_ERROR(writer.Add(frame->index, frame->timestamp_ns,
                                          composed ? *std::move(composed) : std::move(frame->rgb)));
      bar.Advance();
    }
    PLEINAIR_RETURN_IF_ERROR(writer.Finish());
    times_.Add(frames.Finish());
    times_.Add(writer.times());
    return {};
  }

  Result<RgbImage> Render(const devices::Frame& frame, const session::Observation& seen) {
    compositor::MarkerVisibility cover;
    if (options_.light.hands_in_front)
      cover = session::VisibilityOf(scene_.marker, *report_.reference_marker, seen);
    auto composed =
        renderer_->Render(frame.rgb.view(), seen.camera_from_marker, MomentOf(frame), cover);
    if (scene_.objects.empty()) return composed;
    const session::RenderTimes& times = renderer_->times();
    if (times.light_ms > 1.0) times_.Add("light", times.light_ms);
    times_.Add("meter", times.meter_ms);
    times_.Add("compose", times.compose_ms);
    report_.light = renderer_->light();
    return composed;
  }

  void Picture(const devices::Frame& frame, ImageView<const std::uint8_t> composed) {
    report_.pictures.push_back(
        {frame.index,
         exports::EncodeJpeg(frame.rgb.view(), kReportPictureWidth_px, kReportJpegQuality),
         exports::EncodeJpeg(composed, kReportPictureWidth_px, kReportJpegQuality)});
  }

  /// Whether the recording has the frame that the time-lapse is to be seen from, where it is known
  /// how many it has.
  Result<void> CheckFrameOfDay(const devices::FrameSource& source) const {
    if (!options_.time_lapse || !options_.time_lapse->frame || !source.CountsExactly()) return {};
    const std::int64_t frame = *options_.time_lapse->frame;
    const std::optional<std::int64_t> frames = source.FrameCount();
    if (!frames || frame < *frames) return {};
    return InputError(
        "--time-lapse-frame",
        fmt::format("frame {} lies beyond the recording's {}", frame, *frames),
        *frames > 0 ? fmt::format("name one of 0 to {}", *frames - 1) : "leave it out");
  }

  bool DrawsDay() const { return !report_.path.empty() && !scene_.objects.empty(); }

  /// The observation whose camera the time-lapse looks through.
  Result<session::Observation> ViewOfDay() const {
    const auto& path = report_.path;
    if (!options_.time_lapse->frame) return path[path.size() / 2];
    for (const session::Observation& at : path) {
      if (at.frame_index == *options_.time_lapse->frame) return at;
    }
    return InputError("--time-lapse-frame",
                      fmt::format("frame {} has no pose", *options_.time_lapse->frame),
                      "name another, or leave it out for the middle one");
  }

  Result<void> DrawDay() {
    if (!options_.time_lapse) return {};
    if (!DrawsDay()) {
      report_.warnings.emplace_back(
          "There is no time-lapse: it needs a virtual object and a frame with a pose.");
      return {};
    }
    PLEINAIR_ASSIGN_OR_RETURN(const session::Observation view, ViewOfDay());
    session::LightingRequest request = renderer_->MakeLightingRequest(scene_.place_time.start);
    request.coefficients = TraceCoefficients();
    PLEINAIR_ASSIGN_OR_RETURN(
        const auto day, DayRenderer::Create(output_camera_, renderer_->placed(), std::move(request),
                                            options_.composer));
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<std::string> written,
                              times_.Measure("draw day", [&] {
                                return WriteTimeLapse(*day, day_moments_, view.camera_from_marker,
                                                      folder_.staging(), options_.write_frames);
                              }));
    report_.outputs.insert(report_.outputs.end(), written.begin(), written.end());
    PLEINAIR_ASSIGN_OR_RETURN(report_.time_lapse, TimeLapseHtml(folder_.staging()));
    return {};
  }

  Result<void> WriteReports() {
    if (renderer_->FailedToKeepLight()) {
      report_.warnings.push_back(CouldNotKeepLight(options_.light.cache));
    }
    if (report_.light) {
      for (std::string& sentence : LightWarnings(*report_.light)) {
        report_.warnings.push_back(std::move(sentence));
      }
    }
    report_.outputs.emplace_back("report.json");
    report_.outputs.emplace_back("report.html");
    std::sort(report_.outputs.begin(), report_.outputs.end());
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - begun_;
    times_.Add(kWholeReplay, taken.count());
    report_.timings = times_.Summarize();
    PLEINAIR_RETURN_IF_ERROR(
        WriteFileAtomically(folder_.staging() / "report.json", ReportJson(report_)));
    return WriteFileAtomically(folder_.staging() / "report.html", ReportHtml(report_));
  }

  const ReplayOptions& options_;
  OutputFolder folder_;
  scene::SceneDescription scene_;
  CameraModel output_camera_;
  std::unique_ptr<session::SceneRenderer> renderer_;
  std::optional<RecordingTracks> found_;
  std::set<std::int64_t> pictured_;
  TimeLapseMoments day_moments_;
  const std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  StageTimes times_;
  ReplayReport report_;
};

/// Outputs must not replace what is being read.
Result<void> CheckOutputIsApart(const ReplayOptions& options) {
  std::error_code error;
  const bool same = fs::equivalent(options.output, options.recording, error) ||
                    fs::equivalent(options.output / "composite.mp4", options.recording, error);
  if (!same) return {};
  return InputError(options.output.string(), "is the recording itself",
                    "name another folder with -o");
}

}  // namespace

Result<ReplayReport> Replay(const ReplayOptions& options) {
  PLEINAIR_RETURN_IF_ERROR(CheckOutputIsApart(options));
  // Looked at before anything is made: a wrong name should not touch the disk.
  std::error_code error;
  if (!fs::exists(options.recording, error)) {
    return InputError(options.recording.string(), "does not exist", "check the name");
  }
  PLEINAIR_RETURN_IF_ERROR(CheckLightCache(options.light.cache));
  const InterruptGuard guard;
  PLEINAIR_ASSIGN_OR_RETURN(OutputFolder folder, OutputFolder::Create(options.output));
  return Replayer(options, std::move(folder)).Run();
}

}  // namespace pleinair::app
