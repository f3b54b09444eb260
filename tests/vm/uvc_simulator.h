#pragma once

#include <string>
#include <vector>

namespace pleinair::vm {

/// The simulated USB camera as a separate process. The destructor unplugs it.
class UvcSimulator {
 public:
  explicit UvcSimulator(const std::vector<std::string>& arguments = {});
  ~UvcSimulator();
  UvcSimulator(const UvcSimulator&) = delete;
  UvcSimulator& operator=(const UvcSimulator&) = delete;

  /// Sends one command: "unplug", "plug", "stall", "run", "err", "short".
  void Command(const std::string& line);

  /// Its output so far.
  std::string Output();

 private:
  int pid_ = -1;
  int input_ = -1;
  int output_ = -1;
  std::string printed_;
};

}  // namespace pleinair::vm
