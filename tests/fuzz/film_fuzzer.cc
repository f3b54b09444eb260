// What a demuxer says of a film is hostile: any packets, matrices, color tags and metadata are
// rejected or give stamps, turns and places within their contracts. The first byte chooses.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "devices/films/display_turn.h"
#include "devices/films/film_colors.h"
#include "devices/films/film_stamps.h"
#include "devices/films/film_tags.h"
#include "devices/films/photo_lens.h"

namespace {

using pleinair::devices::DisplayTurn;
using pleinair::devices::FilmColors;
using pleinair::devices::FilmPacket;
using pleinair::devices::FilmStamps;

/// Numbers from the input; zero after its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  template <typename T>
  T Take() {
    T value{};
    const std::size_t count = std::min(sizeof(T), size_);
    std::memcpy(&value, data_, count);
    data_ += count;
    size_ -= count;
    return value;
  }
  std::size_t left() const { return size_; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

void Require(bool holds) {
  if (!holds) std::abort();
}

void TryStamps(Bytes in) {
  const auto numerator = in.Take<std::int32_t>();
  const auto denominator = in.Take<std::int32_t>();
  std::vector<FilmPacket> packets;
  while (in.left() > 0) {
    FilmPacket packet;
    const auto flags = in.Take<std::uint8_t>();
    packet.is_key = (flags & 1) != 0;
    packet.is_hidden = (flags & 2) != 0;
    if ((flags & 4) == 0) packet.shown = in.Take<std::int64_t>();
    if ((flags & 8) == 0) packet.decoded = in.Take<std::int64_t>();
    packets.push_back(packet);
  }
  const auto stamps = FilmStamps::Create(packets, {numerator, denominator}, "film");
  if (!stamps || !stamps->are_stored()) return;
  for (std::size_t i = 1; i < stamps->frames(); ++i) {
    Require(stamps->Nanoseconds(i) >= stamps->Nanoseconds(i - 1));
  }
  Require(static_cast<double>(stamps->Nanoseconds(stamps->frames() - 1)) <=
          FilmStamps::kMaxSpan_s * 1.001e9);
  for (std::size_t i = 0; i < stamps->frames(); ++i) {
    const auto entry = stamps->EntryFor(i);
    Require(!entry || entry->frame <= i);
  }
  const auto rate_hz = stamps->TypicalRate_hz();
  Require(!rate_hz || (std::isfinite(*rate_hz) && *rate_hz > 0.0));
}

void TryTurn(Bytes in) {
  const auto turn = DisplayTurn::FromMatrix(in.Take<std::array<std::int32_t, 9>>(), "film");
  if (!turn) return;
  pleinair::Image<std::uint8_t> image(5, 3, 3);
  for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = static_cast<std::uint8_t>(i);
  const auto shown = turn->Turned(image);
  Require(shown.size() == image.size());
  std::vector<std::uint8_t> pixels(shown.data(), shown.data() + shown.size());
  std::sort(pixels.begin(), pixels.end());
  Require(std::equal(pixels.begin(), pixels.end(), image.data()));
}

void TryColors(Bytes in) {
  const pleinair::devices::FilmColorTags tags{
      in.Take<std::int8_t>(), in.Take<std::int8_t>(), in.Take<std::int8_t>(),
      in.Take<std::uint8_t>() % 2 != 0, in.Take<std::uint8_t>() % 2 != 0};
  const auto colors = FilmColors::Create(tags, in.Take<std::uint16_t>(), "film");
  if (!colors) return;
  double before = -1.0;
  for (int i = 0; i <= 16; ++i) {
    const double light = colors->Light(i / 16.0);
    Require(std::isfinite(light) && light >= before);
    before = light;
  }
  Require(!colors->Text().empty());
}

void TryTags(std::string_view text) {
  if (const auto place = pleinair::devices::ParseIso6709(text)) {
    Require(std::abs(place->latitude_deg) <= 90.0 && std::abs(place->longitude_deg) <= 180.0);
  }
  static_cast<void>(pleinair::devices::TagsOfFilm({{"location", std::string(text)},
                                                   {"creation_time", std::string(text)},
                                                   {"model", std::string(text)}}));
  const auto lens = pleinair::devices::LensOfPhoto(text);
  Require(!lens.aperture_m || *lens.aperture_m > 0.0);
  Require(!lens.exposure_s || (*lens.exposure_s > 0.0 && std::isfinite(*lens.exposure_s)));
  Require(!lens.focus_dioptres ||
          (*lens.focus_dioptres >= 0.0 && std::isfinite(*lens.focus_dioptres)));
  const auto tags = pleinair::devices::TagsOfPhoto(text);
  Require(!tags.view_heading_deg || std::abs(*tags.view_heading_deg) <= 360.0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const Bytes rest(data + 1, size - 1);
  switch (data[0] % 4) {
    case 0:
      TryStamps(rest);
      break;
    case 1:
      TryTurn(rest);
      break;
    case 2:
      TryColors(rest);
      break;
    default:
      TryTags({reinterpret_cast<const char*>(data + 1), size - 1});
  }
  return 0;
}
