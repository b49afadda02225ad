#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace offstage {

/// The bytes of a whole number, lowest first.
template <class T>
std::array<std::uint8_t, sizeof(T)> littleEndian(T value) {
  static_assert(std::is_integral_v<T>);
  std::array<std::uint8_t, sizeof(T)> bytes{};
  for (std::size_t i = 0; i < sizeof(T); ++i)
    bytes[i] = static_cast<std::uint8_t>(static_cast<std::make_unsigned_t<T>>(value) >> (8 * i));
  return bytes;
}

/// The way back; bytes.size() ≥ sizeof(T).
template <class T>
T fromLittleEndian(std::span<const std::uint8_t> bytes) {
  static_assert(std::is_integral_v<T>);
  std::make_unsigned_t<T> value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i)
    value = static_cast<std::make_unsigned_t<T>>(value | static_cast<std::make_unsigned_t<T>>(bytes[i])
                                                             << (8 * i));
  return static_cast<T>(value);
}

/// The bytes of a whole number, highest first.
inline void storeBigEndian(std::uint8_t* to, std::uint32_t value) {
  for (int byte = 0; byte < 4; ++byte) to[byte] = static_cast<std::uint8_t>(value >> (24 - 8 * byte));
}
inline void storeBigEndian16(std::uint8_t* to, std::uint16_t value) {
  to[0] = static_cast<std::uint8_t>(value >> 8U);
  to[1] = static_cast<std::uint8_t>(value);
}

} // namespace offstage
