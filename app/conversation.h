#pragma once

#include <functional>
#include <optional>
#include <string>

namespace helical {

/// Questions on standard error and lines from standard input, while something else must go on all the time. Ctrl-C and the
/// end of the input are answers, too: the operator gives up. One thread, one at a time.
class Conversation {
 public:
  Conversation();
  ~Conversation();
  Conversation(const Conversation&) = delete;
  Conversation& operator=(const Conversation&) = delete;

  static void say(const std::string& text);
  /// The line, without its end; nothing when the operator gives up. `meanwhile` is called every 10 ms while it waits, and
  /// once at least.
  std::optional<std::string> ask(const std::string& question, const std::function<void()>& meanwhile = [] {});
  /// Until the answer is a number, or empty: then `usual`. `each` hears every number that is given; the last one that was
  /// taken by an empty line is the result.
  std::optional<double> askNumber(const std::string& question, double usual, const std::function<void(double)>& each);
  /// Until the answer is yes or no.
  std::optional<bool> askYes(const std::string& question, const std::function<void()>& meanwhile = [] {});

 private:
  std::string unread_;
  bool ended_ = false;
};

}  // namespace helical
