#include "compositor/models/gltf_compression.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "compositor/models/gltf_draco.h"
#include "compositor/models/gltf_meshopt.h"

namespace pleinair::compositor {
namespace {

// glTF 2.0, 4.4: header of 12 bytes; chunks with 8 bytes of length and type.
constexpr std::size_t kGlbHeader = 12, kChunkHeader = 8;

std::uint32_t WordAt(std::string_view content, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, content.data() + at, sizeof(word));
  return word;
}

std::string WordBytes(std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  std::string bytes(sizeof(word), '\0');
  std::memcpy(bytes.data(), &word, sizeof(word));
  return bytes;
}

/// Inserts text before the closing braces of objects in two lists of a glTF text. The text is not
/// checked: tinygltf reports what is no JSON.
class Completion {
 public:
  explicit Completion(std::string_view text) : text_(text) {}

  std::string Complete() {
    for (at_ = 0; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '"') {
        TakeString();
      } else if (c == '{' || c == '[') {
        if (++depth_ == kItem) keys_.clear();
      } else if (c == '}' || c == ']') {
        if (depth_-- == kItem) Insert(Missing());
      }
    }
    result_ += text_.substr(copied_);
    return std::move(result_);
  }

 private:
  // Depths inside the file's object, and inside an object of one of its lists.
  static constexpr int kFile = 1, kItem = 3;

  /// Moves to a string's closing quote, and takes it for a key if a colon follows.
  void TakeString() {
    const std::size_t begin = at_ + 1;
    for (at_ = begin; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (text_[at_] == '\\') ++at_;
    }
    const std::string_view name = text_.substr(begin, std::min(at_, text_.size()) - begin);
    const std::size_t next = text_.find_first_not_of(" \t\r\n", at_ + 1);
    if (next == std::string_view::npos || text_[next] != ':') return;
    if (depth_ == kFile) list_ = name;
    if (depth_ >= kItem) keys_.insert(name);
  }

  /// What the object that closes lacks. If two keys are equal, the last counts.
  std::string_view Missing() const {
    if (list_ == "buffers" && keys_.contains(kMeshoptExtension) && !keys_.contains("uri")) {
      return R"(,"uri":"data:application/octet-stream;base64,AA==","byteLength":1)";
    }
    if (list_ == "accessors" && !keys_.contains("bufferView") && !keys_.contains("sparse")) {
      return R"(,"bufferView":0)";
    }
    return {};
  }

  void Insert(std::string_view addition) {
    if (addition.empty()) return;
    result_ += text_.substr(copied_, at_ - copied_);
    result_ += addition;
    copied_ = at_;
  }

  std::string_view text_;
  std::size_t at_ = 0, copied_ = 0;
  int depth_ = 0;
  std::string_view list_;            // Key of the file's object that is read now.
  std::set<std::string_view> keys_;  // Keys of the object that is read now, at any depth.
  std::string result_;
};

}  // namespace

bool CanDecompress(const std::string& extension) {
  return (extension == kMeshoptExtension && kHasMeshopt) ||
         (extension == kDracoExtension && kHasDraco);
}

std::string WithoutGaps(std::string content) {
  if (content.find(kMeshoptExtension) == std::string::npos &&
      content.find(kDracoExtension) == std::string::npos) {
    return content;
  }
  if (!content.starts_with("glTF")) return Completion(content).Complete();
  if (content.size() < kGlbHeader + kChunkHeader) return content;
  const std::size_t length = WordAt(content, kGlbHeader);
  const std::size_t begin = kGlbHeader + kChunkHeader;
  if (length > content.size() - begin) return content;
  std::string json = Completion(std::string_view(content).substr(begin, length)).Complete();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string rest = content.substr(begin + length);
  return content.substr(0, 8) + WordBytes(begin + json.size() + rest.size()) +
         WordBytes(json.size()) + content.substr(kGlbHeader + 4, 4) + json + rest;
}

Result<void> DecompressGltf(const std::string& where, tinygltf::Model* gltf) {
  PLEINAIR_RETURN_IF_ERROR(DecompressMeshopt(where, gltf));
  return DecompressDraco(where, gltf);
}

}  // namespace pleinair::compositor
