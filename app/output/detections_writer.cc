#include "app/output/detections_writer.h"

#include <fmt/format.h>

#include <cerrno>
#include <string>

#include "app/output/pose_json.h"
#include "base/atomic_file.h"

namespace pleinair::app {

Result<DetectionsWriter> DetectionsWriter::Create(const std::filesystem::path& file) {
  DetectionsWriter writer;
  writer.file_ = file;
  writer.out_.reset(std::fopen(file.c_str(), "wb"));
  if (!writer.out_) return tl::make_unexpected(WriteError(file, errno));
  return writer;
}

std::string DetectionsWriter::Line(std::int64_t frame_index, std::int64_t timestamp_ns,
                                   const std::vector<tracker::MarkerObservation>& observations,
                                   const std::vector<tracker::LostMarker>& lost) {
  return fmt::format("{{\"frame\":{},\"timestamp_s\":{:.9g},\"markers\":{},\"lost\":{}}}",
                     frame_index, static_cast<double>(timestamp_ns) * 1e-9,
                     MarkersJson(observations), LostJson(lost));
}

Result<void> DetectionsWriter::Add(const std::string& line) {
  if (std::fwrite(line.data(), 1, line.size(), out_.get()) != line.size() ||
      std::fputc('\n', out_.get()) == EOF) {
    return tl::make_unexpected(WriteError(file_, errno));
  }
  return {};
}

Result<void> DetectionsWriter::Finish() {
  if (std::fclose(out_.release()) != 0) return tl::make_unexpected(WriteError(file_, errno));
  return {};
}

}  // namespace pleinair::app
