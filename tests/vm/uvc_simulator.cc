#include "tests/vm/uvc_simulator.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

namespace pleinair::vm {

UvcSimulator::UvcSimulator(const std::vector<std::string>& arguments) {
  const char* program_name = std::getenv("UVC_SIM");
  int to[2], from[2];
  if (program_name == nullptr || pipe2(to, O_CLOEXEC) != 0 || pipe2(from, O_CLOEXEC) != 0)
    std::abort();
  std::vector<std::string> copies = arguments;
  copies.insert(copies.begin(), program_name);
  std::vector<char*> details;
  for (std::string& copy : copies) details.push_back(copy.data());
  details.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    // Other threads may have held locks: only calls that are safe in handlers of signals.
    dup2(to[0], STDIN_FILENO);
    dup2(from[1], STDOUT_FILENO);
    execv(details[0], details.data());
    _exit(127);
  }
  close(to[0]);
  close(from[1]);
  input_ = to[1];
  output_ = from[0];
  fcntl(output_, F_SETFL, O_NONBLOCK);
}

UvcSimulator::~UvcSimulator() {
  kill(pid_, SIGTERM);
  waitpid(pid_, nullptr, 0);
  close(input_);
  close(output_);
}

void UvcSimulator::Command(const std::string& line) {
  const std::string text = line + "\n";
  if (write(input_, text.data(), text.size()) < 0) std::abort();
}

std::string UvcSimulator::Output() {
  char bytes[4096];
  for (ssize_t count = 0; (count = read(output_, bytes, sizeof bytes)) > 0;) {
    printed_.append(bytes, static_cast<std::size_t>(count));
  }
  return printed_;
}

}  // namespace pleinair::vm
