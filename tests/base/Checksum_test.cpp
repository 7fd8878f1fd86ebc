#include <mrpt_polyloc/base/Checksum.h>

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace mrpt_polyloc {
namespace {

TEST(Fnv, KnownValues) {  // from the authors' page: http://www.isthe.com/chongo/tech/comp/fnv
  Fnv empty, a, foobar;
  a.add("a", 1);
  foobar.add("foobar", 6);
  EXPECT_EQ(empty.value(), 0xcbf29ce484222325U);
  EXPECT_EQ(a.value(), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(foobar.value(), 0x85944171f73967e8U);
}

TEST(Checksum, DoesNotDependOnThePieces) {
  std::mt19937 random(8);
  std::string data(1001, ' ');
  for (char& c : data) c = static_cast<char>(random());
  Checksum whole;
  whole.add(data.data(), data.size());
  for (int i = 0; i < 50; ++i) {
    Checksum pieces;
    for (std::size_t at = 0; at < data.size();) {
      const std::size_t size = std::min<std::size_t>(random() % 23, data.size() - at);
      pieces.add(data.data() + at, size);
      at += size;
    }
    EXPECT_EQ(pieces.value(), whole.value());
  }
}

TEST(Checksum, TellsEachByteAndTheLength) {
  std::string data = "The quick brown fox jumps over the lazy dog";
  const auto sum = [](const std::string& text) {
    Checksum checksum;
    checksum.add(text.data(), text.size());
    return checksum.value();
  };
  for (std::size_t i = 0; i < data.size(); ++i) {
    std::string other = data;
    other[i] ^= 1;
    EXPECT_NE(sum(other), sum(data)) << i;
    EXPECT_NE(sum(data.substr(0, i)), sum(data)) << i;
  }
}

}  // namespace
}  // namespace mrpt_polyloc
