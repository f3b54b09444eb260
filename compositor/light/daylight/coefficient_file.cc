#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <ios>
#include <string>
#include <system_error>

#include "base/atomic_file.h"
#include "compositor/light/daylight/daylight_coefficients.h"

namespace pleinair::compositor {
namespace {

namespace fs = std::filesystem;

/// File header in native byte order, because no other machine reads the file.
struct Header {
  std::array<char, 8> magic{'P', 'L', 'D', 'L', 'C', '0', '0', '1'};
  std::uint64_t hash = 0;
  std::uint64_t vertices = 0;
  std::int32_t patches = 0, division = 0, reflections = 0, reserved = 0;
  double up[3] = {};
  std::uint64_t checksum = 0;  ///< Covers all that follows.
};

std::uint64_t Checksum(const char* data, std::size_t size, std::uint64_t hash) {
  // FNV-1a by words: a hundred megabytes take some hundredths of a second.
  for (; size >= 8; data += 8, size -= 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, data, 8);
    hash = (hash ^ word) * 0x100000001B3ULL;
  }
  for (std::size_t i = 0; i < size; ++i) {
    hash = (hash ^ static_cast<unsigned char>(data[i])) * 0x100000001B3ULL;
  }
  return hash;
}

template <typename Visit>
void ForEachArray(DaylightCoefficients& coefficients, const Visit& visit) {
  for (CoefficientMatrix* matrix : {&coefficients.with, &coefficients.without}) {
    visit(reinterpret_cast<char*>(matrix->codes().data()), matrix->codes().size());
    visit(reinterpret_cast<char*>(matrix->scales().data()),
          matrix->scales().size() * sizeof(float));
  }
}

fs::path FileOf(const fs::path& folder, std::uint64_t hash) {
  std::array<char, 24> name{};
  std::snprintf(name.data(), name.size(), "%016llx.dlc", static_cast<unsigned long long>(hash));
  return folder / name.data();
}

}  // namespace

bool WriteCoefficients(const fs::path& folder, std::uint64_t hash,
                       const DaylightCoefficients& coefficients) {
  std::error_code error;
  fs::create_directories(folder, error);
  DaylightCoefficients copy = coefficients;
  Header header;
  header.hash = hash;
  header.vertices = copy.with.vertices();
  header.patches = copy.with.patches();
  header.division = copy.division;
  header.reflections = copy.reflections;
  header.up[0] = copy.up.x;
  header.up[1] = copy.up.y;
  header.up[2] = copy.up.z;
  std::uint64_t checksum = hash;
  std::string bytes(sizeof header, '\0');
  ForEachArray(copy, [&](const char* data, std::size_t size) {
    checksum = Checksum(data, size, checksum);
    bytes.append(data, size);
  });
  header.checksum = checksum;
  std::memcpy(bytes.data(), &header, sizeof header);
  return WriteFileAtomically(FileOf(folder, hash), bytes).has_value();
}

std::optional<DaylightCoefficients> ReadCoefficients(const fs::path& folder, std::uint64_t hash) {
  const fs::path file = FileOf(folder, hash);
  std::ifstream stream(file, std::ios::binary);
  Header header;
  const Header expected;
  if (!stream.read(reinterpret_cast<char*>(&header), sizeof header) ||
      header.magic != expected.magic || header.hash != hash || header.division < 1 ||
      header.division > 4) {
    return std::nullopt;
  }
  DaylightCoefficients coefficients;
  coefficients.division = header.division;
  coefficients.up = {header.up[0], header.up[1], header.up[2]};
  coefficients.reflections = header.reflections;
  coefficients.from_cache = true;
  if (header.patches != coefficients.Patches().total()) return std::nullopt;
  // The header's sizes must match the file's before memory is allocated.
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || header.vertices > size) return std::nullopt;
  const std::uint64_t tiles =
      (header.vertices + CoefficientMatrix::kLanes - 1) / CoefficientMatrix::kLanes *
      ((header.patches + CoefficientMatrix::kPatches - 1) / CoefficientMatrix::kPatches) *
      CoefficientMatrix::kPlanes;
  const std::uint64_t tile_bytes =
      CoefficientMatrix::kLanes * (CoefficientMatrix::kPatches + sizeof(float));
  if (size != sizeof header + 2 * tiles * tile_bytes) return std::nullopt;
  coefficients.with = CoefficientMatrix(header.vertices, header.patches);
  coefficients.without = CoefficientMatrix(header.vertices, header.patches);
  std::uint64_t checksum = hash;
  ForEachArray(coefficients, [&](char* data, std::size_t length) {
    stream.read(data, static_cast<std::streamsize>(length));
    checksum = Checksum(data, length, checksum);
  });
  if (!stream || checksum != header.checksum) return std::nullopt;
  return coefficients;
}

}  // namespace pleinair::compositor
