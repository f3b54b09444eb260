#pragma once

#include <string>
#include <vector>

namespace pleinair::shadows {

/// A file of docs/examples/tree_and_body.
struct ExampleModel {
  std::string file;  ///< "tree.obj".
  std::string text;  ///< Wavefront OBJ, z up, metres.
};

/// A small tree with large leaves and a four-legged body, the shapes of TreesScene(), for the
/// situation of Kolivand & Sunar 2014, Figures 13 and 14, in a recording. Deterministic.
std::vector<ExampleModel> TreeAndBody();

}  // namespace pleinair::shadows
