#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace helical {

static_assert(std::endian::native == std::endian::little, "MCAP and our CDR are little endian");

/// Appends numbers and texts as MCAP lays them out: little endian, no padding, texts behind their length.
class ByteWriter {
 public:
  template <class T>
  void put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    const auto* from = reinterpret_cast<const char*>(&value);
    bytes_.append(from, sizeof value);
  }
  void putText(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    bytes_.append(text);
  }
  void putRaw(std::string_view raw) { bytes_.append(raw); }

  const std::string& bytes() const { return bytes_; }
  std::size_t size() const { return bytes_.size(); }
  void clear() { bytes_.clear(); }

 private:
  std::string bytes_;
};

/// What a damaged or foreign file makes of a record: it ends before its content does.
class CutShort : public std::runtime_error {
 public:
  CutShort() : std::runtime_error("the data end too early") {}
};

/// Reads what ByteWriter wrote. Looks at bytes that somebody else keeps; throws CutShort rather than read
/// past their end.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  T get() {
    static_assert(std::is_arithmetic_v<T>);
    T value;
    std::memcpy(&value, getRaw(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view getText() { return getRaw(get<std::uint32_t>()); }
  std::string_view getRaw(std::uint64_t size) {
    if (size > bytes_.size() - at_) throw CutShort();
    const std::string_view raw = bytes_.substr(at_, size);
    at_ += static_cast<std::size_t>(size);
    return raw;
  }
  std::string_view rest() const { return bytes_.substr(at_); }
  std::size_t position() const { return at_; }
  bool atEnd() const { return at_ == bytes_.size(); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace helical
