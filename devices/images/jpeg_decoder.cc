#include "devices/images/jpeg_decoder.h"

#include <csetjmp>
#include <cstdio>
#include <string>

// After <cstdio>: jpeglib.h uses FILE without declaring it.
#include <jpeglib.h>
// After <jpeglib.h>: its message codes.
#include <jerror.h>

namespace pleinair::devices {
namespace {

/// libjpeg reports errors by a callback that must not return: it jumps.
struct Reporter {
  jpeg_error_mgr manager;
  std::jmp_buf back;
  char message[JMSG_LENGTH_MAX];
};

const char* ReasonOf(int code) {
  switch (code) {
    case JERR_CONVERSION_NOTIMPL:
      return "its color conversion is not supported";
    case JERR_INPUT_EMPTY:
    case JERR_INPUT_EOF:
    case JWRN_JPEG_EOF:
      return "it ends too early";
    case JERR_OUT_OF_MEMORY:
      return "there is not enough memory to decode it";
    default:
      return "its compressed data are corrupt";
  }
}

[[noreturn]] void LeaveOnError(j_common_ptr common) {
  auto* reporter = reinterpret_cast<Reporter*>(common->err);
  std::snprintf(reporter->message, sizeof reporter->message, "%s", ReasonOf(common->err->msg_code));
  std::longjmp(reporter->back, 1);
}

// The first warning is the cause; later ones are consequences. Extra bytes between the last block
// and the end marker are not damage: many cameras pad there.
void OnMessage(j_common_ptr common, int level) {
  constexpr int kEndOfImage = 0xD9;  // ITU-T T.81, Table B.1.
  if (level >= 0) return;
  const bool padded =
      common->err->msg_code == JWRN_EXTRANEOUS_DATA && common->err->msg_parm.i[1] == kEndOfImage;
  if (!padded) LeaveOnError(common);
}

/// Returns false on failure, with the reason in `reporter`. No object with a destructor may exist
/// here, because of the jump.
bool Decode(const std::uint8_t* bytes, std::size_t size, std::uint8_t* rgb, int width, int height,
            Reporter* reporter) {
  jpeg_decompress_struct decoder;
  decoder.err = jpeg_std_error(&reporter->manager);
  reporter->manager.error_exit = LeaveOnError;
  reporter->manager.emit_message = OnMessage;
  reporter->message[0] = '\0';
  jpeg_create_decompress(&decoder);
  if (setjmp(reporter->back) != 0) {
    jpeg_destroy_decompress(&decoder);
    return false;
  }
  jpeg_mem_src(&decoder, bytes, size);
  jpeg_read_header(&decoder, TRUE);
  if (static_cast<int>(decoder.image_width) != width ||
      static_cast<int>(decoder.image_height) != height) {
    std::snprintf(reporter->message, sizeof reporter->message, "its size is %ux%u, not %dx%d",
                  decoder.image_width, decoder.image_height, width, height);
    jpeg_destroy_decompress(&decoder);
    return false;
  }
  decoder.out_color_space = JCS_RGB;
  jpeg_start_decompress(&decoder);
  while (decoder.output_scanline < decoder.output_height) {
    JSAMPROW row =
        rgb + static_cast<std::size_t>(decoder.output_scanline) * 3 * decoder.output_width;
    jpeg_read_scanlines(&decoder, &row, 1);
  }
  jpeg_finish_decompress(&decoder);
  jpeg_destroy_decompress(&decoder);
  return true;
}

}  // namespace

Result<void> DecodeJpeg(const std::vector<std::uint8_t>& bytes, RgbImage* rgb) {
  Reporter reporter;
  if (!bytes.empty() &&
      Decode(bytes.data(), bytes.size(), rgb->data(), rgb->width(), rgb->height(), &reporter)) {
    return {};
  }
  const std::string why = bytes.empty() ? "it is empty" : reporter.message;
  return InputError("", "the image is damaged: " + why);
}

}  // namespace pleinair::devices
