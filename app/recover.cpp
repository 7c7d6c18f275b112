#include "app/recover.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "engine/session/mcap_recovery.h"

namespace helical {
namespace {

int recover(const std::string& file) {
  const Recovery recovery = recoverMcap(file);
  if (recovery.was_complete) {
    std::printf("%s is complete: %llu messages, nothing to mend\n", file.c_str(),
                static_cast<unsigned long long>(recovery.messages));
    return 0;
  }
  std::printf("%s is mended: %llu messages saved", file.c_str(),
              static_cast<unsigned long long>(recovery.messages));
  if (recovery.damaged_chunks > 0)
    std::printf(", %llu damaged chunks left out", static_cast<unsigned long long>(recovery.damaged_chunks));
  if (!recovery.original.empty()) std::printf("; the damaged file is kept as %s", recovery.original.c_str());
  std::printf("\n");
  return 0;
}

}  // namespace

void addRecoverCommand(CLI::App& app, int& exit_code) {
  auto file = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("recover", "Mend a session that was cut off, in place");
  command->add_option("SESSION", *file, "The session's MCAP file")->required();
  command->callback([file, &exit_code] { exit_code = recover(*file); });
}

}  // namespace helical
