#include "engine/config/resource_files.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "engine/base/error.h"

namespace helical {
namespace {

namespace fs = std::filesystem;

bool isFolder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

std::string plansIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

fs::path resourceFolder() {
  if (const char* given = std::getenv("HELICAL_RESOURCES"); given != nullptr && *given != '\0') {
    if (isFolder(given)) return given;
    throw Error(ErrorKind::kSystem, "HELICAL_RESOURCES names no folder", given,
                "correct or unset HELICAL_RESOURCES");
  }
  std::error_code ignored;
  const fs::path binary = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = (binary.parent_path().parent_path() / "share" / "helical").lexically_normal();
  if (isFolder(installed)) return installed;
  if (isFolder(HELICAL_SOURCE_RESOURCES)) return HELICAL_SOURCE_RESOURCES;
  throw Error(ErrorKind::kSystem, "the folder of rigs and plans is gone", HELICAL_SOURCE_RESOURCES,
              "set HELICAL_RESOURCES to the resources folder of Helical's source tree");
}

fs::path planPath(const std::string& name_or_path) {
  const fs::path path(name_or_path);
  if (path.has_parent_path() || path.extension() == ".toml") return path;
  const fs::path folder = resourceFolder() / "plans";
  const fs::path shipped = folder / (name_or_path + ".toml");
  if (std::error_code ignored; fs::exists(shipped, ignored)) return shipped;
  throw Error(ErrorKind::kInput, "there is no plan '" + name_or_path + "'", folder.string(),
              "name one of " + plansIn(folder) + ", or a file with its folder, such as ./my-plan.toml");
}

}  // namespace helical
