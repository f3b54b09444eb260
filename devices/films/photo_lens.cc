#include "devices/films/photo_lens.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

#include "devices/films/exif.h"

namespace pleinair::devices {
namespace {

// EXIF data are at most 64 KiB long and follow the first marker.
constexpr std::size_t kBeginning = 80 * 1024;

PhotoLens LensOfFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string beginning(kBeginning, '\0');
  stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(stream.gcount()));
  constexpr std::string_view kJpeg = "\xFF\xD8";
  return beginning.starts_with(kJpeg) ? LensOfPhoto(beginning) : PhotoLens();
}

std::optional<double> PositiveNumber(const Exif& exif, int tag) {
  const std::optional<double> value = exif.Number(EXIF_IFD_EXIF, tag);
  return value && *value > 0.0 ? value : std::nullopt;
}

/// A number of each photograph; one where all are the same, none where one lacks it.
std::vector<double> OfAll(const std::vector<PhotoLens>& photos,
                          std::optional<double> PhotoLens::*number) {
  std::vector<double> numbers;
  numbers.reserve(photos.size());
  for (const PhotoLens& photo : photos) {
    if (!(photo.*number)) return {};
    numbers.push_back(*(photo.*number));
  }
  if (std::ranges::all_of(numbers, [&](double value) { return value == numbers.front(); })) {
    numbers.resize(1);
  }
  return numbers;
}

}  // namespace

PhotoLens LensOfPhoto(std::string_view jpeg) {
  PhotoLens lens;
  const std::optional<Exif> exif = Exif::In(jpeg);
  if (!exif) return lens;
  const auto focal_length_mm = PositiveNumber(*exif, EXIF_TAG_FOCAL_LENGTH);
  const auto f_number = PositiveNumber(*exif, EXIF_TAG_FNUMBER);
  if (focal_length_mm && f_number) lens.aperture_m = *focal_length_mm / *f_number * 1e-3;
  if (exif->IsInfinite(EXIF_IFD_EXIF, EXIF_TAG_SUBJECT_DISTANCE)) {
    lens.focus_dioptres = 0.0;
  } else if (const auto distance_m = PositiveNumber(*exif, EXIF_TAG_SUBJECT_DISTANCE)) {
    // Nearer than its own focal length no lens focuses.
    if (*distance_m > focal_length_mm.value_or(0.0) * 1e-3) lens.focus_dioptres = 1.0 / *distance_m;
  }
  lens.exposure_s = PositiveNumber(*exif, EXIF_TAG_EXPOSURE_TIME);
  return lens;
}

std::optional<scene::LensDescription> LensOfPhotos(std::span<const std::filesystem::path> files) {
  if (files.empty()) return std::nullopt;
  const PhotoLens first = LensOfFile(files.front());
  if (!first.aperture_m && !first.focus_dioptres && !first.exposure_s) return std::nullopt;
  scene::LensDescription lens;
  lens.aperture_m = first.aperture_m;
  if (!first.focus_dioptres && !first.exposure_s) return lens;
  std::vector<PhotoLens> photos(files.size());
  std::transform(files.begin(), files.end(), photos.begin(), LensOfFile);
  lens.focus_dioptres = OfAll(photos, &PhotoLens::focus_dioptres);
  lens.exposure_s = OfAll(photos, &PhotoLens::exposure_s);
  return lens;
}

}  // namespace pleinair::devices
