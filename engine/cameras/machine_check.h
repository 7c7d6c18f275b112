#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace helical {

/// One thing about this machine that flights depend on.
struct Finding {
  enum class Verdict { kGood, kAdvice, kBad };
  std::string check;  ///< "receive buffer"
  Verdict verdict = Verdict::kGood;
  std::string found;  ///< as it is
  std::string cure;   ///< a command or a setting; empty when it is good
};

/// What on this machine would get in the way of cameras and real time: receive buffer, MTU, permissions, udev rules,
/// USB memory, real-time priority, CPU governor. `root` is "/" but for tests, which bring files of their own.
/// What a machine does not have (USB, frequency scaling) is good.
std::vector<Finding> checkMachine(const std::filesystem::path& root);

}  // namespace helical
