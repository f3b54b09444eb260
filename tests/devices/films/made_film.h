#pragma once

extern "C" {
#include <libavutil/frame.h>
}

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pleinair::tests {

/// A film as a phone or a camera writes it.
struct MadeFilm {
  int width = 64, height = 48;
  std::string encoder = "libx264";
  std::string pixels = "yuv420p";
  int key_every = 8;
  /// Presentation times of the frames in units of 1 / `ticks_per_s`.
  std::vector<std::int64_t> ticks;
  int ticks_per_s = 30'000;
  /// ITU-T H.273 code points of primaries, transfer and matrix; 2: not stated.
  int primaries = 2, transfer = 2, matrix = 2;
  bool full_range = false;
  /// Linear part a, b, c, d of the display matrix.
  std::optional<std::array<double, 4>> display;
  /// Coded as AAC, or as another codec that the container takes.
  std::string sound_encoder;
  double sound_s = 0.0;
  std::vector<std::pair<std::string, std::string>> tags;
  std::vector<std::pair<std::string, std::string>> muxer_options;
};

/// Writes a film; the file's name gives the container. `draw` fills the planes of frame i. Throws
/// std::runtime_error where libav refuses.
void WriteFilm(const std::filesystem::path& file, const MadeFilm& film,
               const std::function<void(AVFrame*, int)>& draw);

/// Fills an 8-bit or 16-bit planar frame with one value per plane.
void FillPlanes(AVFrame* frame, int y, int u, int v);

/// Times of `frames` frames at 30000/1001 Hz in ticks of 1/30000 s.
std::vector<std::int64_t> NtscTicks(int frames);

}  // namespace pleinair::tests
