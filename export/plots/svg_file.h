#pragma once

// Internal: shared by the SVG files of this module.

#include <string>

namespace pleinair::exports {

/// Formats a number for SVG and PDF: at most `decimals` digits, no trailing zeros, never "-0".
/// Equal numbers give equal bytes.
std::string ShortNumber(double value, int decimals);

/// The size of an SVG file on paper or screen, and of its drawing in its own units.
struct SvgSize {
  std::string width, height;            ///< With a unit: "210mm"; pixels without one.
  std::string view_width, view_height;  ///< The view box begins at 0, 0.
};

/// Beginning of an SVG 1.1 file up to its title, which is escaped.
std::string SvgFileHead(const SvgSize& size, const std::string& title);

}  // namespace pleinair::exports
