#pragma once

#include <stdexcept>
#include <string>

namespace helical {

/// What an error means to whoever called us; `app` turns it into the exit code.
enum class ErrorKind {
  kInput,   ///< bad usage or a bad input file: exit code 2
  kDevice,  ///< a device is missing or lost: exit code 3
  kSystem,  ///< the machine refused (no space, no permission, no display): exit code 1
};

/// The one exception type: what went wrong, where, and what to do about it. Thrown by set-up, files and
/// devices only; never on the flight thread.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, std::string what, std::string where = {}, std::string cure = {});

  ErrorKind kind() const { return kind_; }
  const std::string& problem() const { return problem_; }
  const std::string& where() const { return where_; }
  const std::string& cure() const { return cure_; }

 private:
  ErrorKind kind_;
  std::string problem_;
  std::string where_;
  std::string cure_;
};

}  // namespace helical
