#pragma once

#include <filesystem>
#include <string>

namespace helical {

/// The folder of shipped rigs and plans: $HELICAL_RESOURCES, else beside the binary's install prefix, else
/// the source tree it was built from. Throws Error(kSystem) when none of them exists.
std::filesystem::path resourceFolder();

/// A plan by name ("hover" is resources/plans/hover.toml) or by path. Throws Error(kInput) listing the known
/// names.
std::filesystem::path planPath(const std::string& name_or_path);

}  // namespace helical
