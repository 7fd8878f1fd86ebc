#pragma once

#include <mrpt_polyloc/base/export.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace mrpt_polyloc {

/// 64-bit FNV-1a (Fowler, Noll, Vo), byte by byte: tells contents apart, no protection against
/// those who mean harm.
class POLYLOC_EXPORT Fnv {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) addNumber(bytes[i]);
  }
  /// A number as one step of the hash.
  void addNumber(std::uint64_t number) { hash_ = (hash_ ^ number) * kPrime; }

  std::uint64_t value() const { return hash_; }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001B3U;
  std::uint64_t hash_ = 0xCBF29CE484222325U;
};

/// The same over words of eight bytes, the last one padded with zeros: for hundreds of megabytes.
/// In what pieces the data comes does not matter.
class POLYLOC_EXPORT Checksum {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    while (size > 0 && filled_ > 0) {
      takeByte(*bytes++);
      --size;
    }
    for (; size >= sizeof(word_); bytes += sizeof(word_), size -= sizeof(word_)) {
      std::memcpy(&word_, bytes, sizeof(word_));
      takeWord();
    }
    for (; size > 0; --size) takeByte(*bytes++);
  }

  std::uint64_t value() const {
    Checksum rest = *this;
    if (rest.filled_ > 0) rest.takeWord();
    return rest.hash_.value();
  }

 private:
  void takeByte(unsigned char byte) {
    std::memcpy(reinterpret_cast<unsigned char*>(&word_) + filled_, &byte, 1);
    if (++filled_ == sizeof(word_)) takeWord();
  }
  void takeWord() {
    hash_.addNumber(word_ ^ (hash_.value() >> 29));
    word_ = 0;
    filled_ = 0;
  }

  Fnv hash_;
  std::uint64_t word_ = 0;
  std::size_t filled_ = 0;
};

}  // namespace mrpt_polyloc
