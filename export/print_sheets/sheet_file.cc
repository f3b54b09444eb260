#include "export/print_sheets/sheet_file.h"

#include <optional>

#include "export/print_sheets/sheet_raster.h"
#include "export/print_sheets/vector_page.h"

namespace pleinair::exports {
namespace {

// The largest named page, A0, has 144 megapixels.
constexpr double kMaxMegapixels = 200.0;

Result<std::string> RenderPng(const Sheet& sheet) {
  const double megapixels =
      sheet.page.width_mm * sheet.page.height_mm * kSheetPixelsPerMm * kSheetPixelsPerMm * 1e-6;
  if (megapixels > kMaxMegapixels) {
    return InputError("--page",
                      "a page of " + PageName(sheet.page) + " mm is too large for a PNG picture",
                      "use --pdf or --svg, or a page no larger than A0");
  }
  Image<std::uint8_t> picture = RasterizeSheet(sheet);
  return EncodeGrayPng(picture.view(), kSheetPixelsPerMm * 1000.0);
}

}  // namespace

std::string_view FormatName(SheetFormat format) {
  switch (format) {
    case SheetFormat::kPdf:
      return "pdf";
    case SheetFormat::kSvg:
      return "svg";
    case SheetFormat::kPng:
      return "png";
  }
  return "";
}

Result<SheetFormat> ChooseFormat(const FormatFlags& flags, const std::filesystem::path& output) {
  std::optional<SheetFormat> flag;
  if (flags.pdf) flag = SheetFormat::kPdf;
  if (flags.svg) flag = SheetFormat::kSvg;
  if (flags.png) flag = SheetFormat::kPng;
  std::string ending = output.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  for (const SheetFormat format : {SheetFormat::kPdf, SheetFormat::kSvg, SheetFormat::kPng}) {
    if (ending != '.' + std::string(FormatName(format))) continue;
    if (flag && *flag != format) {
      return InputError(output.string(),
                        "its ending is not that of --" + std::string(FormatName(*flag)),
                        "leave the option out or rename the file");
    }
    return format;
  }
  if (flag) return *flag;
  if (ending.empty()) return SheetFormat::kPdf;
  return InputError(output.string(), "sheets are not written as " + ending,
                    "use .pdf, .svg or .png, or give --pdf, --svg or --png");
}

Result<std::string> RenderSheet(const Sheet& sheet, SheetFormat format) {
  switch (format) {
    case SheetFormat::kPdf:
      return WritePdf({&sheet, 1});
    case SheetFormat::kSvg:
      return WriteSvg(sheet);
    case SheetFormat::kPng:
      return RenderPng(sheet);
  }
  return std::string();
}

}  // namespace pleinair::exports
