// Composes a recording: prints where the camera stands in each frame and writes the frames with the
// virtual objects in them. Usage: track_and_compose RECORDING FOLDER
#include <pleinair/pleinair.h>
#include <cstdio>
#include <filesystem>

int main(int argc, char** argv) {
  if (argc != 3) return std::fputs("Usage: track_and_compose RECORDING FOLDER\n", stderr), 2;
  const std::filesystem::path folder = argv[2];
  std::filesystem::create_directories(folder);
  const auto write = [&](const pleinair::devices::Frame& frame,
                         const pleinair::session::ComposedFrame& composed) {
    if (composed.pose) {
      const auto& t = composed.pose->observation.camera_from_marker.translation_m;
      std::printf("frame %d: the marker lies at %.6f %.6f %.6f m\n", static_cast<int>(frame.index),
                  t.x, t.y, t.z);
    }
    char name[16];
    std::snprintf(name, sizeof name, "%04d.png", static_cast<int>(frame.index));
    return pleinair::exports::WritePng(folder / name, composed.image.view());
  };
  const auto done = pleinair::session::ComposeRecording(argv[1], {}, write);
  if (!done) std::fprintf(stderr, "%s\n", done.error().Message().c_str());
  return done ? 0 : 2;
}
