#include "engine/session/message_cursor.h"

#include <algorithm>

namespace helical {

MessageCursor::MessageCursor(McapReader& session) : session_(session), selection_(withoutImages(session)) {
  TimeNs latest = 0;
  for (std::size_t chunk = 0; chunk < session.chunkCount(); ++chunk) {
    if (!session.mayHold(chunk, selection_)) continue;
    latest = std::max(latest, session.chunkEnd(chunk));
    chunks_.push_back(chunk);
    latest_.push_back(latest);
  }
}

void MessageCursor::seek(TimeNs time) {
  next_chunk_ =
      static_cast<std::size_t>(std::lower_bound(latest_.begin(), latest_.end(), time) - latest_.begin());
  held_.clear();
  next_message_ = 0;
}

bool MessageCursor::load() {
  while (next_chunk_ < chunks_.size()) {
    bytes_.clear();
    held_.clear();
    next_message_ = 0;
    session_.readChunk(chunks_[next_chunk_++], selection_, [&](const McapMessage& message) {
      held_.push_back({message, bytes_.size(), message.payload.size()});
      bytes_ += message.payload;
    });
    if (!held_.empty()) return true;
  }
  return false;
}

void MessageCursor::readUntil(TimeNs time, const std::function<void(const McapMessage&)>& show) {
  for (;;) {
    if (next_message_ == held_.size() && !load()) return;
    Held& next = held_[next_message_];
    if (next.message.log_time > time) return;
    next.message.payload = std::string_view(bytes_).substr(next.at, next.size);
    ++next_message_;
    show(next.message);
  }
}

}  // namespace helical
