#pragma once

#include <string_view>

namespace helical {

enum class LogLevel { kDebug, kInfo, kWarning, kError };

/// Messages below this level are dropped. Any thread.
void setLogLevel(LogLevel level);

/// Writes one line to stderr. Any thread, but never the per-frame path: it formats, locks and does I/O.
void log(LogLevel level, std::string_view message);

}  // namespace helical
