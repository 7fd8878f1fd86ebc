#pragma once

// What every fuzz target shares. A target is a function of bytes, which it gives to one parser or
// to a whole way from file to answer:
//
//   POLYLOC_FUZZ_TARGET(wkt, bytes) { parseWkt(bytes, "input"); }
//
// Whatever the bytes are, it may throw the project's errors of bad input, and nothing else; must()
// says what else has to hold. Compiled by clang each is a program of libFuzzer's; the program
// fuzz_replay holds them all, for any compiler.

#include <mrpt_polyloc/base/errors.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

namespace mrpt_polyloc::fuzz {

using TargetFunction = void (*)(const std::string& bytes);

/// The targets of a program by name.
std::map<std::string, TargetFunction>& targets();

/// Gives bytes to a target. Errors of bad input are as it should be; any other exception ends the
/// program.
void feed(TargetFunction target, const std::string& bytes);

/// Ends the program, as a sanitizer would, if what has to hold does not.
inline void must(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// The path of a file of this process that holds these bytes until the next file of that name.
std::string inputFile(const std::string& name, const std::string& bytes);

}  // namespace mrpt_polyloc::fuzz

#define POLYLOC_FUZZ_TARGET(name, bytes)                  \
  namespace mrpt_polyloc::fuzz {                          \
  static void fuzz_##name(const std::string& bytes);      \
  [[maybe_unused]] static const bool kRegistered_##name = \
      targets().emplace(#name, fuzz_##name).second;       \
  }                                                       \
  void mrpt_polyloc::fuzz::fuzz_##name(const std::string& bytes)
