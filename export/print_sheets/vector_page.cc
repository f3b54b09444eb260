#include "export/print_sheets/vector_page.h"

#include <cstddef>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "export/plots/svg_file.h"
#include "export/print_sheets/print_outline.h"
#include "files/markup_escape.h"

namespace pleinair::exports {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;

// Micrometres are a hundred times finer than printers.
std::string Number(double value) { return ShortNumber(value, 4); }

/// Escapes our own ASCII texts and titles.
std::string EscapePdf(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '(' || c == ')' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string PdfContent(const Sheet& sheet) {
  std::string content;
  auto out = std::back_inserter(content);
  // From here on: millimetres from the top-left corner, y down.
  fmt::format_to(out, "0 g\n{0} 0 0 -{0} 0 {1} cm\n", fmt::format("{:.8f}", kPointsPerMm),
                 fmt::format("{:.6f}", sheet.page.height_mm * kPointsPerMm));
  for (const SheetMarker& print : sheet.prints) {
    fmt::format_to(out, "q {0} 0 0 {0} {1} {2} cm\n", fmt::format("{:.6f}", print.module_mm),
                   Number(print.top_left_mm.x), Number(print.top_left_mm.y));
    for (const auto& loop : TraceBlackOutlines(print.pattern)) {
      const char* op = "m";
      for (const ModuleCorner corner : loop) {
        fmt::format_to(out, "{} {} {} ", corner.x, corner.y, op);
        op = "l";
      }
      content += "h\n";
    }
    content += "f* Q\n";
  }
  for (const SheetRectangle& r : sheet.rectangles) {
    fmt::format_to(out, "{} {} {} {} re f\n", Number(r.top_left_mm.x), Number(r.top_left_mm.y),
                   Number(r.size_mm.x), Number(r.size_mm.y));
  }
  for (const SheetTriangle& t : sheet.triangles) {
    fmt::format_to(out, "{} {} m {} {} l {} {} l h f\n", Number(t.corners_mm[0].x),
                   Number(t.corners_mm[0].y), Number(t.corners_mm[1].x), Number(t.corners_mm[1].y),
                   Number(t.corners_mm[2].x), Number(t.corners_mm[2].y));
  }
  for (const SheetText& text : sheet.texts) {
    fmt::format_to(out, "BT /F1 {} Tf 1 0 0 -1 {} {} Tm ({}) Tj ET\n", Number(text.size_mm),
                   Number(text.baseline_mm.x), Number(text.baseline_mm.y), EscapePdf(text.text));
  }
  return content;
}

}  // namespace

std::string WritePdf(std::span<const Sheet> sheets) {
  // Objects: 1 catalogue, 2 page tree, 3 font, 4 title; then page and content of each sheet.
  std::string pdf = "%PDF-1.4\n%\xE2\xE3\xCF\xD3\n";
  std::vector<std::size_t> offsets;
  const auto add = [&](const std::string& body) {
    offsets.push_back(pdf.size());
    pdf += fmt::format("{} 0 obj\n{}\nendobj\n", offsets.size(), body);
  };
  const auto page_object = [](std::size_t sheet) { return 5 + 2 * sheet; };
  add("<< /Type /Catalog /Pages 2 0 R /ViewerPreferences << /PrintScaling /None >> >>");
  std::string kids;
  for (std::size_t i = 0; i < sheets.size(); ++i) kids += fmt::format("{} 0 R ", page_object(i));
  add(fmt::format("<< /Type /Pages /Kids [ {}] /Count {} >>", kids, sheets.size()));
  add("<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>");
  add(fmt::format("<< /Title ({}) /Creator (pleinair) >>", EscapePdf(sheets.front().title)));
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    add(
        fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.6f} {:.6f}] /Contents {} 0 R "
                    "/Resources << /Font << /F1 3 0 R >> >> >>",
                    sheets[i].page.width_mm * kPointsPerMm, sheets[i].page.height_mm * kPointsPerMm,
                    page_object(i) + 1));
    const std::string content = PdfContent(sheets[i]);
    add(fmt::format("<< /Length {} >>\nstream\n{}endstream", content.size(), content));
  }
  const std::size_t table = pdf.size();
  pdf += fmt::format("xref\n0 {}\n0000000000 65535 f \n", offsets.size() + 1);
  for (const std::size_t offset : offsets) pdf += fmt::format("{:010} 00000 n \n", offset);
  pdf += fmt::format("trailer\n<< /Size {} /Root 1 0 R /Info 4 0 R >>\nstartxref\n{}\n%%EOF\n",
                     offsets.size() + 1, table);
  return pdf;
}

std::string WriteSvg(const Sheet& sheet) {
  const std::string width = Number(sheet.page.width_mm), height = Number(sheet.page.height_mm);
  std::string svg = SvgFileHead({width + "mm", height + "mm", width, height}, sheet.title);
  auto out = std::back_inserter(svg);
  fmt::format_to(out, "<rect width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n", width, height);
  for (const SheetMarker& print : sheet.prints) {
    fmt::format_to(out,
                   "<path fill-rule=\"evenodd\" transform=\"translate({} {}) scale({:.6f})\" d=\"",
                   Number(print.top_left_mm.x), Number(print.top_left_mm.y), print.module_mm);
    for (const auto& loop : TraceBlackOutlines(print.pattern)) {
      char op = 'M';
      for (const ModuleCorner corner : loop) {
        fmt::format_to(out, "{}{} {}", op, corner.x, corner.y);
        op = 'L';
      }
      svg += 'Z';
    }
    svg += "\"/>\n";
  }
  for (const SheetRectangle& r : sheet.rectangles) {
    fmt::format_to(out, "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n",
                   Number(r.top_left_mm.x), Number(r.top_left_mm.y), Number(r.size_mm.x),
                   Number(r.size_mm.y));
  }
  for (const SheetTriangle& t : sheet.triangles) {
    svg += "<polygon points=\"";
    for (const Vec2 corner : t.corners_mm) {
      fmt::format_to(out, "{},{} ", Number(corner.x), Number(corner.y));
    }
    svg += "\"/>\n";
  }
  for (const SheetText& text : sheet.texts) {
    fmt::format_to(out,
                   "<text x=\"{}\" y=\"{}\" font-family=\"Helvetica, Arial, sans-serif\" "
                   "font-size=\"{}\" xml:space=\"preserve\">{}</text>\n",
                   Number(text.baseline_mm.x), Number(text.baseline_mm.y), Number(text.size_mm),
                   files::EscapeMarkup(text.text));
  }
  return svg + "</svg>\n";
}

}  // namespace pleinair::exports
