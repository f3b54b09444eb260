#pragma once

#include <string>
#include <vector>

namespace pleinair::vm {

/// The USB camera in software, as a process of its own; ends with this object, which unplugs it.
class UvcSimulator {
 public:
  explicit UvcSimulator(const std::vector<std::string>& arguments = {});
  ~UvcSimulator();
  UvcSimulator(const UvcSimulator&) = delete;
  UvcSimulator& operator=(const UvcSimulator&) = delete;

  /// One line to it: "unplug", "plug", "stall", "run", "err", "short".
  void Command(const std::string& line);

  /// All that it has printed so far.
  std::string Output();

 private:
  int pid_ = -1;
  int input_ = -1;
  int output_ = -1;
  std::string printed_;
};

}  // namespace pleinair::vm
