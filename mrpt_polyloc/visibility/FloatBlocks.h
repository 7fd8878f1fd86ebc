#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// Floats in whole, aligned blocks as wide as the widest vectors: loops may run to the end of the
/// last block, and no access crosses a cache line.
class FloatBlocks {
 public:
  static constexpr std::size_t kBlock = 16;

  /// Makes room for `count` floats, all set to `value`.
  void assign(std::size_t count, float value) {
    Block block;
    block.values.fill(value);
    blocks_.assign((count + kBlock - 1) / kBlock, block);
  }
  float* data() { return blocks_.empty() ? nullptr : blocks_.front().values.data(); }
  const float* data() const { return blocks_.empty() ? nullptr : blocks_.front().values.data(); }
  float& operator[](std::size_t i) { return blocks_[i / kBlock].values[i % kBlock]; }

 private:
  struct alignas(kBlock * sizeof(float)) Block {
    std::array<float, kBlock> values;
  };
  std::vector<Block> blocks_;
};

}  // namespace mrpt_polyloc
