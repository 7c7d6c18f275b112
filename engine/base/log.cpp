#include "engine/base/log.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <mutex>

#include "engine/base/check.h"

namespace helical {
namespace {

std::atomic<LogLevel> g_level{LogLevel::kInfo};
std::mutex g_mutex;

const char* prefix(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug:
      return "debug: ";
    case LogLevel::kInfo:
      return "";
    case LogLevel::kWarning:
      return "warning: ";
    case LogLevel::kError:
      return "error: ";
  }
  return "";
}

}  // namespace

void setLogLevel(LogLevel level) {
  g_level = level;
}

void log(LogLevel level, std::string_view message) {
  if (level < g_level.load()) return;
  const std::lock_guard lock(g_mutex);
  std::fprintf(stderr, "helical: %s%.*s\n", prefix(level), static_cast<int>(message.size()), message.data());
}

void checkFailed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "helical: internal error: %s does not hold (%s:%d)\n", condition, file, line);
  std::abort();
}

}  // namespace helical
