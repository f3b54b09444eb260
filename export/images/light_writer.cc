#include "export/images/light_writer.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>

#include <cerrno>
#include <cstddef>
#include <exception>
#include <string>
#include <system_error>

// Static functions: other libraries contain their own copies.
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#include "base/atomic_file.h"
#include "base/check.h"

namespace pleinair::exports {

Result<void> WriteExr(const std::filesystem::path& file, ImageView<const float> rgb,
                      const LightFileFacts& facts) {
  CHECK_EQ(rgb.channels(), 3);
  const std::filesystem::path temporary = TemporarySibling(file);
  errno = 0;
  try {
    Imf::Header header(rgb.width(), rgb.height());
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities());  // Rec.709, D65.
    Imf::addWhiteLuminance(header, static_cast<float>(facts.white_cd_m2));
    if (!facts.comment.empty()) Imf::addComments(header, facts.comment);
    if (facts.latitude_longitude) Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
    Imf::FrameBuffer buffer;
    constexpr std::size_t kPixel = 3 * sizeof(float);
    for (int channel = 0; channel < 3; ++channel) {
      const std::string name(1, "RGB"[channel]);
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      // OpenEXR has no const view; nothing writes through this one.
      char* base = const_cast<char*>(reinterpret_cast<const char*>(rgb.data() + channel));
      buffer.insert(name, Imf::Slice(Imf::FLOAT, base, kPixel,
                                     static_cast<std::size_t>(rgb.stride()) * sizeof(float)));
    }
    Imf::OutputFile out(temporary.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(rgb.height());
  } catch (const std::exception&) {
    const int error_number = errno != 0 ? errno : EIO;
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    return tl::make_unexpected(WriteError(file, error_number));
  }
  return CommitFile(temporary, file);
}

Result<void> WriteRadianceHdr(const std::filesystem::path& file, ImageView<const float> rgb) {
  CHECK_EQ(rgb.channels(), 3);
  CHECK_EQ(rgb.stride(), static_cast<std::ptrdiff_t>(rgb.width()) * 3);
  std::string bytes;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data),
                                          static_cast<std::size_t>(size));
  };
  if (stbi_write_hdr_to_func(append, &bytes, rgb.width(), rgb.height(), 3, rgb.data()) == 0) {
    return SystemError(file.string(), "cannot be encoded as Radiance HDR",
                       "write OpenEXR (.exr) instead");
  }
  return WriteFileAtomically(file, bytes);
}

}  // namespace pleinair::exports
