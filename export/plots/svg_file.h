#pragma once

// Internal: what the SVG files of this module have in common.

#include <string>

namespace pleinair::exports {

/// A number as SVG and PDF have it: at most `decimals` digits behind the point, the last one not
/// zero, never "-0". Equal numbers give equal bytes.
std::string ShortNumber(double value, int decimals);

/// The size of an SVG file on paper or screen, and of its drawing in units of its own.
struct SvgSize {
  std::string width, height;            ///< With a unit: "210mm"; pixels without one.
  std::string view_width, view_height;  ///< The view box begins at 0, 0.
};

/// An SVG 1.1 file up to its title, which is escaped.
std::string SvgFileHead(const SvgSize& size, const std::string& title);

}  // namespace pleinair::exports
