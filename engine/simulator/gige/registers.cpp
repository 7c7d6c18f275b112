#include "engine/simulator/gige/registers.h"

#include <algorithm>
#include <bit>

#include "engine/base/check.h"

namespace helical::gige {

RegisterMemory::RegisterMemory(std::string_view description)
    : bytes_(kRegisterMemory + (description.size() + 3) / 4 * 4) {  // read in whole words
  std::copy(description.begin(), description.end(), bytes_.begin() + kRegisterMemory);
}

std::uint32_t RegisterMemory::word(std::uint32_t address) const {
  HELICAL_CHECK(holds(address, 4));
  std::uint32_t value = 0;
  for (std::uint32_t i = 0; i < 4; ++i) value = value << 8 | bytes_[address + i];
  return value;
}

void RegisterMemory::setWord(std::uint32_t address, std::uint32_t value) {
  HELICAL_CHECK(holds(address, 4));
  for (std::uint32_t i = 0; i < 4; ++i) bytes_[address + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

double RegisterMemory::real(std::uint32_t address) const {
  return std::bit_cast<double>(std::uint64_t{word(address)} << 32 | word(address + 4));
}

void RegisterMemory::setReal(std::uint32_t address, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  setWord(address, static_cast<std::uint32_t>(bits >> 32));
  setWord(address + 4, static_cast<std::uint32_t>(bits));
}

void RegisterMemory::setText(std::uint32_t address, std::string_view text) {
  HELICAL_CHECK(holds(address, static_cast<std::uint32_t>(text.size())));
  std::copy(text.begin(), text.end(), bytes_.begin() + address);
}

std::span<const std::uint8_t> RegisterMemory::bytes(std::uint32_t address, std::uint32_t size) const {
  HELICAL_CHECK(holds(address, size));
  return {bytes_.data() + address, size};
}

void RegisterMemory::setBytes(std::uint32_t address, std::span<const std::uint8_t> bytes) {
  HELICAL_CHECK(holds(address, static_cast<std::uint32_t>(bytes.size())));
  std::copy(bytes.begin(), bytes.end(), bytes_.begin() + address);
}

}  // namespace helical::gige
