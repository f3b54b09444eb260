#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::devices {

/// What a container says of one packet of its film. Times are in ticks of the film's time base.
struct FilmPacket {
  std::optional<std::int64_t> shown;    ///< Presentation time.
  std::optional<std::int64_t> decoded;  ///< Decoding time.
  bool is_key = false;                  ///< Decoding can begin here.
  bool is_hidden = false;               ///< An edit list removes its frame; needed for others.
};

/// A fraction of a second.
struct FilmTimeBase {
  int numerator = 1;
  int denominator = 1;
};

/// Time stamps of all frames of a film in the order of display.
class FilmStamps {
 public:
  /// `packets` in the order of the file. Errors: no frames; two frames at one time; times that span
  /// more than kMaxSpan_s; a time base that is not positive.
  static Result<FilmStamps> Create(const std::vector<FilmPacket>& packets, FilmTimeBase time_base,
                                   const std::string& name);

  static constexpr double kMaxSpan_s = 1e8;  ///< Three years.

  std::size_t frames() const { return frames_; }
  /// False if the container gives no presentation times (AVI): frames are then known by their order
  /// only, and no seeking is possible.
  bool are_stored() const { return !ticks_.empty(); }

  /// Nanoseconds of a frame since the first one. Requires are_stored().
  std::int64_t Nanoseconds(std::size_t frame) const;
  /// The frame that is shown at a time in ticks. Nullopt: none is.
  std::optional<std::size_t> FrameAt(std::int64_t ticks) const;

  /// Where decoding must begin to reach a frame.
  struct Entry {
    std::size_t frame = 0;   ///< The key frame at or before it.
    std::int64_t ticks = 0;  ///< To seek: not after its decoding and its presentation.
  };
  /// The last entry at or before `frame`. Nullopt: the start of the film.
  std::optional<Entry> EntryFor(std::size_t frame) const;

  /// Frames per second by the median interval. Nullopt with fewer than two stored stamps.
  std::optional<double> TypicalRate_hz() const;
  /// Seconds from the container's time zero to the first frame; 0 unless stamps are stored.
  double start_s() const;

 private:
  std::size_t frames_ = 0;
  std::vector<std::int64_t> ticks_;  // Ascending; empty: not stored.
  std::vector<Entry> entries_;       // Ascending frames.
  FilmTimeBase time_base_;
};

}  // namespace pleinair::devices
