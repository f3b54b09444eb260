#pragma once

#include <string>

#include "content/flow/files/flow_file.h"
#include "content/flow/line_integrator.h"

namespace pleinair::app {

/// How `pleinair flow` integrates.
enum class FlowMethod { kRk45, kHierarchical, kHierarchicalNearest };

/// The options of `pleinair flow` as the user typed them.
struct FlowArguments {
  std::string file, output, time, seeds, scene;
  content::FlowFileOptions read;
  content::TraceOptions trace;
  FlowMethod method = FlowMethod::kRk45;
  double spacing_m = 0.0;  ///< 0: not given.
  int steps = 0;           ///< 0: not given.
  bool json = false;
};

}  // namespace pleinair::app
