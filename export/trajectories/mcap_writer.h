#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pleinair::exports {

/// Writes an MCAP file (mcap.dev, "MCAP Format Specification", version 0). Messages are in
/// uncompressed chunks, each with its checksum and index. A summary is at the end.
class McapWriter {
 public:
  McapWriter();

  /// Adds a channel of JSON messages and returns its id. `schema`: a JSON Schema, named
  /// `schema_name`.
  std::uint16_t AddChannel(std::string_view topic, std::string_view schema_name,
                           std::string_view schema);

  /// Adds a message. Messages of all channels must be in order of time.
  void AddMessage(std::uint16_t channel, std::uint64_t time_ns, std::string_view json);

  /// Returns the whole file. Nothing can be added afterwards.
  std::string Finish();

 private:
  struct ChunkIndex {
    std::uint64_t first_ns = 0, last_ns = 0, start = 0, length = 0, index_length = 0, size = 0;
    std::map<std::uint16_t, std::uint64_t> index_offsets;
  };

  void FinishChunk();

  std::string file_;
  std::string chunk_;
  std::uint64_t chunk_first_ns_ = 0, last_ns_ = 0, first_ns_ = 0;
  /// Messages of the current chunk by channel, as pairs of time and offset.
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> chunk_messages_;
  std::vector<std::string> schemas_, channels_;
  std::vector<ChunkIndex> chunks_;
  std::map<std::uint16_t, std::uint64_t> message_counts_;
};

}  // namespace pleinair::exports
