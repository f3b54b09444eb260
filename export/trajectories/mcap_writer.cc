#include "export/trajectories/mcap_writer.h"

#include <zlib.h>

#include <algorithm>

#include "base/little_endian.h"

namespace pleinair::exports {
namespace {

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
constexpr std::size_t kChunkBytes = std::size_t{1} << 20;

enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// The content of one record, field by field, little-endian.
class Record {
 public:
  template <typename T>
  Record& Add(T value) {
    PutLittleEndian(value, &bytes_);
    return *this;
  }
  /// Preceded by its length.
  Record& AddText(std::string_view text) {
    Add(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
    return *this;
  }
  Record& AddBytes(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

  /// Preceded by opcode and length.
  std::string Finished(Opcode opcode) const {
    Record record;
    record.Add(static_cast<std::uint8_t>(opcode)).Add(static_cast<std::uint64_t>(bytes_.size()));
    return record.bytes_ + bytes_;
  }

 private:
  std::string bytes_;
};

std::uint32_t Checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// "Map<uint16, uint64>" or "Array<Tuple<Timestamp, uint64>>": the length in bytes, then the pairs.
template <typename Pairs, typename First>
std::string PairsText(const Pairs& pairs) {
  Record inner;
  for (const auto& [first, second] : pairs) {
    inner.Add(static_cast<First>(first)).Add(static_cast<std::uint64_t>(second));
  }
  return Record().AddText(inner.bytes()).bytes();
}

}  // namespace

McapWriter::McapWriter() {
  file_ = kMagic;
  file_ += Record().AddText("").AddText("pleinair " PLEINAIR_VERSION).Finished(kHeader);
}

std::uint16_t McapWriter::AddChannel(std::string_view topic, std::string_view schema_name,
                                     std::string_view schema) {
  // Ids of schemas start at 1; 0 means none.
  const auto schema_id = static_cast<std::uint16_t>(schemas_.size() + 1);
  schemas_.push_back(Record()
                         .Add(schema_id)
                         .AddText(schema_name)
                         .AddText("jsonschema")
                         .AddText(schema)
                         .Finished(kSchema));
  const auto channel_id = static_cast<std::uint16_t>(channels_.size());
  channels_.push_back(Record()
                          .Add(channel_id)
                          .Add(schema_id)
                          .AddText(topic)
                          .AddText("json")
                          .AddText("")  // No metadata.
                          .Finished(kChannel));
  chunk_ += schemas_.back() + channels_.back();
  return channel_id;
}

void McapWriter::AddMessage(std::uint16_t channel, std::uint64_t time_ns, std::string_view json) {
  if (message_counts_.empty()) first_ns_ = time_ns;
  if (chunk_messages_.empty()) chunk_first_ns_ = time_ns;
  last_ns_ = std::max(last_ns_, time_ns);
  const std::uint64_t sequence = message_counts_[channel]++;
  chunk_messages_[channel].emplace_back(time_ns, chunk_.size());
  chunk_ += Record()
                .Add(channel)
                .Add(static_cast<std::uint32_t>(sequence))
                .Add(time_ns)
                .Add(time_ns)
                .AddBytes(json)
                .Finished(kMessage);
  if (chunk_.size() >= kChunkBytes) FinishChunk();
}

void McapWriter::FinishChunk() {
  if (chunk_.empty()) return;
  ChunkIndex index;
  index.first_ns = chunk_messages_.empty() ? 0 : chunk_first_ns_;
  index.last_ns = chunk_messages_.empty() ? 0 : last_ns_;
  index.start = file_.size();
  index.size = chunk_.size();
  file_ += Record()
               .Add(index.first_ns)
               .Add(index.last_ns)
               .Add(index.size)
               .Add(Checksum(chunk_))
               .AddText("")  // No compression.
               .Add(index.size)
               .AddBytes(chunk_)
               .Finished(kChunk);
  index.length = file_.size() - index.start;
  const std::size_t indexes = file_.size();
  for (const auto& [channel, messages] : chunk_messages_) {
    index.index_offsets[channel] = file_.size();
    file_ += Record()
                 .Add(channel)
                 .AddBytes(PairsText<decltype(messages), std::uint64_t>(messages))
                 .Finished(kMessageIndex);
  }
  index.index_length = file_.size() - indexes;
  chunks_.push_back(std::move(index));
  chunk_.clear();
  chunk_messages_.clear();
}

std::string McapWriter::Finish() {
  FinishChunk();
  file_ += Record().Add(Checksum(file_)).Finished(kDataEnd);
  const std::size_t summary = file_.size();
  std::string offsets;
  const auto add_group = [&](Opcode opcode, const std::vector<std::string>& records) {
    const std::size_t start = file_.size();
    for (const std::string& record : records) file_ += record;
    if (records.empty()) return;
    offsets += Record()
                   .Add(static_cast<std::uint8_t>(opcode))
                   .Add(start)
                   .Add(file_.size() - start)
                   .Finished(kSummaryOffset);
  };
  add_group(kSchema, schemas_);
  add_group(kChannel, channels_);
  std::uint64_t messages = 0;
  for (const auto& [channel, count] : message_counts_) messages += count;
  add_group(kStatistics,
            {Record()
                 .Add(messages)
                 .Add(static_cast<std::uint16_t>(schemas_.size()))
                 .Add(static_cast<std::uint32_t>(channels_.size()))
                 .Add(std::uint32_t{0})  // Attachments.
                 .Add(std::uint32_t{0})  // Metadata.
                 .Add(static_cast<std::uint32_t>(chunks_.size()))
                 .Add(first_ns_)
                 .Add(last_ns_)
                 .AddBytes(PairsText<decltype(message_counts_), std::uint16_t>(message_counts_))
                 .Finished(kStatistics)});
  std::vector<std::string> indexes;
  for (const ChunkIndex& chunk : chunks_) {
    indexes.push_back(
        Record()
            .Add(chunk.first_ns)
            .Add(chunk.last_ns)
            .Add(chunk.start)
            .Add(chunk.length)
            .AddBytes(PairsText<decltype(chunk.index_offsets), std::uint16_t>(chunk.index_offsets))
            .Add(chunk.index_length)
            .AddText("")
            .Add(chunk.size)
            .Add(chunk.size)
            .Finished(kChunkIndex));
  }
  add_group(kChunkIndex, indexes);
  const std::size_t offsets_start = file_.size();
  file_ += offsets;
  // The checksum covers the summary and the footer up to itself.
  Record footer;
  footer.Add(static_cast<std::uint8_t>(kFooter)).Add(std::uint64_t{8 + 8 + 4});
  footer.Add(summary).Add(offsets_start);
  file_ += footer.bytes();
  const std::uint32_t sum = Checksum(std::string_view(file_).substr(summary));
  file_ += Record().Add(sum).bytes();
  file_ += kMagic;
  return std::move(file_);
}

}  // namespace pleinair::exports
