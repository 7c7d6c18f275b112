#include "app/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace helical {
namespace {

using namespace std::chrono_literals;

constexpr int kBarWidth = 30;

}  // namespace

Progress::Progress(std::string what)
    : what_(std::move(what)),
      terminal_(isatty(STDERR_FILENO) != 0),
      started_(std::chrono::steady_clock::now()),
      last_(started_) {}

Progress::~Progress() {
  if (terminal_ && shown_) std::fputs("\r\033[K", stderr);
}

void Progress::update(double done, const std::string& note) {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < (terminal_ ? 100ms : 5s)) return;
  last_ = now;
  shown_ = true;
  const int percent = static_cast<int>(100.0 * std::clamp(done, 0.0, 1.0));
  if (!terminal_) {
    std::fprintf(stderr, "%s: %d %% %s\n", what_.c_str(), percent, note.c_str());
    return;
  }
  std::string bar(kBarWidth, '.');
  std::fill_n(bar.begin(), percent * kBarWidth / 100, '#');
  std::fprintf(stderr, "\r\033[K%s [%s] %3d %% %s", what_.c_str(), bar.c_str(), percent, note.c_str());
  std::fflush(stderr);
}

}  // namespace helical
