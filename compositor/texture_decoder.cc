#include "compositor/texture_decoder.h"

#include <cstring>
#include <limits>
#include <memory>

#include "compositor/model_files.h"
#include "compositor/model_limits.h"

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
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
// NOLINTEND

namespace pleinair::compositor {
namespace {

constexpr const char* kConvert = "convert it to PNG or JPEG of at most 16384 × 16384 pixels";

/// A PNG ends with its IEND chunk, a JPEG with the EOI marker: the decoder itself passes over a
/// missing end of the data and would leave the rest of the picture grey.
bool IsCutShort(std::span<const std::byte> bytes) {
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  const std::string_view content(text, bytes.size());
  if (content.starts_with("\x89PNG")) return content.rfind("IEND") == std::string_view::npos;
  return content.rfind("\xFF\xD9") == std::string_view::npos;
}

}  // namespace

Result<Image<std::uint8_t>> DecodeTexture(std::span<const std::byte> bytes,
                                          const std::string& where) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    return InputError(where, "the texture's file is too large", kConvert);
  }
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) {
    const std::string cause = stbi_failure_reason() != nullptr ? stbi_failure_reason() : "";
    if (cause == "too large") {
      return InputError(where, "the texture is larger than 16384 × 16384 pixels", kConvert);
    }
    return InputError(where, "the texture is neither PNG nor JPEG, or damaged", kConvert);
  }
  if (width < 1 || height < 1 || width > kMostTexturePixelsASide ||
      height > kMostTexturePixelsASide) {
    return InputError(
        where,
        "the texture is " + std::to_string(width) + " × " + std::to_string(height) + " pixels",
        kConvert);
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
