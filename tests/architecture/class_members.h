#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pleinair::architecture {

/// A class or struct of a source text.
struct ClassMembers {
  int line = 0;
  std::string name;         ///< With the enclosing classes: "Camera::Worker".
  std::size_t members = 0;  ///< Non-static data members, without those of base classes.
};

/// The classes and structs that a C++ text defines, nested and local ones included, in the order of
/// their closing braces. There is no preprocessor. Each declarator of `double a, b;` counts; an
/// unnamed union does not. Macros that contain unbalanced braces are not supported.
std::vector<ClassMembers> ParseClasses(std::string_view text);

/// True if a text is SIMD code, which Highway compiles once for each target.
bool IsSimdCode(std::string_view text);

}  // namespace pleinair::architecture
