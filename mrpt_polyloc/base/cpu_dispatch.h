#pragma once

/// Put before the definition of a hot loop: compiled for several x86-64 levels, the best of which
/// is chosen when the library is loaded. Packages built for plain x86-64 so still use AVX2 and
/// AVX-512 where the machine has them. Off under the thread sanitizer, where g++ 12's resolvers
/// crash, and for compilers and machines without it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define POLYLOC_HOT_LOOP \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define POLYLOC_HOT_LOOP
#endif
