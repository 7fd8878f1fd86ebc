#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mrpt_polyloc {

/// What a loader assumed or left out, one sentence each, without the file's name. The library never
/// prints: programs do, as `FILE: note: ...`.
using Notes = std::vector<std::string>;

/// Adds a note for whoever wants them.
inline void addNote(Notes* notes, std::string text) {
  if (notes != nullptr) notes->push_back(std::move(text));
}

}  // namespace mrpt_polyloc
