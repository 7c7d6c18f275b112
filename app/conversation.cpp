#include "app/conversation.h"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace helical {
namespace {

constexpr int kPeriodMs = 10;

volatile sig_atomic_t interrupted = 0;

std::string shortText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::optional<double> numberOf(const std::string& text) {
  double value = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

Conversation::Conversation() {
  interrupted = 0;
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = 1; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

Conversation::~Conversation() {
  signal(SIGINT, SIG_DFL);
  signal(SIGTERM, SIG_DFL);
}

void Conversation::say(const std::string& text) {
  std::fputs(text.c_str(), stderr);
}

std::optional<std::string> Conversation::ask(const std::string& question, const std::function<void()>& meanwhile) {
  say(question);
  for (;;) {
    if (const std::size_t end = unread_.find('\n'); end != std::string::npos) {
      std::string line = unread_.substr(0, end);
      unread_.erase(0, end + 1);
      while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
      // What was typed ahead is not faster than what it is about.
      meanwhile();
      return line;
    }
    if (ended_ || interrupted != 0) {
      say("\n");
      return std::nullopt;
    }
    meanwhile();
    pollfd waiting{STDIN_FILENO, POLLIN, 0};
    if (poll(&waiting, 1, kPeriodMs) <= 0) continue;
    std::array<char, 256> bytes;
    const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count <= 0)
      ended_ = true;
    else
      unread_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

std::optional<double> Conversation::askNumber(const std::string& question, double usual,
                                              const std::function<void(double)>& each) {
  double value = usual;
  each(value);
  for (;;) {
    const auto line = ask(question + " [" + shortText(value) + "] ");
    if (!line) return std::nullopt;
    if (line->empty()) return value;
    const auto number = numberOf(*line);
    if (number)
      each(value = *number);
    else
      say("  give a number to try it, or nothing to take the one in brackets\n");
  }
}

std::optional<bool> Conversation::askYes(const std::string& question, const std::function<void()>& meanwhile) {
  for (;;) {
    const auto line = ask(question + " [y/n] ", meanwhile);
    if (!line) return std::nullopt;
    if (*line == "y" || *line == "yes") return true;
    if (*line == "n" || *line == "no") return false;
  }
}

}  // namespace helical
