#pragma once

#include <mrpt_polyloc/geometry/bitmap_regions.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// Neighbouring cells of one row: columns begin to end - 1.
struct CellRun {
  int row, begin, end;

  std::size_t cells() const { return static_cast<std::size_t>(end - begin); }
};

enum class Connectivity { by_sides, by_sides_and_corners };

/// The cells of one value, as the longest runs of their rows, and which of these are connected.
/// Linear in the cells, and of memory in the runs alone: half of a map's image is one unknown
/// patch, which a flood would have to remember cell by cell.
class RunComponents {
 public:
  RunComponents(const RegionGrid& grid, std::int32_t value, Connectivity connectivity);

  /// Row by row.
  const std::vector<CellRun>& runs() const { return runs_; }
  /// The component of a run; numbered in the order of their first cells.
  std::size_t component(std::size_t run) const { return component_[run]; }
  /// Cells of each component.
  const std::vector<std::size_t>& sizes() const { return sizes_; }

 private:
  void takeRow(const std::int32_t* cells, int row, int width, std::int32_t value);
  void joinRows(std::size_t below, std::size_t here, int reach);
  std::uint32_t root(std::uint32_t run);
  void number();

  std::vector<CellRun> runs_;
  std::vector<std::uint32_t> component_;  ///< while joining: another run of the same, or itself
  std::vector<std::size_t> sizes_;
};

}  // namespace mrpt_polyloc
