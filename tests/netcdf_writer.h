#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pleinair::tests {

/// Writes classic NetCDF files (CDF-1) by the format's specification.
class NetCdfWriter {
 public:
  enum class Type { kShort = 3, kFloat = 5, kDouble = 6 };
  using Texts = std::vector<std::pair<std::string, std::string>>;
  using Numbers = std::vector<std::pair<std::string, double>>;  // In the type of the variable.

  struct Variable {
    std::string name;
    std::vector<std::string> dimensions;
    std::vector<double> values;
    Texts texts = {};
    Numbers numbers = {};
    Type type = Type::kDouble;
  };

  void AddDimension(const std::string& name, std::size_t size) {
    dimensions_.push_back({name, size});
  }
  void AddVariable(Variable variable) { variables_.push_back(std::move(variable)); }
  /// A dimension with its coordinate variable.
  void AddAxis(const std::string& name, const std::vector<double>& nodes, const Texts& texts,
               Type type = Type::kDouble) {
    AddDimension(name, nodes.size());
    AddVariable({name, {name}, nodes, texts, {}, type});
  }

  std::string Bytes() const {
    std::string data;
    const std::size_t header = Header(std::vector<std::uint32_t>(variables_.size())).size();
    std::vector<std::uint32_t> begins;
    for (const Variable& variable : variables_) {
      begins.push_back(static_cast<std::uint32_t>(header + data.size()));
      for (const double value : variable.values) Put(variable.type, value, &data);
      Pad(&data);
    }
    return Header(begins) + data;
  }

 private:
  static void Put32(std::uint32_t value, std::string* out) {
    for (int shift = 24; shift >= 0; shift -= 8) *out += static_cast<char>(value >> shift & 0xFFU);
  }
  static void Put(Type type, double value, std::string* out) {
    if (type == Type::kFloat)
      return Put32(std::bit_cast<std::uint32_t>(static_cast<float>(value)), out);
    if (type == Type::kShort) {
      const auto number = static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(value)));
      *out += static_cast<char>(number >> 8);
      *out += static_cast<char>(number & 0xFFU);
      return;
    }
    const auto bits = std::bit_cast<std::uint64_t>(value);
    Put32(static_cast<std::uint32_t>(bits >> 32U), out);
    Put32(static_cast<std::uint32_t>(bits), out);
  }
  static void Pad(std::string* out) { out->resize((out->size() + 3) / 4 * 4, '\0'); }
  static void PutName(const std::string& name, std::string* out) {
    Put32(static_cast<std::uint32_t>(name.size()), out);
    *out += name;
    Pad(out);
  }
  static std::size_t SizeOf(Type type) {
    return type == Type::kShort ? 2 : (type == Type::kFloat ? 4 : 8);
  }

  std::string Header(const std::vector<std::uint32_t>& begins) const {
    std::string out("CDF\x01", 4);
    Put32(0, &out);   // No records.
    Put32(10, &out);  // Dimensions.
    Put32(static_cast<std::uint32_t>(dimensions_.size()), &out);
    for (const auto& [name, size] : dimensions_) {
      PutName(name, &out);
      Put32(static_cast<std::uint32_t>(size), &out);
    }
    Put32(0, &out);
    Put32(0, &out);   // No global attributes.
    Put32(11, &out);  // Variables.
    Put32(static_cast<std::uint32_t>(variables_.size()), &out);
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      const Variable& variable = variables_[i];
      PutName(variable.name, &out);
      Put32(static_cast<std::uint32_t>(variable.dimensions.size()), &out);
      for (const std::string& name : variable.dimensions) {
        const auto found = std::find_if(dimensions_.begin(), dimensions_.end(),
                                        [&](const auto& each) { return each.first == name; });
        Put32(static_cast<std::uint32_t>(found - dimensions_.begin()), &out);
      }
      Put32(12, &out);  // Attributes.
      Put32(static_cast<std::uint32_t>(variable.texts.size() + variable.numbers.size()), &out);
      for (const auto& [name, text] : variable.texts) {
        PutName(name, &out);
        Put32(2, &out);
        PutName(text, &out);
      }
      for (const auto& [name, number] : variable.numbers) {
        // Scales are doubles, whatever the variable is.
        const bool scale = name == "scale_factor" || name == "add_offset";
        const Type type = scale ? Type::kDouble : variable.type;
        PutName(name, &out);
        Put32(static_cast<std::uint32_t>(type), &out);
        Put32(1, &out);
        Put(type, number, &out);
        Pad(&out);
      }
      Put32(static_cast<std::uint32_t>(variable.type), &out);
      const std::size_t bytes = variable.values.size() * SizeOf(variable.type);
      Put32(static_cast<std::uint32_t>((bytes + 3) / 4 * 4), &out);
      Put32(begins[i], &out);
    }
    return out;
  }

  std::vector<std::pair<std::string, std::size_t>> dimensions_;
  std::vector<Variable> variables_;
};

}  // namespace pleinair::tests
