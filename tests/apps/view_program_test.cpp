#include "ProgramTest.h"
#include "ViewProcess.h"
#include "view_answers.h"
#include "view_maps.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <httplib.h>
#include <string>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

using nlohmann::json;

class ViewNiches : public ProgramTest {};

TEST_F(ViewNiches, TwinsAreFoundByAllMethods) {
  const ViewProcess server({});  // without arguments it is the niches map
  httplib::Client client("127.0.0.1", server.port());
  client.set_read_timeout(120);
  EXPECT_EQ(json::parse(client.Get("/api/v1/health")->body)["map"], "niches.wkt");
  for (const char* method : {"certified", "cells", "exact"}) {
    const json request = {{"pose", {{"x", 4.25}, {"y", -3.25}, {"phi", 0.5}}},
                          {"laser", {{"sigma", 0.005}}},
                          {"search", {{"options", {{"method", method}}}}}};
    const auto response = client.Post("/api/v1/simulate", request.dump(), "application/json");
    ASSERT_TRUE(response) << method;
    const json result = json::parse(response->body)["result"];
    EXPECT_EQ(result["status"], "ambiguous") << method;
    ASSERT_GE(result["hypotheses"].size(), 2U) << method << result;
    std::vector<double> xs = {result["hypotheses"][0]["x"], result["hypotheses"][1]["x"]};
    std::sort(xs.begin(), xs.end());
    EXPECT_NEAR(xs[0], 4.25, 0.05) << method;
    EXPECT_NEAR(xs[1], 13.25, 0.05) << method;
  }
}

TEST_F(ViewNiches, LooksThroughALog) {
  simulate("sim");
  const ViewProcess server(
      {"--map", roomFile(), "--scans", path("sim/scans.rawlog"), "--truth", path("sim/truth.tum")});
  httplib::Client client("127.0.0.1", server.port());
  client.set_read_timeout(120);
  const json log = answerOf(client.Get("/api/v1/log")).body;
  EXPECT_EQ(log["count"], 12);
  EXPECT_EQ(log["truth"], true);
  EXPECT_EQ(log["path"].size(), 24U);
  const auto ask = [&](const std::string& what, const json& body) {
    return answerOf(client.Post("/api/v1/" + what, body.dump(), "application/json"));
  };
  const json scan = ask("scan", {{"row", 5}, {"search", json::object()}}).body;
  EXPECT_EQ(scan["row"], 5);
  const json &first = scan["result"]["hypotheses"][0], &truth = scan["truth"];
  expectPose(first, truth["x"], truth["y"], truth["phi"]);
  EXPECT_FALSE(ask("scan", {{"row", 5}}).body.contains("result"));
  EXPECT_EQ(ask("scan", {{"row", 12}}).body["error"]["place"], "row");
  EXPECT_EQ(ask("scan", {{"row", -1}}).status, 400);

  // All rows, in as many answers as it takes.
  std::vector<std::string> outcomes;
  for (json next = 0; !next.is_null();) {
    const json some = ask("outcomes", {{"first", next}, {"count", 100}}).body;
    ASSERT_FALSE(some["outcomes"].empty());
    for (const json& one : some["outcomes"]) {
      EXPECT_EQ(one["row"], outcomes.size());
      outcomes.push_back(one["outcome"]);
    }
    next = some["next"];
  }
  EXPECT_EQ(outcomes, std::vector<std::string>(12, "right"));
  // Where the robot cannot be every scan is a miss, the first one asked for too.
  const json search = {{"prior", {{"near", {{"x", 100}, {"y", 100}, {"radius", 1}}}}}};
  const json miss =
      ask("outcomes", {{"first", 3}, {"count", 9}, {"stop_at_miss", true}, {"search", search}})
          .body;
  EXPECT_EQ(miss["miss"], 3);
  EXPECT_EQ(miss["outcomes"].size(), 1U);
  EXPECT_NE(miss["outcomes"][0]["outcome"], "right");
}

TEST_F(ViewNiches, SaysThatThereIsNoLog) {
  const ViewProcess server({kNiches});
  httplib::Client client("127.0.0.1", server.port());
  EXPECT_EQ(answerOf(client.Get("/api/v1/log")).body["count"], 0);
  const auto asked = client.Post("/api/v1/scan", "{\"row\":0}", "application/json");
  EXPECT_EQ(answerOf(asked).status, 422);
  const Outcome missing = run("polyloc-view", {kNiches, "--scans", path("no.rawlog")});
  EXPECT_EQ(missing.code, 1);
  EXPECT_NE(missing.err.find("no.rawlog"), std::string::npos) << missing.err;
  EXPECT_EQ(run("polyloc-view", {kNiches, "--truth", path("no.tum")}).code, 2);
}

TEST_F(ViewNiches, SaysThatAPortIsInUse) {
  const ViewProcess server({kNiches});
  const Outcome second = run("polyloc-view", {kNiches, "--port", std::to_string(server.port())});
  EXPECT_EQ(second.code, 1);
  EXPECT_NE(second.err.find("in use"), std::string::npos) << second.err;
  EXPECT_EQ(second.out, "");
}

TEST_F(ViewNiches, SaysThatAnAddressIsNotItsOwn) {
  const Outcome foreign = run("polyloc-view", {kNiches, "--port", "0", "--listen", "192.0.2.1"});
  EXPECT_EQ(foreign.code, 1);
  EXPECT_NE(foreign.err.find("192.0.2.1"), std::string::npos) << foreign.err;
  EXPECT_NE(foreign.err.find("warning"), std::string::npos) << foreign.err;
  EXPECT_EQ(run("polyloc-view", {kNiches, "--listen", "example.org"}).code, 2);
  EXPECT_EQ(run("polyloc-view", {kNiches, "--port", "65536"}).code, 2);
  EXPECT_EQ(run("polyloc-view", {kNiches, "--map", kNiches}).code, 2);
  const Outcome missing = run("polyloc-view", {path("no.wkt"), "--port", "0"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_NE(missing.err.find("no.wkt"), std::string::npos) << missing.err;
}

TEST_F(ViewNiches, EndsOnSignals) {
  for (const int signal : {SIGINT, SIGTERM}) {
    ViewProcess server({kNiches});
    EXPECT_EQ(server.end(signal), 0);
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
