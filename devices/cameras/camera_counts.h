#pragma once

#include <cstdint>

#include "devices/frame_source.h"

namespace pleinair::devices {

/// Counts since the start.
struct CameraCounts {
  std::int64_t delivered = 0;
  FrameLoss loss;
  int connections = 0;
  int stalls = 0;
};

/// What a GigE camera's network did; nothing for others.
struct TransportCounts {
  std::int64_t completed = 0;
  std::int64_t damaged = 0;    ///< Frames with packets that never came.
  std::int64_t underruns = 0;  ///< Frames that found no free buffer.
  std::int64_t resent_packets = 0;
  std::int64_t missing_packets = 0;
  int packet_size = 0;
};

}  // namespace pleinair::devices
