#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/atomic_file.h"
#include "devices/recordings/frame_pack.h"
#include "devices/recordings/frame_pack_format.h"

namespace pleinair::devices {
namespace {

/// zlib's lengths have 32 bits.
std::uint32_t Checksum(std::string_view facts, const std::uint8_t* image, std::size_t bytes) {
  uLong sum =
      crc32(0, reinterpret_cast<const Bytef*>(facts.data()), static_cast<uInt>(facts.size()));
  sum = crc32_z(sum, image, bytes);
  return static_cast<std::uint32_t>(sum);
}

/// Returns 0 or errno.
int WriteAll(int fd, const void* bytes, std::size_t count) {
  const auto* at = static_cast<const std::uint8_t*>(bytes);
  while (count > 0) {
    const ssize_t written = write(fd, at, count);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    if (written == 0) return ENOSPC;
    at += written;
    count -= static_cast<std::size_t>(written);
  }
  return 0;
}

}  // namespace

FramePackWriter::FramePackWriter(std::filesystem::path file, int fd)
    : file_(std::move(file)), fd_(fd) {}

FramePackWriter::~FramePackWriter() { close(fd_); }

Result<std::unique_ptr<FramePackWriter>> FramePackWriter::Create(
    const std::filesystem::path& file) {
  const int fd = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd < 0 && errno == EEXIST) {
    return InputError(file.string(), "is there already", "record into another folder");
  }
  if (fd < 0) return tl::make_unexpected(WriteError(file, errno));
  std::unique_ptr<FramePackWriter> writer(new FramePackWriter(file, fd));
  const int failed = WriteAll(fd, kFramePackStart.data(), kFramePackStart.size());
  if (failed != 0) return tl::make_unexpected(WriteError(file, failed));
  writer->size_ = static_cast<std::int64_t>(kFramePackStart.size());
  return writer;
}

Result<void> FramePackWriter::Fail(int error_number) {
  failed_ = true;
  // Removes the partial frame. Should even that fail, readers skip it.
  if (ftruncate(fd_, size_) != 0) return tl::make_unexpected(WriteError(file_, error_number));
  return tl::make_unexpected(WriteError(file_, error_number));
}

Result<void> FramePackWriter::Add(const Frame& frame) {
  if (failed_) return SystemError(file_.string(), "recording has ended before");
  RawImage layout;
  const std::uint8_t* image = frame.rgb.data();
  std::size_t image_bytes = frame.rgb.size();
  if (frame.raw) {
    layout = {frame.raw->format,
              frame.raw->width,
              frame.raw->height,
              frame.raw->stride,
              frame.raw->matrix,
              frame.raw->full_range,
              {}};
    image = frame.raw->bytes.data();
    image_bytes = frame.raw->bytes.size();
  } else {
    layout.format = PixelFormat::kRgb24;
    layout.width = frame.rgb.width();
    layout.height = frame.rgb.height();
    layout.stride = static_cast<std::size_t>(layout.width) * 3;
  }
  const std::string facts = FrameMetadataJson(frame, layout);
  const FrameRecordHead head{static_cast<std::uint32_t>(facts.size()), image_bytes,
                             Checksum(facts, image, image_bytes)};
  header_.clear();
  head.Append(&header_);
  header_ += facts;
  int failed = WriteAll(fd_, header_.data(), header_.size());
  if (failed == 0) failed = WriteAll(fd_, image, image_bytes);
  if (failed != 0) return Fail(failed);
  size_ += static_cast<std::int64_t>(header_.size() + image_bytes);
  ++frames_;
  return {};
}

Result<void> FramePackWriter::AddRecord(std::string_view record) {
  if (failed_) return SystemError(file_.string(), "recording has ended before");
  const int failed = WriteAll(fd_, record.data(), record.size());
  if (failed != 0) return Fail(failed);
  size_ += static_cast<std::int64_t>(record.size());
  ++frames_;
  return {};
}

Result<void> FramePackWriter::Sync() {
  if (fdatasync(fd_) != 0) return Fail(errno);
  return {};
}

}  // namespace pleinair::devices
