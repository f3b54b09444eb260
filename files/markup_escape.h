#pragma once

#include <string>
#include <string_view>

namespace pleinair::files {

/// Escapes text for HTML and XML (SVG), in elements and in quoted attributes.
std::string EscapeMarkup(std::string_view text);

}  // namespace pleinair::files
