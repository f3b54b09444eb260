// A damaged JPEG from a camera is rejected or decoded, never a crash.
#include <cstddef>
#include <cstdint>

#include "devices/images/raw_image.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static pleinair::devices::DecodedImage image;
  pleinair::devices::RawImage raw;
  raw.format = pleinair::devices::PixelFormat::kMjpeg;
  raw.width = 32;
  raw.height = 24;
  raw.bytes.assign(data, data + size);
  static_cast<void>(pleinair::devices::ConvertRawImage(raw, &image));
  return 0;
}
