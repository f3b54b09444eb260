#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/drape/map_lines.h"
#include "content/draping/drape_lines.h"

namespace pleinair::app {

/// Wall-clock times, milliseconds.
struct DrapeTimes {
  double read = 0.0, project = 0.0, drape = 0.0;
};

/// One drape of a scene with its map draped.
struct DrapedMap {
  std::string file;
  MapLines map;
  content::DrapedPieces draped;
  /// For each piece and vertex whether a surface hides it from the camera; empty: no view is given.
  std::vector<std::vector<bool>> hidden;
  double max_chord_error_m = 0.0;  ///< Of the draped lines, from the surface below them.
};

/// The drapes of a scene, draped.
struct DrapedMaps {
  std::vector<DrapedMap> maps;
  std::string method;  ///< "exact" or "screen".
  DrapeTimes times;
};

/// A piece with its numbers in files: feature and part of the feature, from 0 on.
struct NumberedPiece {
  const DrapedMap* map = nullptr;
  std::size_t piece = 0;
  std::uint32_t feature = 0;
  std::size_t part = 0;

  const std::vector<content::DrapedVertex>& vertices() const {
    return map->draped.pieces[piece].vertices;
  }
  bool IsHidden(std::size_t vertex) const {
    return !map->hidden.empty() && map->hidden[piece][vertex];
  }
};

/// All pieces, in order.
std::vector<NumberedPiece> NumberedPieces(const DrapedMaps& maps);

}  // namespace pleinair::app
