#include <mrpt_polyloc/visibility/packed_runs.h>

namespace mrpt_polyloc {
namespace {

constexpr unsigned kBits = 7;
constexpr std::uint8_t kMore = 1U << kBits;

void put(std::uint32_t number, std::vector<std::uint8_t>& bytes) {
  for (; number >= kMore; number >>= kBits) {
    bytes.push_back(static_cast<std::uint8_t>(number | kMore));
  }
  bytes.push_back(static_cast<std::uint8_t>(number));
}

std::uint32_t take(const std::uint8_t*& at) {
  std::uint32_t number = *at & (kMore - 1U);
  for (unsigned shift = kBits; (*at++ & kMore) != 0; shift += kBits) {
    number |= (*at & (kMore - 1U)) << shift;
  }
  return number;
}

/// The same from bytes that may be anything; false if they end before the number, or it is too
/// great.
bool takeChecked(const std::uint8_t*& at, const std::uint8_t* end, std::uint64_t& number) {
  constexpr unsigned kMostBits = 35;  // five groups
  number = 0;
  for (unsigned shift = 0; at != end && shift < kMostBits; shift += kBits) {
    const std::uint8_t byte = *at++;
    number |= std::uint64_t{byte & (kMore - 1U)} << shift;
    if ((byte & kMore) == 0) return number <= UINT32_MAX;
  }
  return false;
}

}  // namespace

void packRuns(const std::vector<BoundaryChains::Run>& runs, std::vector<std::uint8_t>& bytes) {
  std::uint32_t end = 0;
  for (const BoundaryChains::Run& run : runs) {
    put(run.first - end, bytes);
    put(run.edges, bytes);
    end = run.first + run.edges;
  }
}

void unpackRuns(const std::uint8_t* begin, const std::uint8_t* end,
                std::vector<BoundaryChains::Run>& runs) {
  std::uint32_t last = 0;
  for (const std::uint8_t* at = begin; at != end;) {
    const std::uint32_t first = last + take(at);
    const std::uint32_t edges = take(at);
    runs.push_back({first, edges});
    last = first + edges;
  }
}

bool arePackedRuns(const std::uint8_t* begin, const std::uint8_t* end, std::size_t vertices) {
  std::uint64_t last = 0;
  for (const std::uint8_t* at = begin; at != end;) {
    std::uint64_t behind = 0, edges = 0;
    if (!takeChecked(at, end, behind) || !takeChecked(at, end, edges)) return false;
    last += behind + edges;
    if (last >= vertices) return false;
  }
  return true;
}

}  // namespace mrpt_polyloc
