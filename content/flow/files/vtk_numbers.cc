#include "content/flow/files/vtk_numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <utility>

namespace pleinair::content {
namespace {

bool IsSpace(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

int Base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

template <typename T>
double NumberFrom(std::string_view bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return static_cast<double>(value);
}

double NumberFrom(std::string_view bytes, const VtkType& type) {
  if (type.kind == 'f')
    return type.bytes == 4 ? NumberFrom<float>(bytes) : NumberFrom<double>(bytes);
  const bool is_signed = type.kind == 'i';
  switch (type.bytes) {
    case 1:
      return is_signed ? NumberFrom<std::int8_t>(bytes) : NumberFrom<std::uint8_t>(bytes);
    case 2:
      return is_signed ? NumberFrom<std::int16_t>(bytes) : NumberFrom<std::uint16_t>(bytes);
    case 4:
      return is_signed ? NumberFrom<std::int32_t>(bytes) : NumberFrom<std::uint32_t>(bytes);
    default:
      return is_signed ? NumberFrom<std::int64_t>(bytes) : NumberFrom<std::uint64_t>(bytes);
  }
}

}  // namespace

std::optional<VtkType> VtkTypeOf(const std::string& name) {
  static constexpr std::array<std::pair<const char*, VtkType>, 22> kTypes = {
      {{"Float32", {4, 'f'}},        {"Float64", {8, 'f'}},       {"Int8", {1, 'i'}},
       {"UInt8", {1, 'u'}},          {"Int16", {2, 'i'}},         {"UInt16", {2, 'u'}},
       {"Int32", {4, 'i'}},          {"UInt32", {4, 'u'}},        {"Int64", {8, 'i'}},
       {"UInt64", {8, 'u'}},         {"float", {4, 'f'}},         {"double", {8, 'f'}},
       {"char", {1, 'i'}},           {"unsigned_char", {1, 'u'}}, {"short", {2, 'i'}},
       {"unsigned_short", {2, 'u'}}, {"int", {4, 'i'}},           {"unsigned_int", {4, 'u'}},
       {"long", {8, 'i'}},           {"unsigned_long", {8, 'u'}}, {"vtktypeint64", {8, 'i'}},
       {"vtkIdType", {8, 'i'}}}};
  for (const auto& [known, type] : kTypes) {
    if (name == known) return type;
  }
  return std::nullopt;
}

std::optional<std::vector<double>> ParseNumbers(std::string_view text, std::size_t most) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    while (at < end && IsSpace(*at)) ++at;
    if (at == end) return numbers;
    if (*at == '+') ++at;
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    const bool ends = next == end || IsSpace(*next);
    if (error == std::errc::invalid_argument || !ends || numbers.size() == most)
      return std::nullopt;
    numbers.push_back(value);
    at = next;
  }
}

std::vector<double> DecodeNumbers(std::string_view bytes, const VtkType& type, bool big_endian) {
  std::vector<double> numbers(bytes.size() / type.bytes);
  std::array<char, 8> turned{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::string_view number = bytes.substr(i * type.bytes, type.bytes);
    if (big_endian) {
      std::reverse_copy(number.begin(), number.end(), turned.begin());
      number = {turned.data(), type.bytes};
    }
    numbers[i] = NumberFrom(number, type);
  }
  return numbers;
}

std::optional<std::string> DecodeBase64(std::string_view text, std::size_t most_bytes,
                                        std::size_t* end) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  std::size_t at = 0;
  for (; at < text.size(); ++at) {
    if (IsSpace(text[at])) continue;
    const int digit = Base64Digit(text[at]);
    if (digit < 0) break;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    if (bytes.size() == most_bytes) return std::nullopt;
    bytes += static_cast<char>(bits >> count & 0xFFU);
  }
  while (at < text.size() && text[at] == '=') ++at;
  *end = at;
  return bytes;
}

}  // namespace pleinair::content
