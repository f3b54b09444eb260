#include <csignal>

#include "app/commands/command.h"

int main(int argc, char** argv) {
  // A file-size limit then fails the write with EFBIG, which is reported and cleaned up after,
  // instead of killing the program between two files.
  std::signal(SIGXFSZ, SIG_IGN);
  return pleinair::app::RunCommandLine(argc, argv);
}
