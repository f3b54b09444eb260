#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "content/flow/files/flow_file.h"
#include "content/flow/files/vtk_grid.h"
#include "content/flow/files/vtk_numbers.h"

namespace pleinair::content {
namespace {

/// Words and numbers of a legacy file.
class LegacyText {
 public:
  explicit LegacyText(std::string_view bytes) : bytes_(bytes) {}

  std::string_view Line() {
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    std::string_view line = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  /// The next word; empty at the end.
  std::string Word() {
    while (at_ < bytes_.size() && std::isspace(static_cast<unsigned char>(bytes_[at_]))) ++at_;
    const std::size_t start = at_;
    while (at_ < bytes_.size() && !std::isspace(static_cast<unsigned char>(bytes_[at_]))) ++at_;
    return std::string(bytes_.substr(start, std::min<std::size_t>(at_ - start, 200)));
  }

  std::optional<double> Number() {
    const auto numbers = ParseNumbers(Word(), 1);
    if (!numbers || numbers->size() != 1) return std::nullopt;
    return numbers->front();
  }

  std::optional<long long> Count() {
    const auto number = Number();
    if (!number || !(std::fabs(*number) < 1e15) || *number != std::floor(*number)) {
      return std::nullopt;
    }
    return static_cast<long long>(*number);
  }

  /// The next word without taking it.
  std::string Peek() {
    const std::size_t at = at_;
    std::string word = Word();
    at_ = at;
    return word;
  }

  /// Numbers of an array; binary ones begin on the next line and are big-endian.
  std::optional<std::vector<double>> Numbers(std::size_t count, const VtkType& type, bool binary) {
    if (binary) {
      Line();
      if (count > (bytes_.size() - at_) / type.bytes) return std::nullopt;
      const std::string_view part = bytes_.substr(at_, count * type.bytes);
      at_ += part.size();
      return DecodeNumbers(part, type, true);
    }
    // A number takes two bytes at least.
    if (count > (bytes_.size() - at_) / 2 + 1) return std::nullopt;
    std::vector<double> numbers;
    numbers.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto number = Number();
      if (!number) return std::nullopt;
      numbers.push_back(*number);
    }
    return numbers;
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

std::string Upper(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return word;
}

/// A parser of one file.
class LegacyParser {
 public:
  LegacyParser(std::string_view bytes, std::string where)
      : text_(bytes), where_(std::move(where)) {}

  Result<VtkGrid> Parse();

 private:
  tl::unexpected<Error> Bad(const std::string& what) const {
    return InputError(where_, what, kVtkRemedy);
  }
  Result<void> ParseGeometry(const std::string& key);
  Result<void> ParseData(const std::string& key);
  Result<void> AddArray(std::string name, std::size_t tuples, int components,
                        const std::string& type);
  Result<Vec3> Triple(const std::string& key) {
    const auto x = text_.Number(), y = text_.Number(), z = text_.Number();
    if (!x || !y || !z) return Bad(key + " has no three numbers");
    return Vec3{*x, *y, *z};
  }

  LegacyText text_;
  std::string where_;
  bool binary_ = false;
  VtkGrid grid_;
  VtkArrays* data_ = nullptr;
  std::size_t tuples_ = 0;
};

Result<void> LegacyParser::ParseGeometry(const std::string& key) {
  if (key == "DIMENSIONS") {
    std::array<long long, 3> counts{};
    for (long long& count : counts) {
      const auto number = text_.Count();
      if (!number) return Bad("DIMENSIONS has no three numbers");
      count = *number;
    }
    return SetCounts(counts, where_, &grid_);
  }
  if (key == "ORIGIN") {
    PLEINAIR_ASSIGN_OR_RETURN(grid_.origin, Triple(key));
    return {};
  }
  if (key == "SPACING" || key == "ASPECT_RATIO") {
    PLEINAIR_ASSIGN_OR_RETURN(grid_.spacing, Triple(key));
    return {};
  }
  const auto count = text_.Count();
  const auto type = VtkTypeOf(text_.Word());
  const bool is_points = key == "POINTS";
  const auto axis = static_cast<std::size_t>(is_points ? 0 : key[0] - 'X');
  const std::size_t expected =
      is_points ? grid_.PointCount() : static_cast<std::size_t>(grid_.counts[axis]);
  if (!count || !type || *count != static_cast<long long>(expected)) {
    return Bad(key + " do not fit DIMENSIONS");
  }
  auto numbers = text_.Numbers(expected * (is_points ? 3 : 1), *type, binary_);
  if (!numbers) return Bad(key + " are cut short or no numbers");
  if (!is_points) {
    grid_.coordinates[axis] = std::move(*numbers);
    return {};
  }
  for (std::size_t i = 0; i < numbers->size(); i += 3) {
    grid_.points.push_back({(*numbers)[i], (*numbers)[i + 1], (*numbers)[i + 2]});
  }
  return {};
}

Result<void> LegacyParser::AddArray(std::string name, std::size_t tuples, int components,
                                    const std::string& type_name) {
  const auto type = VtkTypeOf(type_name);
  if (!type || components < 1 || components > 9) {
    return Bad("array \"" + name.substr(0, 60) + "\" has an unknown type or number of components");
  }
  auto numbers = text_.Numbers(tuples * static_cast<std::size_t>(components), *type, binary_);
  if (!numbers) return Bad("array \"" + name.substr(0, 60) + "\" is cut short or no numbers");
  if (data_ == nullptr || tuples != tuples_) return {};
  data_->arrays.push_back(
      {std::move(name), components, std::move(*numbers), !(type->kind == 'f' && type->bytes == 4)});
  return {};
}

Result<void> LegacyParser::ParseData(const std::string& key) {
  if (key == "FIELD") {
    text_.Word();
    const auto count = text_.Count();
    if (!count || *count < 0 || *count > 10000) return Bad("FIELD has no number of arrays");
    for (long long i = 0; i < *count; ++i) {
      const std::string name = text_.Word();
      const auto components = text_.Count(), tuples = text_.Count();
      const std::string type = text_.Word();
      if (!components || !tuples || *tuples < 0 || *components < 1 || *components > 9 ||
          *tuples > static_cast<long long>(kMaxFieldNodes)) {
        return Bad("FIELD has an array without counts");
      }
      PLEINAIR_RETURN_IF_ERROR(
          AddArray(name, static_cast<std::size_t>(*tuples), static_cast<int>(*components), type));
      if (Upper(text_.Peek()) == "METADATA") {
        text_.Word();
        text_.Line();
        while (!text_.Line().empty()) {
        }
      }
    }
    return {};
  }
  const std::string name = text_.Word(), type = text_.Word();
  if (key == "VECTORS") {
    if (data_ != nullptr && data_->active_vectors.empty()) data_->active_vectors = name;
    return AddArray(name, tuples_, 3, type);
  }
  if (key == "NORMALS") return AddArray(name, tuples_, 3, type);
  if (key == "TENSORS") return AddArray(name, tuples_, 9, type);
  int components = 1;
  const auto stated = ParseNumbers(text_.Peek(), 1);
  if (stated && stated->size() == 1) {
    components = static_cast<int>(std::clamp(stated->front(), 0.0, 99.0));
    text_.Word();
  }
  if (Upper(text_.Peek()) == "LOOKUP_TABLE") {
    text_.Word();
    text_.Word();
  }
  return AddArray(name, tuples_, components, type);
}

Result<VtkGrid> LegacyParser::Parse() {
  if (!text_.Line().starts_with("# vtk DataFile")) return Bad("is no VTK file");
  text_.Line();
  const std::string encoding = Upper(text_.Word());
  if (encoding != "ASCII" && encoding != "BINARY") return Bad("is neither ASCII nor BINARY");
  binary_ = encoding == "BINARY";
  std::string kind;
  for (std::string key = Upper(text_.Word()); !key.empty(); key = Upper(text_.Word())) {
    if (key == "DATASET") {
      kind = Upper(text_.Word());
      if (kind != "STRUCTURED_POINTS" && kind != "RECTILINEAR_GRID" && kind != "STRUCTURED_GRID") {
        return Bad("has data of the kind " + kind.substr(0, 40) +
                   "; structured points, rectilinear and structured grids are read");
      }
    } else if (key == "DIMENSIONS" || key == "ORIGIN" || key == "SPACING" ||
               key == "ASPECT_RATIO" || key == "POINTS" || key == "X_COORDINATES" ||
               key == "Y_COORDINATES" || key == "Z_COORDINATES") {
      PLEINAIR_RETURN_IF_ERROR(ParseGeometry(key));
    } else if (key == "POINT_DATA" || key == "CELL_DATA") {
      const bool points = key == "POINT_DATA";
      data_ = points ? &grid_.point_data : &grid_.cell_data;
      tuples_ = points ? grid_.PointCount() : grid_.CellCount();
      if (text_.Count() != static_cast<long long>(tuples_)) {
        return Bad(key + " does not fit DIMENSIONS");
      }
    } else if (key == "VECTORS" || key == "SCALARS" || key == "NORMALS" || key == "TENSORS" ||
               key == "FIELD") {
      PLEINAIR_RETURN_IF_ERROR(ParseData(key));
    } else if (key == "METADATA") {
      text_.Line();
      while (!text_.Line().empty()) {
      }
    } else {
      return Bad("has \"" + key.substr(0, 40) + "\", which is not read");
    }
  }
  if (kind.empty()) return Bad("has no DATASET");
  const bool has_coordinates =
      kind == "STRUCTURED_POINTS" || (kind == "STRUCTURED_GRID" && !grid_.points.empty()) ||
      (kind == "RECTILINEAR_GRID" && std::all_of(grid_.coordinates.begin(), grid_.coordinates.end(),
                                                 [](const auto& axis) { return !axis.empty(); }));
  if (!has_coordinates) return Bad("has no coordinates of its points");
  return std::move(grid_);
}

}  // namespace

Result<VtkGrid> ParseVtkLegacy(std::string_view bytes, const std::string& where) {
  return LegacyParser(bytes, where).Parse();
}

}  // namespace pleinair::content
