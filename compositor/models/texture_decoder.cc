#include "compositor/models/texture_decoder.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>

#ifdef PLEINAIR_WEBP
#include <webp/decode.h>
#endif

#include "compositor/models/model_files.h"
#include "compositor/models/model_limits.h"

namespace {

/// For an empty PNG chunk, the decoder copies zero bytes to a null pointer, which memcpy forbids.
void* CopyBytes(void* to, const void* from, std::size_t size) {
  return size == 0 ? to : std::memcpy(to, from, size);
}

}  // namespace

// NOLINTBEGIN: another project's code.
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#define memcpy CopyBytes
#include <stb/stb_image.h>
#undef memcpy
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
// NOLINTEND

namespace pleinair::compositor {
namespace {

struct ImageSize {
  std::int64_t width, height;
};

std::int64_t BigEndian(std::string_view bytes) {
  std::int64_t value = 0;
  for (const char c : bytes) value = value * 256 + static_cast<unsigned char>(c);
  return value;
}

/// The size in a PNG's IHDR chunk (PNG specification, 11.2.2).
std::optional<ImageSize> PngSize(std::string_view content) {
  if (content.size() < 24 || content.substr(12, 4) != "IHDR") return std::nullopt;
  return ImageSize{BigEndian(content.substr(16, 4)), BigEndian(content.substr(20, 4))};
}

/// The size in a JPEG's frame header (ITU-T T.81, B.2.2), found by a scan over the segments.
std::optional<ImageSize> JpegSize(std::string_view content) {
  std::size_t at = 2;
  while (at + 4 <= content.size() && content[at] == '\xFF') {
    const auto marker = static_cast<unsigned char>(content[at + 1]);
    if (marker == 0xFF) {  // Fill byte.
      ++at;
      continue;
    }
    // SOF0…SOF15; DHT, JPG and DAC have codes in this range.
    const bool is_frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame) {
      if (at + 9 > content.size()) return std::nullopt;
      return ImageSize{BigEndian(content.substr(at + 7, 2)), BigEndian(content.substr(at + 5, 2))};
    }
    at += 2 + static_cast<std::size_t>(BigEndian(content.substr(at + 2, 2)));
  }
  return std::nullopt;
}

/// The size in the image's header, if found. For an image above its limit, the decoder reports only
/// an unknown format.
std::optional<ImageSize> StatedSize(std::span<const std::byte> bytes) {
  const std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (content.starts_with("\x89PNG")) return PngSize(content);
  if (content.starts_with("\xFF\xD8")) return JpegSize(content);
  return std::nullopt;
}

constexpr const char* kConvert = "convert it to PNG or JPEG of at most 16384 × 16384 pixels";

/// A PNG ends with its IEND chunk, a JPEG with the EOI marker. The decoder ignores a missing end
/// and would return the rest of the image grey.
bool IsCutShort(std::span<const std::byte> bytes) {
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  const std::string_view content(text, bytes.size());
  if (content.starts_with("\x89PNG")) return content.rfind("IEND") == std::string_view::npos;
  return content.rfind("\xFF\xD9") == std::string_view::npos;
}

#ifdef PLEINAIR_WEBP
/// Returns whether the content is WebP: a RIFF file of that form.
bool IsWebp(std::span<const std::byte> bytes) {
  const std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return content.size() >= 12 && content.starts_with("RIFF") && content.substr(8, 4) == "WEBP";
}

Result<Image<std::uint8_t>> DecodeWebp(std::span<const std::byte> bytes, const std::string& where) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK) {
    return InputError(where, "the texture is cut short or damaged", "copy it again");
  }
  const int channels = features.has_alpha != 0 ? 4 : 3;
  Image<std::uint8_t> image(features.width, features.height, channels);
  const int stride = features.width * channels;
  const auto* decoded =
      channels == 4 ? WebPDecodeRGBAInto(data, bytes.size(), image.data(), image.size(), stride)
                    : WebPDecodeRGBInto(data, bytes.size(), image.data(), image.size(), stride);
  if (decoded == nullptr) {
    return InputError(where, "the texture is cut short or damaged", "copy it again");
  }
  return image;
}
#endif

}  // namespace

bool DecodesWebp() {
#ifdef PLEINAIR_WEBP
  return true;
#else
  return false;
#endif
}

Result<Image<std::uint8_t>> DecodeTexture(std::span<const std::byte> bytes,
                                          const std::string& where) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    return InputError(where, "the texture's file is too large", kConvert);
  }
  if (const auto stated = StatedSize(bytes);
      stated && std::max(stated->width, stated->height) > kMaxTextureSide_px) {
    return InputError(where,
                      "the texture is " + std::to_string(stated->width) + " × " +
                          std::to_string(stated->height) + " pixels",
                      kConvert);
  }
#ifdef PLEINAIR_WEBP
  if (IsWebp(bytes)) return DecodeWebp(bytes, where);
#endif
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) {
    return InputError(where, "the texture is no picture that is supported, or damaged", kConvert);
  }
  if (IsCutShort(bytes)) return InputError(where, "the texture is cut short", "copy it again");
  const int wanted = channels == 2 || channels == 4 ? 4 : 3;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(data, size, &width, &height, &channels, wanted), stbi_image_free);
  if (pixels == nullptr) {
    const std::string cause = stbi_failure_reason() != nullptr ? stbi_failure_reason() : "damaged";
    return InputError(where, "the texture cannot be decoded (" + cause + ")", kConvert);
  }
  Image<std::uint8_t> image(width, height, wanted);
  std::memcpy(image.data(), pixels.get(), image.size());
  return image;
}

Result<Image<std::uint8_t>> ReadTexture(const std::filesystem::path& file) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string content, ReadWholeFile(file));
  return DecodeTexture(std::as_bytes(std::span(content)), file.string());
}

}  // namespace pleinair::compositor
