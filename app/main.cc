#include <csignal>

#include "app/commands/command.h"

int main(int argc, char** argv) {
  // A file-size limit then makes the write fail with EFBIG, which is reported and cleaned up. By
  // default the signal kills the program between two files.
  std::signal(SIGXFSZ, SIG_IGN);
  return pleinair::app::RunCommandLine(argc, argv);
}
