// Writes the tree and the body of docs/examples/tree_and_body into a folder:
//
//   build/…/tree_and_body docs/examples/tree_and_body
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "shadows/bench/example_models.h"

int main(int argc, char** argv) {
  if (argc != 2 || !std::filesystem::is_directory(argv[1])) {
    std::fprintf(stderr,
                 "tree_and_body: give the folder that tree.obj and body.obj are written to\n");
    return 2;
  }
  for (const auto& model : pleinair::shadows::TreeAndBody()) {
    const std::filesystem::path file = std::filesystem::path(argv[1]) / model.file;
    std::ofstream out(file, std::ios::binary);
    out << model.text;
    if (!out.flush()) {
      std::fprintf(stderr, "tree_and_body: cannot write %s\n", file.string().c_str());
      return 1;
    }
  }
  return 0;
}
