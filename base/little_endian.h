#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace pleinair {

namespace internal {

/// Unsigned integer with the same bits as `T`.
template <typename T>
using BitsOf = std::conditional_t<
    sizeof(T) == 1, std::uint8_t,
    std::conditional_t<sizeof(T) == 2, std::uint16_t,
                       std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;

}  // namespace internal

/// Appends an integer or an IEEE 754 float, least significant byte first.
template <typename T>
void PutLittleEndian(T value, std::string* bytes) {
  static_assert(std::is_arithmetic_v<T>);
  std::uint64_t bits = std::bit_cast<internal::BitsOf<T>>(value);
  for (std::size_t i = 0; i < sizeof(T); ++i, bits >>= 8) bytes->push_back(static_cast<char>(bits));
}

/// Reads values from the front of a byte string, which must outlive the reader. Past the end, all
/// values are 0 and `complete` is false.
class LittleEndianReader {
 public:
  explicit LittleEndianReader(std::string_view bytes) : bytes_(bytes) {}

  /// Reads an integer or an IEEE 754 float.
  template <typename T>
  T Get() {
    static_assert(std::is_arithmetic_v<T>);
    const std::string_view taken = Take(sizeof(T));
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < taken.size(); ++i) {
      bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(taken[i])) << (8 * i);
    }
    return std::bit_cast<T>(static_cast<internal::BitsOf<T>>(bits));
  }

  /// Reads `count` bytes.
  std::string_view Take(std::size_t count) {
    if (count > bytes_.size()) {
      complete_ = false;
      bytes_ = {};
      return {};
    }
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }

  /// The bytes that have not been read.
  std::string_view rest() const { return bytes_; }
  bool complete() const { return complete_; }

 private:
  std::string_view bytes_;
  bool complete_ = true;
};

}  // namespace pleinair
