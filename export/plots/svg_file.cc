#include "export/plots/svg_file.h"

#include <fmt/format.h>

#include "files/markup_escape.h"

namespace pleinair::exports {

std::string ShortNumber(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string SvgFileHead(const SvgSize& size, const std::string& title) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{}\" height=\"{}\" "
      "viewBox=\"0 0 {} {}\">\n<title>{}</title>\n",
      size.width, size.height, size.view_width, size.view_height, files::EscapeMarkup(title));
}

}  // namespace pleinair::exports
