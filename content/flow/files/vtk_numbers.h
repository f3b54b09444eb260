#pragma once

// Internal: numbers in files of VTK.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pleinair::content {

/// A type of numbers, by VTK's name, "Float32", or that of legacy files, "float".
struct VtkType {
  std::size_t bytes = 4;
  char kind = 'f';  ///< f: floating point, i: signed, u: unsigned.
};
std::optional<VtkType> VtkTypeOf(const std::string& name);

/// Numbers separated by white space, `most` at most; unset: other text.
std::optional<std::vector<double>> ParseNumbers(std::string_view text, std::size_t most);

/// Numbers from bytes.
std::vector<double> DecodeNumbers(std::string_view bytes, const VtkType& type, bool big_endian);

/// Base64 up to the first other character or padding; white space is skipped. `*end`: the place
/// behind. Unset: `most_bytes` exceeded.
std::optional<std::string> DecodeBase64(std::string_view text, std::size_t most_bytes,
                                        std::size_t* end);

}  // namespace pleinair::content
