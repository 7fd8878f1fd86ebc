#include "ApiError.h"
#include "Jobs.h"
#include "RequestGuard.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace mrpt_polyloc::apps {
namespace {

TEST(Jobs, OnlySoManyComputeAtOnceAndAllGetTheirTurn) {
  Jobs jobs(2);
  std::atomic<int> inside{0}, most{0}, done{0};
  std::vector<std::thread> clients;
  for (int i = 0; i < 20; ++i) {
    clients.emplace_back([&] {
      Jobs::Ticket ticket(jobs, "");
      ticket.enter();
      const int now = ++inside;
      int seen = most;
      while (now > seen && !most.compare_exchange_weak(seen, now)) {
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      --inside;
      ++done;
    });
  }
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(done, 20);
  EXPECT_LE(most, 2);
}

TEST(Jobs, ANewerTicketCancelsTheOlderOfItsJobAlone) {
  Jobs jobs(1);
  Jobs::Ticket old(jobs, "a"), other(jobs, "b"), nameless(jobs, "");
  EXPECT_NO_THROW(old.check());
  const Jobs::Ticket newer(jobs, "a"), another_nameless(jobs, "");
  EXPECT_THROW(old.check(), ApiError);
  EXPECT_THROW(old.enter(), ApiError);
  EXPECT_NO_THROW(newer.check());
  EXPECT_NO_THROW(other.check());
  EXPECT_NO_THROW(nameless.check());
}

TEST(Jobs, EnteringTwiceTakesOneSlot) {
  Jobs jobs(2);
  Jobs::Ticket first(jobs, ""), second(jobs, "");
  first.enter();
  first.enter();
  second.enter();  // would wait for ever
  EXPECT_FALSE(second.cancelled());
}

TEST(Jobs, OneThatWaitsIsCancelled) {
  Jobs jobs(1);
  Jobs::Ticket computing(jobs, "");
  computing.enter();
  std::atomic<bool> was_cancelled{false};
  std::thread waiting([&] {
    Jobs::Ticket ticket(jobs, "");
    try {
      ticket.enter();
    } catch (const ApiError&) {
      was_cancelled = true;
    }
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  jobs.stop();
  waiting.join();
  EXPECT_TRUE(was_cancelled);
  EXPECT_TRUE(computing.cancelled());
  EXPECT_THROW(Jobs::Ticket(jobs, "").check(), ApiError);
}

TEST(RequestGuard, KnowsThisMachine) {
  for (const char* own : {"127.0.0.1", "127.8.0.1", "::1", "localhost"}) {
    EXPECT_TRUE(isLoopback(own)) << own;
  }
  for (const char* other : {"10.0.0.1", "0.0.0.0", "127.0.0.1.nip.io", "", "localhost.org"}) {
    EXPECT_FALSE(isLoopback(other)) << other;
  }
  EXPECT_TRUE(isNumericAddress("[fe80::1]"));
  EXPECT_FALSE(isNumericAddress("1.2.3"));
}

TEST(RequestGuard, LetsInThisMachineAlone) {
  const RequestGuard guard("127.0.0.1");
  for (const char* own : {"127.0.0.1:8765", "localhost:8765", "LOCALHOST", "[::1]:8765", "::1"}) {
    EXPECT_FALSE(guard.refusal(own, "")) << own;
  }
  for (const char* other :
       {"", "evil.example", "10.0.0.1:8765", "localhost.evil.example", "[::2]:1"}) {
    EXPECT_TRUE(guard.refusal(other, "")) << other;
  }
  EXPECT_FALSE(guard.refusal("localhost:1", "http://localhost:1"));
  for (const char* foreign : {"http://localhost:2", "https://localhost:1", "null", "http://a.b"}) {
    EXPECT_TRUE(guard.refusal("localhost:1", foreign)) << foreign;
  }
}

TEST(RequestGuard, LetsInNumbersWhereOthersMayCome) {
  const RequestGuard guard("0.0.0.0");
  EXPECT_FALSE(guard.refusal("10.0.0.5:8765", ""));
  EXPECT_FALSE(guard.refusal("localhost:8765", ""));
  EXPECT_TRUE(guard.refusal("rebound.example:8765", ""));  // a name may be anybody's
  EXPECT_TRUE(guard.refusal("10.0.0.5:8765", "http://rebound.example:8765"));
}

}  // namespace
}  // namespace mrpt_polyloc::apps
