#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

/// Vectors of 64 bytes as the compiler's own types: one AVX-512 register, or two of AVX2, or four
/// of SSE2. For hot loops; their results are taken by reference, as such types have no one form in
/// calls between functions that are compiled for different machines.
namespace mrpt_polyloc::lanes {

constexpr std::size_t kBytes = 64;
using Bytes = std::uint8_t __attribute__((vector_size(kBytes)));
using Words = std::uint16_t __attribute__((vector_size(kBytes)));
using Quads = std::uint32_t __attribute__((vector_size(kBytes)));

#define POLYLOC_LANES inline __attribute__((always_inline))

template <class V, class T>
POLYLOC_LANES void load(const T* from, V& to) {
  std::memcpy(&to, from, sizeof(V));
}
template <class V>
POLYLOC_LANES void takeMin(V& a, const V& b) {
  a = a < b ? a : b;
}
template <class V>
POLYLOC_LANES void takeMax(V& a, const V& b) {
  a = a > b ? a : b;
}
/// a becomes a - b where that is positive, else 0.
template <class V>
POLYLOC_LANES void subtractSaturated(V& a, const V& b) {
  takeMax(a, b);
  a -= b;
}
/// Lanes of a where the mask's bits are set, else of b.
template <class V>
POLYLOC_LANES void select(const V& mask, const V& a, V& b) {
  b ^= mask & (a ^ b);
}
/// The lanes' sum.
template <class T, class V>
POLYLOC_LANES unsigned sumOfLanes(const V& lanes) {
  T each[kBytes / sizeof(T)];
  std::memcpy(each, &lanes, sizeof(each));
  unsigned sum = 0;
  for (const T lane : each) sum += lane;
  return sum;
}
POLYLOC_LANES unsigned sumOf(const Bytes& bytes) {
#ifdef __SSE2__
  // Sums of absolute differences from 0: a third of the time of widening step by step.
  __m128i quarters[4];
  std::memcpy(quarters, &bytes, sizeof(quarters));
  const __m128i zero = _mm_setzero_si128();
  const __m128i sums = _mm_add_epi32(
      _mm_add_epi32(_mm_sad_epu8(quarters[0], zero), _mm_sad_epu8(quarters[1], zero)),
      _mm_add_epi32(_mm_sad_epu8(quarters[2], zero), _mm_sad_epu8(quarters[3], zero)));
  return static_cast<unsigned>(
      _mm_cvtsi128_si32(_mm_add_epi32(sums, _mm_unpackhi_epi64(sums, sums))));
#else
  return sumOfLanes<std::uint8_t>(bytes);
#endif
}
POLYLOC_LANES unsigned sumOf(const Words& words) {
  return sumOfLanes<std::uint16_t>(words);
}
POLYLOC_LANES unsigned sumOf(const Quads& quads) {
  return sumOfLanes<std::uint32_t>(quads);
}

/// Bits set for the first `count` lanes of a vector.
template <class T, std::size_t count>
struct FirstLanes {
  alignas(kBytes) T mask[kBytes / sizeof(T)] = {};
  constexpr FirstLanes() {
    for (std::size_t i = 0; i < count; ++i) mask[i] = static_cast<T>(-1);
  }
};

}  // namespace mrpt_polyloc::lanes
