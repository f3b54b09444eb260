#include "devices/recordings/frame_pack_format.h"

#include <nlohmann/json.hpp>

#include "base/little_endian.h"

namespace pleinair::devices {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kMeanings[] = {"unknown", "exposure start", "exposure end", "arrival"};

template <typename T>
void Set(Json* json, const char* key, const std::optional<T>& value) {
  if (value) (*json)[key] = *value;
}

template <typename T>
std::optional<T> Optional(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end()) return std::nullopt;
  return found->get<T>();
}

}  // namespace

void FrameRecordHead::Append(std::string* bytes) const {
  *bytes += kMagic;
  PutLittleEndian(metadata_bytes, bytes);
  PutLittleEndian(image_bytes, bytes);
  PutLittleEndian(checksum, bytes);
  PutLittleEndian(std::uint32_t{0}, bytes);  // Unused.
}

std::optional<FrameRecordHead> FrameRecordHead::Decode(std::string_view bytes) {
  LittleEndianReader reader(bytes);
  const std::string_view magic = reader.Take(kMagic.size());
  FrameRecordHead head;
  head.metadata_bytes = reader.Get<std::uint32_t>();
  head.image_bytes = reader.Get<std::uint64_t>();
  head.checksum = reader.Get<std::uint32_t>();
  if (magic != kMagic || head.metadata_bytes < kMinMetadataBytes ||
      head.metadata_bytes > kMaxMetadataBytes || head.image_bytes > kMaxImageBytes) {
    return std::nullopt;
  }
  return head;
}

std::string FrameMetadataJson(const Frame& frame, const RawImage& layout) {
  Json json{{"index", frame.index},
            {"timestamp_ns", frame.timestamp_ns},
            {"stamp", kMeanings[static_cast<int>(frame.stamp_meaning)]},
            {"lost",
             {frame.loss.by_number, frame.loss.by_time, frame.loss.damaged, frame.loss.not_taken}},
            {"lost_before", frame.lost_before},
            {"format", NameOf(layout.format)},
            {"width", layout.width},
            {"height", layout.height},
            {"stride", layout.stride},
            {"matrix", layout.matrix == YuvMatrix::kBt709 ? "bt709" : "bt601"},
            {"full_range", layout.full_range}};
  Set(&json, "arrival_ns", frame.arrival_ns);
  Set(&json, "device_timestamp_ns", frame.device_timestamp_ns);
  Set(&json, "exposure_s", frame.settings.exposure_s);
  Set(&json, "gain", frame.settings.gain);
  Set(&json, "white_balance_k", frame.settings.white_balance_k);
  return json.dump();
}

std::optional<FrameMetadata> ParseFrameMetadata(std::string_view text) {
  try {
    const Json json = Json::parse(text);
    FrameMetadata facts;
    Frame& frame = facts.frame;
    frame.index = json.at("index");
    frame.timestamp_ns = json.at("timestamp_ns");
    // Differences of two stamps must not overflow.
    constexpr std::int64_t kMaxStamp_ns = std::int64_t{1} << 62;
    if (frame.timestamp_ns < -kMaxStamp_ns || frame.timestamp_ns > kMaxStamp_ns) {
      return std::nullopt;
    }
    const std::string meaning = json.at("stamp");
    for (int i = 0; i < 4; ++i) {
      if (kMeanings[i] == meaning) frame.stamp_meaning = static_cast<StampMeaning>(i);
    }
    const auto& lost = json.at("lost");
    frame.loss = {lost.at(0), lost.at(1), lost.at(2), lost.at(3)};
    frame.lost_before = json.at("lost_before");
    frame.arrival_ns = Optional<std::int64_t>(json, "arrival_ns");
    frame.device_timestamp_ns = Optional<std::int64_t>(json, "device_timestamp_ns");
    frame.settings.exposure_s = Optional<double>(json, "exposure_s");
    frame.settings.gain = Optional<double>(json, "gain");
    frame.settings.white_balance_k = Optional<double>(json, "white_balance_k");
    const auto format = PixelFormatByName(json.at("format").get<std::string>());
    if (!format) return std::nullopt;
    facts.layout.format = *format;
    facts.layout.width = json.at("width");
    facts.layout.height = json.at("height");
    facts.layout.stride = json.at("stride");
    facts.layout.matrix = json.at("matrix") == "bt709" ? YuvMatrix::kBt709 : YuvMatrix::kBt601;
    facts.layout.full_range = json.at("full_range");
    return facts;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace pleinair::devices
