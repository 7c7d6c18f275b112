#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/session/mcap_reader.h"

namespace helical {

/// Goes through what a session says of a flight, without images, in the file's order, from any time on. Holds
/// one chunk. One thread.
class MessageCursor {
 public:
  /// `session` must outlive this.
  explicit MessageCursor(McapReader& session);

  /// To before the first chunk that may hold something at `time` or later.
  void seek(TimeNs time);
  /// Shows every message from where it stands up to `time`, and stands behind it.
  void readUntil(TimeNs time, const std::function<void(const McapMessage&)>& show);

 private:
  struct Held {
    McapMessage message;  ///< without its payload:
    std::size_t at = 0, size = 0;
  };
  bool load();

  McapReader& session_;
  McapReader::Selection selection_;
  std::vector<std::size_t> chunks_;
  std::vector<TimeNs> latest_;  ///< of each chunk: end of it and of all before
  std::size_t next_chunk_ = 0;
  std::string bytes_;
  std::vector<Held> held_;
  std::size_t next_message_ = 0;
};

}  // namespace helical
