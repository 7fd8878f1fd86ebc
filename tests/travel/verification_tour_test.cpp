#include "tests/support/constants.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/travel/verification_tour.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace mrpt_polyloc::test {
namespace {

struct Case {
  TravelGraph graph;
  std::vector<std::vector<double>> lengths;  ///< of all pairs, by Floyd and Warshall
};

Case randomCase(std::size_t places, double density, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Case result;
  result.graph.resize(places);
  result.lengths.assign(places, std::vector<double>(places, kInfinity));
  for (std::size_t a = 0; a < places; ++a) {
    result.lengths[a][a] = 0.0;
    for (std::size_t b = 0; b < a; ++b) {
      if (unit(random) > density) continue;
      const double length = 0.1 + unit(random);
      result.graph[a].emplace_back(static_cast<std::uint32_t>(b), length);
      result.graph[b].emplace_back(static_cast<std::uint32_t>(a), length);
      result.lengths[a][b] = result.lengths[b][a] = length;
    }
  }
  for (std::size_t k = 0; k < places; ++k) {
    for (std::size_t a = 0; a < places; ++a) {
      for (std::size_t b = 0; b < places; ++b) {
        result.lengths[a][b] =
            std::min(result.lengths[a][b], result.lengths[a][k] + result.lengths[k][b]);
      }
    }
  }
  return result;
}

/// By all orders of the rivals, each told apart at any place where it can be.
double bruteForce(const Case& c, std::size_t start, const std::vector<std::uint32_t>& told,
                  std::size_t rivals, bool back) {
  std::vector<std::size_t> order(rivals);
  std::iota(order.begin(), order.end(), std::size_t{0});
  double best = kInfinity;
  do {
    // Least way that has told the first so many, ending at each place.
    std::vector<double> ways = c.lengths[start];
    for (std::size_t p = 0; p < ways.size(); ++p) {
      if (p != start) ways[p] = kInfinity;
    }
    for (const std::size_t rival : order) {
      std::vector<double> next(ways.size(), kInfinity);
      for (std::size_t p = 0; p < ways.size(); ++p) {
        for (std::size_t q = 0; q < ways.size(); ++q) {
          if ((told[q] >> rival & 1U) == 0) continue;
          next[q] = std::min(next[q], ways[p] + c.lengths[p][q]);
        }
      }
      ways = next;
    }
    for (std::size_t p = 0; p < ways.size(); ++p) {
      best = std::min(best, ways[p] + (back ? c.lengths[p][start] : 0.0));
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

TEST(VerificationTour, IsTheShortestOfAllOrders) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int without = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    const std::size_t places = 3 + random() % 10, rivals = random() % 5;
    const Case c = randomCase(places, 0.35, random);
    std::vector<std::uint32_t> told(places, 0);
    for (std::uint32_t& bits : told) {
      for (std::size_t rival = 0; rival < rivals; ++rival) {
        if (unit(random) < 0.2) bits |= 1U << rival;
      }
    }
    for (const bool back : {false, true}) {
      const double expected = bruteForce(c, 0, told, rivals, back);
      const auto found = shortestVerificationTour(c.graph, 0, told, rivals, back);
      EXPECT_EQ(found.has_value(), std::isfinite(expected));
      if (found && std::isfinite(expected)) {
        EXPECT_NEAR(*found, expected, 1e-9);
      }
      without += !found;
    }
  }
  EXPECT_GT(without, 10);
}

TEST(VerificationTour, OfNoRivalsIsNoWay) {
  EXPECT_EQ(shortestVerificationTour({{}}, 0, {0}, 0), 0.0);
  EXPECT_THROW(shortestVerificationTour({{}}, 0, {0}, 17), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc::test
