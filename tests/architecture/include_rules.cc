#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace pleinair::architecture {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string, std::less<>>;

/// Modules that each module may include, besides itself; in the order of docs/design.
const std::map<std::string, Names, std::less<>>& AllowedModules() {
  static const std::map<std::string, Names, std::less<>> kAllowed = {
      {"base", {}},
      {"files", {"base"}},
      {"sky", {"base"}},
      {"scene", {"base", "files", "sky"}},
      {"content", {"base", "files", "scene"}},
      {"devices", {"base", "files", "scene"}},
      {"tracker", {"base", "files"}},
      {"gl", {"base"}},
      {"shadows", {"base", "sky", "gl"}},
      {"compositor", {"base", "sky", "scene", "gl", "shadows"}},
      {"session",
       {"base", "files", "sky", "scene", "devices", "tracker", "gl", "shadows", "compositor"}},
      // Print sheets show the tracker's markers and calibration boards.
      {"export", {"base", "files", "scene", "devices", "tracker"}},
      {"pleinair",
       {"base", "files", "sky", "scene", "devices", "tracker", "compositor", "session", "export"}},
      {"accuracy", {"base", "tracker"}},
      {"app",
       {"base", "files", "sky", "scene", "content", "devices", "tracker", "gl", "shadows",
        "compositor", "session", "export", "accuracy"}},
  };
  return kAllowed;
}

/// The folders inside compositor, lowest first: a folder may include those before it.
constexpr std::array kCompositorFolders = {"leaf",     "models", "light",  "photometry", "surfaces",
                                           "coverage", "ink",    "passes", "lens",       "picture"};

/// Index of a file in that order. GLSL twins and plain options lie below all folders; the composer
/// lies above.
std::size_t CompositorFloor(const fs::path& file) {
  const fs::path in_compositor = file.lexically_relative("compositor");
  if (in_compositor == "composer_options.h" || in_compositor == "antialiasing.h") return 0;
  const std::string folder = in_compositor.has_parent_path() ? in_compositor.begin()->string() : "";
  if (folder == "shaders") return 0;
  const auto at = std::find(kCompositorFolders.begin(), kCompositorFolders.end(), folder);
  return 1 + static_cast<std::size_t>(at - kCompositorFolders.begin());
}

/// Libraries, identified by the prefix of an include.
struct Library {
  const char* name;
  std::vector<const char*> beginnings;
  Names forbidden_modules;           ///< Modules that may not include it.
  bool forbidden_in_public_headers;  ///< In public headers of every module except app, which has
                                     ///< none.
  const char* except_below = "";     ///< The folder that may include it; empty: none.
};

const std::vector<Library>& Libraries() {
  static const std::vector<Library> kLibraries = {
      {"OpenCV",
       {"opencv2/", "opencv4/"},
       {"base", "files", "sky", "scene", "gl", "shadows", "compositor", "session"},
       true},
      {"Ceres",
       {"ceres/"},
       {"base", "files", "sky", "scene", "gl", "shadows", "compositor", "devices", "session",
        "export"},
       true,
       "compositor/leaf/"},
      {"Eigen",
       {"Eigen/", "eigen3/", "unsupported/Eigen"},
       {"base", "files", "sky", "scene"},
       true},
      {"OpenGL",
       {"epoxy/", "GL/", "EGL/", "GLFW/"},
       {"base", "files", "scene", "devices", "tracker", "accuracy", "sky", "session", "export",
        "app"},
       false,
       "app/window/"},
      {"CLI11",
       {"CLI/"},
       {"base", "files", "sky", "scene", "devices", "tracker", "accuracy", "gl", "shadows",
        "compositor", "session", "export"},
       true},
      {"AprilTag",
       {"apriltag/"},
       {"base", "files", "sky", "scene", "devices", "gl", "shadows", "compositor", "session",
        "export"},
       true},
      {"a JSON, YAML or TOML library",
       {"nlohmann/", "yaml-cpp/", "toml"},
       {"base", "tracker", "accuracy", "sky", "gl", "shadows", "compositor", "session"},
       true},
      {"Embree",
       {"embree"},
       {"base", "files", "sky", "scene", "devices", "tracker", "accuracy", "gl", "session",
        "export"},
       true},
      {"PROJ or GDAL",
       {"proj.h", "geodesic.h", "gdal", "ogr_", "cpl_"},
       {"base", "files", "sky", "scene", "devices", "tracker", "accuracy", "gl", "shadows",
        "compositor", "session", "export", "app"},
       true},
  };
  return kLibraries;
}

/// Public headers: those directly in a module's folder. Helper headers between the .cc files of one
/// module may use library types if their first lines contain "// Internal: …".
bool IsPublicHeader(const fs::path& file, std::string_view text) {
  if (file.extension() != ".h") return false;
  const std::size_t first_include = text.find("#include");
  return text.substr(0, first_include).find("Internal:") == std::string_view::npos;
}

std::string ModuleOf(const fs::path& path) {
  return path.begin() == path.end() ? std::string() : path.begin()->string();
}

std::string WithoutComments(std::string_view text) {
  std::string code;
  for (std::size_t i = 0; i < text.size();) {
    if (text.substr(i, 2) == "//") {
      while (i < text.size() && text[i] != '\n') ++i;
    } else if (text.substr(i, 2) == "/*") {
      const std::size_t end = std::min(text.size(), text.find("*/", i + 2));
      code += std::string(std::count(text.begin() + i, text.begin() + end, '\n'), '\n');
      i = std::min(text.size(), end + 2);
    } else {
      code += text[i++];
    }
  }
  return code;
}

}  // namespace

std::vector<fs::path> FindSources(const fs::path& root) {
  std::vector<fs::path> files;
  for (const auto& [module, allowed] : AllowedModules()) {
    if (!fs::exists(root / module)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / module)) {
      static const Names kEndings = {".h", ".cc", ".glsl", ".vert", ".frag", ".geom", ".comp"};
      if (entry.is_regular_file() && kEndings.contains(entry.path().extension().string())) {
        files.push_back(fs::relative(entry.path(), root));
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<Include> ParseIncludes(std::string_view text) {
  std::vector<Include> includes;
  std::istringstream lines(WithoutComments(text));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::size_t at = line.find_first_not_of(" \t");
    if (at == std::string::npos || line[at] != '#') continue;
    at = line.find_first_not_of(" \t", at + 1);
    if (at == std::string::npos || line.compare(at, 7, "include") != 0) continue;
    const std::size_t open = line.find_first_of("\"<", at);
    if (open == std::string::npos) continue;
    const std::size_t close = line.find_first_of("\">", open + 1);
    if (close != std::string::npos) {
      includes.push_back({number, line.substr(open + 1, close - open - 1)});
    }
  }
  return includes;
}

std::vector<std::string> FindBreaches(const fs::path& file, std::string_view text) {
  std::vector<std::string> breaches;
  const std::string module = ModuleOf(file);
  const auto rule = AllowedModules().find(module);
  if (rule == AllowedModules().end()) return {file.string() + ": is in no module"};
  for (const Include& include : ParseIncludes(text)) {
    std::string what = file.string();
    what.append(":").append(std::to_string(include.line)).append(": includes ");
    what.append(include.path).append(": ");
    const std::string other = ModuleOf(include.path);
    if (AllowedModules().contains(other) && other != module && !rule->second.contains(other)) {
      std::string breach = what;
      breaches.push_back(breach.append(module).append(" may not know ").append(other));
    }
    if (module == "compositor" && other == module &&
        CompositorFloor(include.path) > CompositorFloor(file)) {
      breaches.push_back(
          what + "the folders of compositor are " +
          "models, light, photometry, surfaces, passes, picture, from the ground up");
    }
    if (include.path.find("..") != std::string::npos) {
      breaches.push_back(what + "paths are written from the root of the tree");
    }
    for (const Library& library : Libraries()) {
      const bool is_it =
          std::any_of(library.beginnings.begin(), library.beginnings.end(),
                      [&](const char* beginning) { return include.path.starts_with(beginning); });
      const std::string_view except = library.except_below;
      if (!is_it || (!except.empty() && file.generic_string().starts_with(except))) continue;
      if (library.forbidden_modules.contains(module)) {
        breaches.push_back(what + module + " may not know " + library.name);
      } else if (library.forbidden_in_public_headers && module != "app" &&
                 IsPublicHeader(file, text)) {
        breaches.push_back(what + "public headers may not show " + library.name);
      }
    }
  }
  return breaches;
}

std::vector<std::string> FindBreachesBelow(const fs::path& root) {
  std::vector<std::string> breaches;
  for (const fs::path& file : FindSources(root)) {
    std::ifstream in(root / file, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    const auto of_file = FindBreaches(file, text);
    breaches.insert(breaches.end(), of_file.begin(), of_file.end());
  }
  return breaches;
}

std::vector<std::string> HeadersReached(const fs::path& root, const std::string& header) {
  std::vector<std::string> reached = {header};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    std::ifstream in(root / reached[i], std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    for (const Include& include : ParseIncludes(text)) {
      const bool ours = AllowedModules().contains(ModuleOf(include.path));
      if (ours && std::find(reached.begin(), reached.end(), include.path) == reached.end()) {
        reached.push_back(include.path);
      }
    }
  }
  return reached;
}

UnitIncludes ReadUnitIncludes(const fs::path& root) {
  UnitIncludes units;
  const auto unit_of = [](fs::path file) { return file.replace_extension().generic_string(); };
  const auto is_unit = [](const fs::path& file) {
    return file.extension() == ".h" || file.extension() == ".cc";
  };
  for (const fs::path& file : FindSources(root)) {
    if (is_unit(file)) units[unit_of(file)];
  }
  for (const fs::path& file : FindSources(root)) {
    if (!is_unit(file)) continue;
    std::ifstream in(root / file, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    for (const Include& include : ParseIncludes(text)) {
      const std::string other = unit_of(include.path);
      if (other != unit_of(file) && units.contains(other)) units[unit_of(file)].insert(other);
    }
  }
  return units;
}

std::vector<std::vector<std::string>> FindLoops(const UnitIncludes& includes) {
  // Tarjan 1972, "Depth-first search and linear graph algorithms", section 4: LOWLINK.
  struct Visit {
    std::size_t number = 0, low_link = 0;
    bool on_stack = false;
  };
  std::map<std::string, Visit> visits;
  std::vector<std::string> stack;
  std::vector<std::vector<std::string>> loops;
  const auto visit = [&](const auto& self, const std::string& unit) -> void {
    Visit& here = visits[unit];
    here = {visits.size(), visits.size(), true};
    stack.push_back(unit);
    const auto edges = includes.find(unit);
    for (const std::string& other :
         edges == includes.end() ? std::set<std::string>() : edges->second) {
      if (!visits.contains(other)) {
        self(self, other);
        here.low_link = std::min(here.low_link, visits[other].low_link);
      } else if (visits[other].on_stack) {
        here.low_link = std::min(here.low_link, visits[other].number);
      }
    }
    if (here.low_link != here.number) return;
    std::vector<std::string> component;
    do {
      component.push_back(stack.back());
      visits[stack.back()].on_stack = false;
      stack.pop_back();
    } while (component.back() != unit);
    if (component.size() < 2) return;
    std::sort(component.begin(), component.end());
    loops.push_back(std::move(component));
  };
  for (const auto& [unit, others] : includes) {
    if (!visits.contains(unit)) visit(visit, unit);
  }
  return loops;
}

}  // namespace pleinair::architecture
