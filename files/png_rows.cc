#include "files/png_rows.h"

#include <png.h>

#include <csetjmp>

#include "base/check.h"

namespace pleinair::files {

// libpng reports errors by longjmp, so no object with a destructor may exist between setjmp and
// here.
bool WritePngRows(ImageView<const std::uint8_t> picture, PngStyle style, std::FILE* file) {
  CHECK_EQ(picture.channels() == 1 || picture.channels() == 3, true);
  const auto silent = [](png_structp, png_const_charp) {};
  png_structp png = png_create_write_struct(
      PNG_LIBPNG_VER_STRING, nullptr,
      [](png_structp failed, png_const_charp) { png_longjmp(failed, 1); }, silent);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_init_io(png, file);
  png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
  if (style.fast) {
    png_set_compression_level(png, 3);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB | PNG_FILTER_UP);
  }
  png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width()),
               static_cast<png_uint_32>(picture.height()), 8,
               picture.channels() == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_RELATIVE);
  if (style.pixels_per_metre > 0) {
    png_set_pHYs(png, info, style.pixels_per_metre, style.pixels_per_metre, PNG_RESOLUTION_METER);
  }
  png_write_info(png, info);
  for (int y = 0; y < picture.height(); ++y) png_write_row(png, picture.row(y));
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace pleinair::files
