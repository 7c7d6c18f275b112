#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/time.h"
#include "engine/session/mcap_format.h"

namespace helical {

struct McapMessage {
  std::uint16_t channel = 0;
  TimeNs log_time = 0;
  TimeNs publish_time = 0;
  std::string_view payload;  ///< valid during the call that shows it
};

/// Reads an MCAP file, whole, cut off or damaged: what is left of it, in the order it was written. Believes
/// no length that the file gives and uses memory for one chunk at a time. Chunks without compression or with
/// zstd. One thread.
class McapReader {
 public:
  enum class Open {
    kByIndex,  ///< believes a sound summary: at once, however long the file
    kByScan,   ///< looks at every record
  };
  /// Finds the file's records; one without a sound summary is always scanned. Throws Error(kInput) when it
  /// cannot be read or is no MCAP file at all.
  explicit McapReader(std::filesystem::path file, Open open = Open::kByIndex);
  ~McapReader();
  McapReader(const McapReader&) = delete;
  McapReader& operator=(const McapReader&) = delete;

  const std::filesystem::path& file() const { return file_; }
  const std::string& profile() const { return profile_; }
  const std::string& library() const { return library_; }
  const std::map<std::uint16_t, McapSchema>& schemas() const { return schemas_; }
  const std::map<std::uint16_t, McapChannel>& channels() const { return channels_; }
  const std::vector<McapAttachment>& attachments() const { return attachments_; }

  /// Whether the file was closed properly and, as far as was looked, every record of it stands where it
  /// should. Chunks' contents are checked when they are read.
  bool complete() const { return complete_; }
  /// Places from which the scan had to jump to the next chunk that it knew.
  std::uint64_t gaps() const { return gaps_; }
  std::size_t chunkCount() const { return parts_.size(); }
  TimeNs firstTime() const;  ///< of the messages; 0 without any
  TimeNs lastTime() const;

  struct Reading {
    std::uint64_t messages = 0;
    std::uint64_t chunks = 0;
    std::uint64_t damaged_chunks = 0;  ///< left out: the CRC or the content is wrong
  };
  /// Shows every message of sound chunks, in the file's order. Throws Error(kInput) for a kind of compression
  /// that we do not read.
  Reading read(const std::function<void(const McapMessage&)>& show);

  /// What to show: messages of these channels (all when empty) logged in this span. Chunks without any are
  /// not even read.
  struct Selection {
    std::set<std::uint16_t> channels;
    TimeNs from = 0;
    TimeNs to = std::numeric_limits<TimeNs>::max();
  };
  Reading read(const Selection& selection, const std::function<void(const McapMessage&)>& show);

  /// Chunk by chunk, for who goes back and forth: `mayHold` is known without reading it.
  bool mayHold(std::size_t chunk, const Selection& selection) const {
    return mayHold(parts_[chunk], selection);
  }
  TimeNs chunkStart(std::size_t chunk) const { return parts_[chunk].start; }
  TimeNs chunkEnd(std::size_t chunk) const { return parts_[chunk].end; }
  Reading readChunk(std::size_t chunk, const Selection& selection,
                    const std::function<void(const McapMessage&)>& show);

 private:
  struct Part {
    std::uint64_t offset = 0;  ///< of the content
    std::uint64_t length = 0;
    McapOpcode opcode = McapOpcode::kChunk;
    TimeNs start = 0, end = 0;            ///< of the messages inside
    std::vector<std::uint16_t> channels;  ///< inside, as far as its index tells
  };
  struct Head {
    McapOpcode opcode = McapOpcode::kHeader;
    std::uint64_t length = 0;
  };
  static bool mayHold(const Part& part, const Selection& selection);
  bool takeSummary();
  void takeChunkIndex(std::string_view content);
  void takeAttachmentIndex(std::string_view content);
  void takePart(const Head& head, std::uint64_t offset);
  std::string bytesAt(std::uint64_t offset, std::uint64_t length) const;
  bool headAt(std::uint64_t offset, Head& head) const;
  void scan();
  void take(const Head& head, std::uint64_t offset);
  std::uint64_t nextChunk(std::uint64_t from) const;
  void takeSchema(std::string_view content);
  void takeChannel(std::string_view content);
  void takeAttachment(std::string_view content);
  void keep(std::size_t bytes);
  bool readChunk(const Part& part, const std::function<void(const McapMessage&)>& show);
  void readRecords(std::string_view records, const std::function<void(const McapMessage&)>& show);

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  bool complete_ = false;
  bool data_ended_ = false;
  std::uint64_t gaps_ = 0;
  std::uint64_t kept_ = 0;  ///< bytes of schemas, channels and attachments
  std::string profile_, library_;
  std::map<std::uint16_t, McapSchema> schemas_;
  std::map<std::uint16_t, McapChannel> channels_;
  std::vector<McapAttachment> attachments_;
  std::vector<Part> parts_;
};

/// All streams but those of images.
McapReader::Selection withoutImages(const McapReader& session);

}  // namespace helical
