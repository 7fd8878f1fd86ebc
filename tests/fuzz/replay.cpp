// fuzz_replay [--mutations N] [--only TARGET] FOUND: gives every target its seeds, N mutations of
// each, the same ones each time, and what fuzzing found, the files of FOUND/TARGET. Ends early
// where one of them is not taken as it should be; a sanitizer finds more. fuzz_replay --write-seeds
// FOLDER: writes the seeds as files, FOLDER/TARGET/N.

#include "fuzz_target.h"
#include "seeds.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <sys/resource.h>
#include <vector>

namespace {

using namespace mrpt_polyloc::fuzz;
namespace fs = std::filesystem;

/// A few bytes changed, removed, doubled or cut off.
std::string mutated(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  const std::size_t changes = 1 + below(4);
  for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t at = below(bytes.size());
    const std::size_t length = 1 + below(std::min<std::size_t>(16, bytes.size() - at));
    switch (below(8)) {
      case 0:
        bytes.erase(at, length);
        break;
      case 1:
        bytes.insert(below(bytes.size()), bytes.substr(at, length));
        break;
      case 2:
        bytes[at] = static_cast<char>(below(2) == 0 ? 0xff : 0x00);
        break;
      case 3:
        if (below(8) == 0) bytes.resize(at);
        break;
      case 4:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 5:
        bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1U << below(8)));
        break;
      default: {  // another digit: the most likely to leave a text readable
        const std::size_t digit = bytes.find_first_of("0123456789", at);
        if (digit != std::string::npos) bytes[digit] = static_cast<char>('0' + below(10));
      }
    }
  }
  return bytes;
}

std::string contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void writeSeeds(const fs::path& folder) {
  for (const auto& [name, texts] : seeds()) {
    fs::create_directories(folder / name);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      std::ofstream(folder / name / std::to_string(i), std::ios::binary) << texts[i];
    }
  }
}

/// \return how many inputs there were
std::size_t replay(const std::string& name, TargetFunction target,
                   const std::vector<std::string>& texts, const fs::path& found, int mutations) {
  std::size_t count = 0;
  // Told before, for a crash says nothing of what was tried.
  const auto tell = [&](const std::string& what) { std::cerr << name << ": " << what << '\n'; };
  for (const std::string& text : texts) {
    feed(target, text);
    std::mt19937 random(1);
    for (int i = 0; i < mutations; ++i, ++count) feed(target, mutated(text, random));
    ++count;
  }
  if (!fs::is_directory(found / name)) return count;
  std::vector<fs::path> files(fs::directory_iterator(found / name), fs::directory_iterator{});
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    tell(file.filename().string());
    feed(target, contentOf(file));
    ++count;
  }
  return count;
}

/// As the programs do, see SECURITY.md. Address sanitizer takes terabytes, of which it uses little.
void limitMemory() {
#ifndef __SANITIZE_ADDRESS__
  rlimit limit{};
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, rlim_t{3} << 30U);
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  limitMemory();
  int mutations = 0;
  std::string only, found;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--write-seeds" && i + 1 < argc) {
      writeSeeds(argv[i + 1]);
      return 0;
    }
    if (word == "--mutations" && i + 1 < argc) {
      mutations = std::stoi(argv[++i]);
    } else if (word == "--only" && i + 1 < argc) {
      only = argv[++i];
    } else {
      found = word;
    }
  }
  if (!std::filesystem::is_directory(found)) {
    std::cerr << "fuzz_replay: no folder of found inputs: '" << found << "'\n";
    return 2;
  }
  const auto all_seeds = seeds();
  std::size_t count = 0;
  for (const auto& [name, target] : targets()) {
    if (!only.empty() && name != only) continue;
    std::cerr << name << '\n';
    const auto texts = all_seeds.find(name);
    must(texts != all_seeds.end(), "a target has seeds");
    count += replay(name, target, texts->second, found, mutations);
  }
  std::cout << count << " inputs for " << targets().size() << " targets\n";
  return count > 0 ? 0 : 1;
}
