#pragma once

#include <cstddef>
#include <cstdint>

namespace helical {

/// A checksum of the bytes, in the machine's widest vectors: what it takes to read them once.
std::uint64_t sumOfBytes(const std::uint8_t* bytes, std::size_t count);

}  // namespace helical
