#include "app/output/composite_writer.h"

#include <fmt/format.h>

#include <utility>

#include "base/atomic_file.h"
#include "export/images/image_writer.h"

namespace pleinair::app {

CompositeWriter::CompositeWriter(std::filesystem::path pictures,
                                 std::unique_ptr<exports::VideoWriter> video)
    : pictures_(std::move(pictures)), video_(std::move(video)), thread_([this] { Run(); }) {}

CompositeWriter::~CompositeWriter() { End(); }

void CompositeWriter::End() {
  items_.Close();
  if (thread_.joinable()) thread_.join();
}

Result<void> CompositeWriter::Add(std::int64_t index, std::int64_t timestamp_ns, RgbImage composed,
                                  bool is_written) {
  if (items_.Give({index, timestamp_ns, std::move(composed), is_written})) return {};
  End();
  return result_;
}

Result<void> CompositeWriter::Finish() {
  End();
  PLEINAIR_RETURN_IF_ERROR(result_);
  if (!video_) return {};
  return times_.Measure("encode video", [&] { return video_->Finish(); });
}

void CompositeWriter::Run() {
  while (const std::optional<Item> item = items_.Take()) {
    result_ = Write(*item);
    if (result_) continue;
    items_.Close();
    return;
  }
}

Result<void> CompositeWriter::Write(const Item& item) {
  if (!pictures_.empty() && !item.is_written) {
    const std::filesystem::path file = pictures_ / fmt::format("{:04}.png", item.index);
    const std::filesystem::path partial = TemporarySibling(file);
    PLEINAIR_RETURN_IF_ERROR(times_.Measure("write picture", [&] {
      return exports::WritePng(partial, item.picture.view()).and_then([&] {
        return CommitFile(partial, file);
      });
    }));
  }
  if (!video_) return {};
  return times_.Measure("encode video",
                        [&] { return video_->Add(item.picture.view(), item.timestamp_ns); });
}

}  // namespace pleinair::app
