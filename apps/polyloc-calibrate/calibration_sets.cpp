#include "calibration_sets.h"

#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/io/GzInputStream.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace mrpt_polyloc::apps {
namespace {

/// The words of a line up to a `#`.
std::vector<std::string> wordsOf(const std::string& line) {
  std::istringstream text(line.substr(0, line.find('#')));
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

std::string buildingOf(const std::string& name) {
  return name.substr(0, name.find('/'));
}

CalibrationSet loadSet(const Program& program, const std::vector<std::string>& words,
                       const std::filesystem::path& folder, const ScanFileOptions& file) {
  const auto resolve = [&](const std::string& name) { return (folder / name).string(); };
  CalibrationSet set;
  set.name = words[0];
  set.map = resolve(words[1]);
  if (!std::filesystem::exists(set.map)) throw FormatError(set.map, "", "no such file");
  const std::string scans = resolve(words[2]);
  Notes notes;
  set.scans = loadScans(scans, file, &notes);
  program.note(scans, notes);
  const std::string truth = resolve(words[3]);
  set.truth = matchTruth(set.scans, loadTum(truth), truth);
  set.good.assign(set.scans.size(), words.size() < 5);
  if (words.size() == 5) {
    for (const std::size_t row : loadRows(resolve(words[4]), set.scans.size())) {
      set.good[row] = true;
    }
  }
  return set;
}

}  // namespace

std::vector<CalibrationSet> loadCalibrationSets(const Program& program, const std::string& path,
                                                const ScanFileOptions& file_options) {
  GzInputStream file(path);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::vector<CalibrationSet> sets;
  std::size_t number = 0;
  for (std::string line; file.readLine(line);) {
    ++number;
    const std::vector<std::string> words = wordsOf(line);
    if (words.empty()) continue;
    const std::string place = "line " + std::to_string(number);
    if (words.size() < 4 || words.size() > 5) {
      throw FormatError(path, place, "is not NAME MAP SCANS TRUTH [GOOD]");
    }
    if (std::any_of(sets.begin(), sets.end(),
                    [&](const CalibrationSet& set) { return set.name == words[0]; })) {
      throw FormatError(path, place, "the name " + words[0] + " is taken");
    }
    const auto same = std::find_if(sets.begin(), sets.end(), [&](const CalibrationSet& set) {
      return buildingOf(set.name) == buildingOf(words[0]);
    });
    const auto building = static_cast<std::size_t>(same - sets.begin());
    sets.push_back(loadSet(program, words, folder, file_options));
    sets.back().building = building;
    sets.back().is_form = words[0].find('/') != std::string::npos;
  }
  if (std::count_if(sets.begin(), sets.end(),
                    [](const CalibrationSet& set) { return !set.is_form; }) < 2) {
    throw FormatError(path, "",
                      "holds fewer than two sets: there are no scans of another building");
  }
  return sets;
}

}  // namespace mrpt_polyloc::apps
