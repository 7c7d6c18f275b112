#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/session/byte_stream.h"

namespace helical {

/// The payload of a ROS 2 message: CDR, little endian. Every number is aligned to its own size, counted from
/// behind the head of 4 bytes; texts end in a zero.
class CdrWriter {
 public:
  CdrWriter() { clear(); }
  void clear() {
    bytes_.clear();
    bytes_.putRaw({"\0\1\0\0", kCdrHead});
  }
  template <class T>
  void put(T value) {
    align(sizeof value);
    bytes_.put(value);
  }
  void put(bool value) { bytes_.put(static_cast<std::uint8_t>(value)); }
  void putText(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.putRaw(text);
    bytes_.putRaw({"\0", 1});
  }
  /// A list of bytes.
  void putBytes(std::string_view list) {
    put(static_cast<std::uint32_t>(list.size()));
    bytes_.putRaw(list);
  }
  template <class Derived>
  void putAll(const Eigen::MatrixBase<Derived>& row_by_row) {
    for (Eigen::Index row = 0; row < row_by_row.rows(); ++row)
      for (Eigen::Index column = 0; column < row_by_row.cols(); ++column) put(row_by_row(row, column));
  }
  const std::string& bytes() const { return bytes_.bytes(); }

  static constexpr std::size_t kCdrHead = 4;

 private:
  void align(std::size_t size) {
    while ((bytes_.size() - kCdrHead) % size != 0) bytes_.put(std::uint8_t{0});
  }
  ByteWriter bytes_;
};

/// Reads what CdrWriter wrote; throws CutShort where the payload ends too early.
class CdrReader {
 public:
  explicit CdrReader(std::string_view payload) : in_(payload) {
    if (in_.getRaw(CdrWriter::kCdrHead)[1] != 1) throw CutShort();  // big endian, or lists of parameters
  }
  template <class T>
  T get() {
    align(sizeof(T));
    return in_.get<T>();
  }
  bool getBool() { return in_.get<std::uint8_t>() != 0; }
  std::string_view getText() {
    const auto size = get<std::uint32_t>();
    const std::string_view text = in_.getRaw(size);
    return text.empty() ? text : text.substr(0, text.size() - 1);
  }
  std::string_view getBytes() { return in_.getRaw(get<std::uint32_t>()); }
  bool atEnd() const { return in_.atEnd(); }
  std::size_t left() const { return in_.rest().size(); }

 private:
  void align(std::size_t size) {
    while ((in_.position() - CdrWriter::kCdrHead) % size != 0) in_.get<std::uint8_t>();
  }
  ByteReader in_;
};

}  // namespace helical
