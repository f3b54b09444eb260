#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pleinair::architecture {

/// A class or struct of a source text.
struct ClassMembers {
  int line = 0;
  std::string name;         ///< With the classes around it: "Camera::Worker".
  std::size_t members = 0;  ///< Its own data members; static ones and those of bases do not count.
};

/// The classes and structs that a C++ text defines, nested and local ones too, in the order of
/// their closing braces. Reads the text without a preprocessor: each declarator of `double a, b;`
/// counts, an unnamed union counts as nothing. Macros that open or close braces are not understood.
std::vector<ClassMembers> ParseClasses(std::string_view text);

/// Whether a text is SIMD code, compiled once for each target by Highway.
bool IsSimdCode(std::string_view text);

}  // namespace pleinair::architecture
