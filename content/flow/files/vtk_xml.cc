#include <cpl_conv.h>
#include <cpl_minixml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include "content/flow/files/flow_file.h"
#include "content/flow/files/vtk_grid.h"
#include "content/flow/files/vtk_numbers.h"
#include "content/georeference/gdal_handles.h"

namespace pleinair::content {
namespace {

struct XmlDeleter {
  void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};
using Xml = std::unique_ptr<CPLXMLNode, XmlDeleter>;

std::string Attribute(const CPLXMLNode* node, const char* name) {
  return std::string(CPLGetXMLValue(node, name, "")).substr(0, 200);
}

/// How the arrays of a file are stored.
struct Storage {
  std::string where;
  bool big_endian = false;
  std::size_t header_bytes = 4;
  bool compressed = false;
  std::string_view appended;  ///< Behind the underscore.
  bool appended_raw = false;
};

tl::unexpected<Error> BadArray(const Storage& storage, const std::string& name,
                               const std::string& what) {
  return InputError(storage.where, "array \"" + name.substr(0, 60) + "\" " + what, kVtkRemedy);
}

std::uint64_t HeaderNumber(const Storage& storage, std::string_view bytes, std::size_t number) {
  const VtkType type{storage.header_bytes, 'u'};
  const std::size_t at = number * storage.header_bytes;
  if (at + storage.header_bytes > bytes.size()) return 0;
  const std::string_view part = bytes.substr(at, storage.header_bytes);
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < type.bytes; ++i) {
    const std::size_t from = storage.big_endian ? i : type.bytes - 1 - i;
    value = value << 8U | static_cast<unsigned char>(part[from]);
  }
  return value;
}

/// Inflates the blocks behind a header; unset: damaged, or more than `most` bytes.
std::optional<std::string> Inflate(const Storage& storage, std::string_view header,
                                   std::string_view blocks, std::size_t most) {
  const std::uint64_t count = HeaderNumber(storage, header, 0);
  const std::uint64_t size = HeaderNumber(storage, header, 1);
  const std::uint64_t last = HeaderNumber(storage, header, 2);
  std::string bytes;
  std::size_t at = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t packed = HeaderNumber(storage, header, 3 + i);
    const std::uint64_t plain = i + 1 == count && last > 0 ? last : size;
    if (packed > blocks.size() - at || plain > most - bytes.size()) return std::nullopt;
    const std::size_t start = bytes.size();
    bytes.resize(start + plain);
    std::size_t got = 0;
    if (plain > 0 &&
        (CPLZLibInflate(blocks.data() + at, packed, &bytes[start], plain, &got) == nullptr ||
         got != plain)) {
      return std::nullopt;
    }
    at += packed;
  }
  return bytes;
}

/// The bytes of an array; `most`: what its points need. `raw`: else base64.
std::optional<std::string> BytesOf(const Storage& storage, std::string_view data, bool raw,
                                   std::size_t most) {
  const std::size_t h = storage.header_bytes;
  if (!storage.compressed) {
    if (raw) {
      const std::uint64_t size = HeaderNumber(storage, data, 0);
      if (data.size() < h || size > data.size() - h || size > most) return std::nullopt;
      return std::string(data.substr(h, size));
    }
    std::size_t end = 0;
    auto bytes = DecodeBase64(data, most + h, &end);
    if (!bytes || bytes->size() < h) return std::nullopt;
    const std::uint64_t size = HeaderNumber(storage, *bytes, 0);
    if (size > bytes->size() - h) {
      // The header may be encoded alone.
      std::size_t ignored = 0;
      bytes = DecodeBase64(data.substr(end), most, &ignored);
      if (!bytes || size > bytes->size()) return std::nullopt;
      return bytes->substr(0, size);
    }
    return bytes->substr(h, size);
  }
  const std::uint64_t max_blocks = most / 1024 + 16;
  if (raw) {
    const std::uint64_t count = HeaderNumber(storage, data, 0);
    if (count > max_blocks || data.size() < (3 + count) * h) return std::nullopt;
    return Inflate(storage, data.substr(0, (3 + count) * h), data.substr((3 + count) * h), most);
  }
  std::size_t end = 0;
  const auto header = DecodeBase64(data, (3 + max_blocks) * h + 2, &end);
  if (!header || header->size() < 3 * h ||
      HeaderNumber(storage, *header, 0) > header->size() / h - 3) {
    return std::nullopt;
  }
  std::size_t ignored = 0;
  const auto blocks = DecodeBase64(data.substr(end), most + most / 100 + 65536, &ignored);
  if (!blocks) return std::nullopt;
  return Inflate(storage, *header, *blocks, most);
}

/// Reads a DataArray with `count` tuples.
Result<VtkArray> ReadArray(const Storage& storage, const CPLXMLNode* node, std::size_t count) {
  VtkArray array;
  array.name = Attribute(node, "Name");
  const std::string components = Attribute(node, "NumberOfComponents");
  array.components = components.empty() ? 1 : std::atoi(components.c_str());
  const auto type = VtkTypeOf(Attribute(node, "type"));
  if (!type || array.components < 1 || array.components > 9) {
    return BadArray(storage, array.name, "has an unknown type or number of components");
  }
  array.is_double = !(type->kind == 'f' && type->bytes == 4);
  const std::size_t values = count * static_cast<std::size_t>(array.components);
  const std::size_t most = values * type->bytes;
  const std::string format = Attribute(node, "format");
  if (format == "ascii" || format.empty()) {
    auto numbers = ParseNumbers(CPLGetXMLValue(node, nullptr, ""), values);
    if (!numbers) {
      return BadArray(storage, array.name, "has text that is no number, or too many numbers");
    }
    array.values = std::move(*numbers);
  } else {
    std::string_view data;
    const bool is_appended = format == "appended";
    if (is_appended) {
      const std::string offset = Attribute(node, "offset");
      std::uint64_t at = 0;
      std::from_chars(offset.data(), offset.data() + offset.size(), at);
      if (at >= storage.appended.size()) {
        return BadArray(storage, array.name, "lies behind the end of the file");
      }
      data = storage.appended.substr(at);
    } else {
      data = CPLGetXMLValue(node, nullptr, "");
    }
    const auto bytes = BytesOf(storage, data, is_appended && storage.appended_raw, most);
    if (!bytes) return BadArray(storage, array.name, "is damaged");
    array.values = DecodeNumbers(*bytes, *type, storage.big_endian);
  }
  if (array.values.size() != values) {
    return BadArray(storage, array.name,
                    "has " + std::to_string(array.values.size()) +
                        " numbers where the grid needs " + std::to_string(values));
  }
  return array;
}

Result<VtkArrays> ReadArrays(const Storage& storage, const CPLXMLNode* data, std::size_t count) {
  VtkArrays arrays;
  if (data == nullptr) return arrays;
  arrays.active_vectors = Attribute(data, "Vectors");
  for (const CPLXMLNode* node = data->psChild; node != nullptr; node = node->psNext) {
    if (node->eType != CXT_Element || std::strcmp(node->pszValue, "DataArray") != 0) continue;
    if (!VtkTypeOf(Attribute(node, "type"))) continue;  // Text.
    PLEINAIR_ASSIGN_OR_RETURN(VtkArray array, ReadArray(storage, node, count));
    arrays.arrays.push_back(std::move(array));
  }
  return arrays;
}

std::optional<std::vector<double>> NumbersOf(const CPLXMLNode* node, const char* name,
                                             std::size_t count) {
  auto numbers = ParseNumbers(Attribute(node, name), count);
  if (!numbers || numbers->size() != count) return std::nullopt;
  return numbers;
}

/// The arrays of coordinates of a rectilinear grid, or the points of a structured one.
Result<void> ReadCoordinates(const Storage& storage, const CPLXMLNode* piece,
                             const std::string& type, VtkGrid* grid) {
  const bool rectilinear = type == "RectilinearGrid";
  const CPLXMLNode* node =
      CPLGetXMLNode(const_cast<CPLXMLNode*>(piece), rectilinear ? "Coordinates" : "Points");
  std::size_t axis = 0;
  for (node = node != nullptr ? node->psChild : nullptr; node != nullptr; node = node->psNext) {
    if (node->eType != CXT_Element || std::strcmp(node->pszValue, "DataArray") != 0) continue;
    if (axis >= 3) break;
    PLEINAIR_ASSIGN_OR_RETURN(
        const VtkArray array,
        ReadArray(storage, node,
                  rectilinear ? static_cast<std::size_t>(grid->counts[axis]) : grid->PointCount()));
    if (array.components != (rectilinear ? 1 : 3)) {
      return BadArray(storage, array.name, "has another number of components than coordinates");
    }
    if (rectilinear) {
      grid->coordinates[axis++] = array.values;
      continue;
    }
    grid->points.reserve(grid->PointCount());
    for (std::size_t i = 0; i < array.values.size(); i += 3) {
      grid->points.push_back({array.values[i], array.values[i + 1], array.values[i + 2]});
    }
    return {};
  }
  if (axis == 3) return {};
  return InputError(storage.where, "has no coordinates of its points", kVtkRemedy);
}

}  // namespace

std::size_t VtkGrid::PointCount() const {
  return static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1]) *
         static_cast<std::size_t>(counts[2]);
}

std::size_t VtkGrid::CellCount() const {
  std::size_t cells = 1;
  for (const int count : counts) cells *= static_cast<std::size_t>(std::max(1, count - 1));
  return cells;
}

Result<void> SetCounts(const std::array<long long, 3>& counts, const std::string& where,
                       VtkGrid* grid) {
  double points = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    points *= static_cast<double>(counts[a]);
    if (counts[a] < 1 || !(points <= static_cast<double>(kMaxFieldNodes))) {
      return InputError(where,
                        "has a grid of " + std::to_string(counts[0]) + " x " +
                            std::to_string(counts[1]) + " x " + std::to_string(counts[2]) +
                            " points",
                        "cut out what lies near the marker: at most " +
                            std::to_string(kMaxFieldNodes) + " points are read");
    }
    grid->counts[a] = static_cast<int>(counts[a]);
  }
  return {};
}

Result<VtkGrid> ParseVtkXml(std::string_view bytes, const std::string& where) {
  const QuietErrors quiet;
  Storage storage;
  storage.where = where;
  // Raw bytes behind the underscore are no XML: the tree ends before them.
  std::string text;
  const std::size_t appended = bytes.find("<AppendedData");
  if (appended != std::string_view::npos) {
    const std::size_t open = bytes.find('>', appended);
    const std::size_t underscore = open == std::string_view::npos ? open : bytes.find('_', open);
    if (underscore == std::string_view::npos) {
      return InputError(where, "is damaged: its appended data has no start", kVtkRemedy);
    }
    storage.appended = bytes.substr(underscore + 1);
    storage.appended_raw =
        bytes.substr(appended, open - appended).find("\"raw\"") != std::string_view::npos;
    text = std::string(bytes.substr(0, appended)) + "</VTKFile>";
  } else {
    text = std::string(bytes);
  }
  if (text.find('\0') != std::string::npos) {
    return InputError(where, "is no VTK file in XML", kVtkRemedy);
  }
  const Xml tree(CPLParseXMLString(text.c_str()));
  text.clear();
  const CPLXMLNode* root = tree ? CPLGetXMLNode(tree.get(), "=VTKFile") : nullptr;
  if (root == nullptr) {
    return InputError(where, "is no VTK file in XML: " + QuietErrors::Last("it has no VTKFile"),
                      kVtkRemedy);
  }
  const std::string type = Attribute(root, "type");
  if (type != "ImageData" && type != "RectilinearGrid" && type != "StructuredGrid") {
    return InputError(where,
                      "has data of the kind \"" + type.substr(0, 40) +
                          "\"; image data, rectilinear and structured grids are read",
                      kVtkRemedy);
  }
  storage.big_endian = Attribute(root, "byte_order") == "BigEndian";
  storage.header_bytes = Attribute(root, "header_type") == "UInt64" ? 8 : 4;
  const std::string compressor = Attribute(root, "compressor");
  storage.compressed = !compressor.empty();
  if (storage.compressed && compressor != "vtkZLibDataCompressor") {
    return InputError(where, "is compressed by " + compressor,
                      "export it with zlib or uncompressed");
  }
  const CPLXMLNode* data = CPLGetXMLNode(const_cast<CPLXMLNode*>(root), type.c_str());
  const CPLXMLNode* piece = nullptr;
  int pieces = 0;
  for (const CPLXMLNode* node = data != nullptr ? data->psChild : nullptr; node != nullptr;
       node = node->psNext) {
    if (node->eType != CXT_Element || std::strcmp(node->pszValue, "Piece") != 0) continue;
    piece = node;
    ++pieces;
  }
  if (pieces != 1) {
    return InputError(where, "has " + std::to_string(pieces) + " pieces; one is read", kVtkRemedy);
  }
  const auto extent = NumbersOf(piece, "Extent", 6);
  if (!extent) return InputError(where, "states no extent of its grid", kVtkRemedy);
  VtkGrid grid;
  std::array<long long, 3> counts{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double count = (*extent)[2 * a + 1] - (*extent)[2 * a] + 1.0;
    counts[a] = std::fabs(count) < 1e9 ? std::llround(count) : 0;
  }
  PLEINAIR_RETURN_IF_ERROR(SetCounts(counts, where, &grid));
  if (type == "ImageData") {
    const auto origin = NumbersOf(data, "Origin", 3), spacing = NumbersOf(data, "Spacing", 3);
    const std::string direction = Attribute(data, "Direction");
    const auto identity = ParseNumbers(direction, 9);
    if (!origin || !spacing ||
        (!direction.empty() &&
         identity != std::vector<double>{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0})) {
      return InputError(where, "states no origin and spacing, or a turned grid", kVtkRemedy);
    }
    grid.spacing = {(*spacing)[0], (*spacing)[1], (*spacing)[2]};
    grid.origin = {(*origin)[0] + (*extent)[0] * grid.spacing.x,
                   (*origin)[1] + (*extent)[2] * grid.spacing.y,
                   (*origin)[2] + (*extent)[4] * grid.spacing.z};
  } else {
    PLEINAIR_RETURN_IF_ERROR(ReadCoordinates(storage, piece, type, &grid));
  }
  CPLXMLNode* of_piece = const_cast<CPLXMLNode*>(piece);
  PLEINAIR_ASSIGN_OR_RETURN(
      grid.point_data,
      ReadArrays(storage, CPLGetXMLNode(of_piece, "PointData"), grid.PointCount()));
  PLEINAIR_ASSIGN_OR_RETURN(
      grid.cell_data, ReadArrays(storage, CPLGetXMLNode(of_piece, "CellData"), grid.CellCount()));
  return grid;
}

}  // namespace pleinair::content
