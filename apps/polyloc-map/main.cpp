// polyloc-map: convert, check and draw a map. See README.md beside this file.

#include "../common/Cli.h"
#include "../common/OutputFiles.h"
#include "../common/map_input.h"
#include "../common/map_picture.h"
#include "../common/parsing.h"
#include "cell_report.h"
#include "map_report.h"
#include "map_scene.h"
#include "view_text.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/notes.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/io/polygon_files.h>

#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace mrpt_polyloc;
using namespace mrpt_polyloc::apps;

struct Options {
  std::string input;
  std::string output;
  std::string svg;
  std::string scene;
  std::string view;
  double scale = 1.0;
  bool check = false;
  bool cells = false;
  std::optional<double> range;  // of the cells [m]
  bool json = false;
};

void addOptions(CLI::App& cli, Options& options) {
  addText(cli, "INPUT", options.input, kMapFormats)->required()->type_name("");
  addScaleOption(cli, options.scale);
  addText(cli, "-o", options.output, "Write the map as .geojson, or .wkt if it has no open edges")
      ->type_name("OUT");
  addText(cli, "--view", options.view,
          "Write with -o OUT.wkt not the map but what is seen from there: the visibility polygon, "
          "relative to the point, as polyloc-localize --method exact reads it")
      ->type_name("X,Y");
  addText(cli, "--svg", options.svg, "Draw the map")->type_name("PIC.svg");
  addText(cli, "--3dscene", options.scene, "Write the map as a scene for MRPT's SceneViewer3D")
      ->type_name("OUT.3Dscene");
  cli.add_flag("--check", options.check,
               "List the defects of the map; exit 1 if there is any, repaired or not");
  CLI::Option* const cells = cli.add_flag(
      "--cells", options.cells,
      "Statistics of the visibility cells; --svg draws them; exit 1 if they are too many");
  addNumber(
      cli, "--range", [&options](double range) { options.range = range; },
      {0.0, std::numeric_limits<double>::max(), true},
      "Only vertices within this are told apart by cells, m [default: all]")
      ->type_name("M")
      ->needs(cells);
  cli.add_flag("--json", options.json, "Print the report as JSON");
}

std::string extensionOf(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension != ".geojson" && extension != ".wkt") {
    throw FormatError(
        path, "", "unknown extension '" + extension + "': maps are written as .geojson or .wkt");
  }
  return extension;
}

/// The map as text, where the format can hold it.
std::string outputText(const std::string& path, const PolygonMap& map) {
  try {
    return toText(map, extensionOf(path));
  } catch (const InvalidMapError& error) {
    throw FormatError(path, "", error.what());
  }
}

void writeOutputs(const Options& options, const PolygonMap& map, const CellReport* cells) {
  OutputFiles files;
  if (!options.view.empty()) {
    files.add(options.output, viewText(map, parsePoint("--view", options.view)));
  } else if (!options.output.empty()) {
    files.add(options.output, outputText(options.output, map));
  }
  if (!options.svg.empty()) {
    SvgCanvas canvas(map.boundingBox());
    drawMap(canvas, map);
    if (cells != nullptr) drawCells(canvas, *cells);
    files.add(options.svg, canvas.text());
  }
  if (!options.scene.empty()) files.add(options.scene, sceneText(map));
  files.commit();
}

/// Of a map that was traced, how well its walls are known is what WKT cannot say.
void noteWhatIsLost(const Program& program, const Options& options, const PolygonMap& map) {
  if (map.cellSize() == 0.0 || extensionOf(options.output) != ".wkt") return;
  Notes notes;
  addNote(&notes, formatted("WKT does not say that the map was traced from cells of %g m: give "
                            "--cell-size %g where it is used, or write .geojson",
                            map.cellSize(), map.cellSize()));
  program.note(options.output, notes);
}

void report(const Options& options, const RepairedMap& loaded, const CellReport* cells) {
  if (options.json) {
    nlohmann::ordered_json json = jsonReport(loaded);
    if (cells != nullptr) json.update(jsonReport(*cells));
    std::cout << json.dump(2) << '\n';
  } else {
    std::cout << (options.check ? defectList(loaded.defects) : "") << textReport(loaded.map)
              << (cells != nullptr ? textReport(*cells) : "");
  }
}

/// Loads the map; one that has no valid form is reported before it is refused.
RepairedMap load(const Program& program, const Options& options) {
  try {
    return loadMapWithWarnings(program, options.input, options.scale);
  } catch (const InvalidMapError&) {
    const std::vector<Defect> defects = defectsOfFile(options.input);
    if (options.json) std::cout << jsonReport(defects).dump(2) << '\n';
    if (options.check && !options.json) std::cout << defectList(defects);
    throw;
  }
}

int convert(const Program& program, const Options& options) {
  // Before the work, not after it.
  if (!options.output.empty()) extensionOf(options.output);
  if (!options.view.empty()) {
    parsePoint("--view", options.view);
    if (std::filesystem::path(options.output).extension() != ".wkt") {
      throw UsageError("--view is written as WKT: it needs -o OUT.wkt");
    }
  }
  requireWritable(options.output);
  requireWritable(options.svg);
  requireWritable(options.scene);
  const RepairedMap loaded = load(program, options);
  std::optional<CellReport> cells;
  if (options.cells) cells.emplace(loaded.map, options.range.value_or(kUnlimitedRange));
  const CellReport* shown = cells ? &*cells : nullptr;
  writeOutputs(options, loaded.map, shown);
  if (!options.output.empty() && options.view.empty()) noteWhatIsLost(program, options, loaded.map);
  report(options, loaded, shown);
  return options.check && !loaded.defects.empty() ? kFailed : kDone;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("polyloc-map", "Converts, checks and draws a polygon map.");
  Options options;
  addOptions(program.options(), options);
  return program.run(argc, argv, [&] { return convert(program, options); });
}
