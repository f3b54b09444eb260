#include "app/live/recording_switch.h"

#include <system_error>
#include <utility>

#include "base/atomic_file.h"

namespace pleinair::app {

namespace fs = std::filesystem;

Result<void> RecordingSwitch::Start(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / "frames.pack", error)) {
    return InputError(folder.string(), "holds a recording already", "record into another folder");
  }
  Stop();
  const bool made = fs::create_directories(folder, error);
  if (error) return tl::make_unexpected(WriteError(folder, error.value()));
  const std::lock_guard lock(mutex_);
  folder_ = folder;
  made_folder_ = made;
  trouble_.reset();
  return {};
}

void RecordingSwitch::Stop() {
  std::shared_ptr<LiveRecorder> ended;
  std::optional<fs::path> folder;
  bool made_folder = false;
  {
    const std::lock_guard lock(mutex_);
    folder = std::exchange(folder_, std::nullopt);
    made_folder = made_folder_;
    ended = std::exchange(recorder_, nullptr);
  }
  if (!ended) {
    // fs::remove() deletes only an empty folder.
    std::error_code ignored;
    if (folder && made_folder) fs::remove(*folder, ignored);
    return;
  }
  // Write the queued frames without holding the lock.
  ended->Finish();
  const std::lock_guard lock(mutex_);
  of_ended_.recorded += ended->recorded();
  of_ended_.left_out += ended->left_out();
  if (!trouble_) trouble_ = ended->trouble();
}

bool RecordingSwitch::on() const {
  const std::lock_guard lock(mutex_);
  return folder_ && !trouble_ && !(recorder_ && recorder_->trouble());
}

void RecordingSwitch::Add(const std::shared_ptr<const devices::Frame>& frame, UtcTime moment,
                          const std::function<scene::SceneDescription()>& scene) {
  std::shared_ptr<LiveRecorder> recorder;
  std::optional<fs::path> folder;
  {
    const std::lock_guard lock(mutex_);
    if (!folder_ || trouble_) return;
    recorder = recorder_;
    folder = folder_;
  }
  if (!recorder) {
    auto made = LiveRecorder::Create(*folder, camera_, scene(), moment);
    const std::lock_guard lock(mutex_);
    if (!made) {
      // If the recording was stopped meanwhile, its folder may not exist any more.
      if (folder_ == folder) trouble_ = made.error();
      return;
    }
    recorder = *std::move(made);
    // If the recording was stopped meanwhile, this frame is the last one.
    if (folder_ == folder) recorder_ = recorder;
  }
  recorder->Add(frame);
}

RecordingSwitch::Counts RecordingSwitch::counts() const {
  const std::lock_guard lock(mutex_);
  Counts counts = of_ended_;
  if (recorder_) {
    counts.recorded += recorder_->recorded();
    counts.left_out += recorder_->left_out();
  }
  return counts;
}

std::optional<Error> RecordingSwitch::trouble() const {
  const std::lock_guard lock(mutex_);
  if (trouble_) return trouble_;
  return recorder_ ? recorder_->trouble() : std::nullopt;
}

}  // namespace pleinair::app
