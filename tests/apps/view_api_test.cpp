#include "ViewProcess.h"
#include "view_answers.h"
#include "view_maps.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <arpa/inet.h>
#include <chrono>
#include <cmath>
#include <csignal>
#include <httplib.h>
#include <memory>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace mrpt_polyloc::test {
namespace {

using nlohmann::json;

class ViewApi : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::signal(SIGPIPE, SIG_IGN);  // the server may close while we are sending
    server_ = std::make_unique<ViewProcess>(arguments_);
  }
  static void TearDownTestSuite() { server_.reset(); }

  static httplib::Client client() {
    httplib::Client client("127.0.0.1", server_->port());
    client.set_read_timeout(120);
    return client;
  }
  static Answer get(const std::string& path) { return answerOf(client().Get("/api/v1/" + path)); }
  static Answer postText(const std::string& path, const std::string& text) {
    return answerOf(client().Post("/api/v1/" + path, text, "application/json"));
  }
  static Answer post(const std::string& path, const json& body) {
    return postText(path, body.dump());
  }
  /// Expects an error at a place of the request.
  static void expectRefused(const Answer& answer, const std::string& place, int status = 400) {
    ASSERT_EQ(answer.status, status) << answer.body;
    ASSERT_TRUE(answer.body.contains("error")) << answer.body;
    EXPECT_EQ(answer.body["error"]["place"], place) << answer.body;
    EXPECT_FALSE(answer.body["error"]["message"].get<std::string>().empty());
  }

  static inline std::vector<std::string> arguments_ = {kFlat};
  static inline std::unique_ptr<ViewProcess> server_;
};

/// A scan of the flat, simulated by the server, in the form of a driver.
json scanFrom(double x, double y, double phi) {
  return {{"pose", {{"x", x}, {"y", y}, {"phi", phi}}},
          {"laser", {{"beams", 180}, {"sigma", 0.01}, {"seed", 3}}}};
}

TEST_F(ViewApi, HealthSaysWhatIsServed) {
  const Answer answer = get("health");
  ASSERT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body["api"], 1);
  EXPECT_EQ(answer.body["map"], "flat.wkt");
  EXPECT_EQ(answer.body["version"], POLYLOC_VERSION);
  EXPECT_EQ(answer.body["map_hash"].get<std::string>().size(), 16U);
}

TEST_F(ViewApi, MapIsThatOfTheFileAndSimpler) {
  const json map = get("map").body;
  EXPECT_NEAR(map["area_m2"].get<double>(), 88.0, 3.0);
  std::size_t vertices = 0;
  for (const json& ring : map["free"]) vertices += ring.size() / 2 - 1;  // closed
  EXPECT_EQ(vertices, map["vertices"].get<std::size_t>());
  EXPECT_EQ(map["free"].size(), 1 + map["holes"].get<std::size_t>());
  const json coarse = get("map?tolerance=100").body;
  EXPECT_TRUE(coarse["walls"].empty());
  EXPECT_EQ(get("map?pixels=1000").body["walls"].size(), map["walls"].size());
  expectRefused(get("map?tolerance=-1"), "tolerance");
  expectRefused(get("map?tolerance=nan"), "tolerance");
  expectRefused(get("map?pixels=x"), "pixels");
}

TEST_F(ViewApi, ASimulatedScanIsLocalizedWhereItWasTaken) {
  json request = scanFrom(2.8, 1.0, 0.7);
  request["search"] = {{"options", {{"max_hypotheses", 5}}}};
  const Answer answer = post("simulate", request);
  ASSERT_EQ(answer.status, 200) << answer.body;
  const json& result = answer.body["result"];
  EXPECT_EQ(result["status"], "unique");
  ASSERT_FALSE(result["hypotheses"].empty());
  expectPose(result["hypotheses"][0], 2.8, 1.0, 0.7);
  EXPECT_GT(result["match"].get<double>(), 0.5);
  EXPECT_TRUE(result["certificate"]["complete"].get<bool>());
  EXPECT_GT(result["ms"].get<double>(), 0.0);
  ASSERT_EQ(result["hypotheses"][0]["covariance"].size(), 3U);
  // The same scan again, as it was given out.
  const Answer again = post("localize", answer.body["scan"]);
  ASSERT_EQ(again.status, 200) << again.body;
  EXPECT_EQ(again.body["hypotheses"][0]["x"], result["hypotheses"][0]["x"]);
  EXPECT_EQ(again.body["map_hash"], get("health").body["map_hash"]);
}

TEST_F(ViewApi, LocalizesADriversScanWithASensorOffTheRobot) {
  // The sensor stands 0.2 m ahead and looks back: the beams start at its own -pi.
  const json seen = post("simulate", scanFrom(2.8, 1.0, 0.7)).body["scan"];
  json request = {{"start_angle", seen["bearings"][0]},
                  {"angle_step", 2 * kPi / 180},
                  {"max_range", 20.0},
                  {"ranges", seen["ranges"]},
                  {"sensor", {{"x", 0.2}, {"y", 0.0}, {"phi", kPi}}}};
  const Answer answer = post("localize", request);
  ASSERT_EQ(answer.status, 200) << answer.body;
  // The sensor was at (2.8, 1), so the robot's heading is the sensor's less pi.
  const double heading = 0.7 - kPi;
  expectPose(answer.body["hypotheses"][0], 2.8 - 0.2 * std::cos(heading),
             1.0 - 0.2 * std::sin(heading), heading);
}

TEST_F(ViewApi, LocalizesScansThatBelongTogether) {
  // Half a circle ahead and half a circle behind; then a metre on, and a quarter turned.
  const auto half = [&](double x, double y, double phi) {
    json request = scanFrom(x, y, phi);
    request["laser"]["fov"] = kPi;
    return post("simulate", request).body["scan"];
  };
  const json ahead = half(2.0, 1.0, 0.0);
  json behind = half(2.0, 1.0, kPi);
  for (json& bearing : behind["bearings"]) bearing = bearing.get<double>() + kPi;
  const json together = post("localize", {{"scans", {ahead, behind}}}).body;
  ASSERT_FALSE(together["hypotheses"].empty()) << together;
  expectPose(together["hypotheses"][0], 2.0, 1.0, 0.0);
  json later = half(3.0, 1.0, kPi / 2);
  later["moved"] = {{"x", 1.0}, {"y", 0.0}, {"phi", kPi / 2}};
  const json drive = post("localize", {{"scans", {ahead, behind, later}}}).body;
  ASSERT_FALSE(drive["hypotheses"].empty()) << drive;
  expectPose(drive["hypotheses"][0], 3.0, 1.0, kPi / 2);
  // One alone is a scan as any other.
  const json one = post("localize", {{"scans", json::array({ahead})}}).body;
  EXPECT_EQ(one["hypotheses"], post("localize", ahead).body["hypotheses"]);

  expectRefused(post("localize", {{"scans", json::array()}}), "scans");
  expectRefused(post("localize", {{"scans", {ahead, 5}}}), "scans[1]");
  later["moved"] = {{"x", 1.0}};
  expectRefused(post("localize", {{"scans", {ahead, later}}}), "scans[1].moved.y");
  expectRefused(post("localize", {{"scans", json::array({ahead})}, {"odometry", {{"wheels", 1}}}}),
                "odometry.wheels");
  expectRefused(post("localize", {{"scans", {ahead, behind}}, {"options", {{"method", "cells"}}}}),
                "options.method");
}

TEST_F(ViewApi, PriorsAreKept) {
  json request = post("simulate", scanFrom(2.8, 1.0, 0.7)).body["scan"];
  request["prior"] = {{"compass", {{"heading", 0.7 + kPi}, {"tolerance", 0.1}}}};
  for (const json& h : post("localize", request).body["hypotheses"]) {
    EXPECT_LE(std::abs(std::remainder(h["phi"].get<double>() - 0.7 - kPi, 2 * kPi)), 0.1 + 1e-6);
  }
  request["prior"] = {{"near", {{"x", 2.8}, {"y", 1.0}, {"radius", 0.5}}}};
  const json near = post("localize", request).body;
  ASSERT_FALSE(near["hypotheses"].empty());
  for (const json& h : near["hypotheses"]) {
    EXPECT_LE(std::hypot(h["x"].get<double>() - 2.8, h["y"].get<double>() - 1.0), 0.5 + 1e-6);
  }
}

TEST_F(ViewApi, RegionsAreListedIfAskedFor) {
  json request = post("simulate", scanFrom(2.8, 1.0, 0.7)).body["scan"];
  EXPECT_FALSE(post("localize", request).body.contains("regions"));
  request["options"] = {{"regions", true}};
  const json answer = post("localize", request).body;
  ASSERT_TRUE(answer.contains("regions"));
  EXPECT_EQ(answer["regions"].size(), answer["certificate"]["regions"].get<std::size_t>());
  EXPECT_GE(answer["regions"][0]["polygon"].size(), 3U);
}

TEST_F(ViewApi, TooFewBeamsAndNothingKnownAreStatuses) {
  json request = {{"start_angle", 0.0}, {"angle_step", 0.01}, {"ranges", json::array()}};
  EXPECT_EQ(post("localize", request).body["status"], "too_few_beams");
  request["ranges"] = std::vector<json>(100, nullptr);
  EXPECT_EQ(post("localize", request).body["status"], "too_few_beams");
}

TEST_F(ViewApi, ComparisonAtTheTruePoseCostsLittle) {
  json request = post("simulate", scanFrom(2.8, 1.0, 0.7)).body["scan"];
  request["pose"] = {{"x", 2.8}, {"y", 1.0}, {"phi", 0.7}};
  const json right = post("compare", request).body;
  ASSERT_EQ(right["wall"].size(), 180U);
  EXPECT_LT(right["mean_cost"].get<double>(), 0.03);
  EXPECT_LT(right["polar"]["distance"].get<double>(), 0.6);
  // Turned by 40 degrees the polar distance finds the rotation back.
  request["pose"]["phi"] = 0.7 + 40 * kDegree;
  const json turned = post("compare", request).body;
  EXPECT_GT(turned["polar"]["distance"].get<double>(), right["polar"]["distance"].get<double>());
  EXPECT_NEAR(turned["polar"]["rotation"].get<double>(), -40 * kDegree, 1.5 * kDegree);
}

TEST_F(ViewApi, ViewAndLeafOfAPoint) {
  const json view = post("view", {{"x", 2.8}, {"y", 1.0}}).body;
  EXPECT_GE(view["polygon"].size(), 6U);
  EXPECT_FALSE(view["skeleton"]["vertices"].empty());
  expectRefused(post("view", {{"x", 200.0}, {"y", 1.5}}), "", 422);
  expectRefused(post("view", {{"x", 2.8}}), "y");
  const json leaf = post("leaf", {{"x", 2.8}, {"y", 1.0}}).body;
  EXPECT_EQ(leaf["near"].size(), 180U);
  expectRefused(post("leaf", {{"x", -100}, {"y", 0}}), "", 422);
}

TEST_F(ViewApi, CellsOfTheWholeMap) {
  const json cells = get("cells").body;
  EXPECT_EQ(cells["cells"].size(), cells["count"].get<std::size_t>());
  EXPECT_GT(cells["segments"].size(), 10U);
}

TEST_F(ViewApi, WrongInputIsToldWithItsPlace) {
  const json good = post("simulate", scanFrom(2.8, 1.0, 0.7)).body["scan"];
  const auto with = [&](const char* name, const json& value) {
    json request = good;
    request[name] = value;
    return post("localize", request);
  };
  expectRefused(with("rangs", 1), "rangs");
  expectRefused(with("options", {{"method", "magic"}}), "options.method");
  expectRefused(with("options", {{"metod", "cells"}}), "options.metod");
  expectRefused(with("options", {{"max_hypotheses", 0}}), "options.max_hypotheses");
  expectRefused(with("options", {{"max_hypotheses", 2.5}}), "options.max_hypotheses");
  expectRefused(with("options", {{"time_budget_ms", -1}}), "options.time_budget_ms");
  expectRefused(with("options", {{"method", "exact"}}), "options.method");
  expectRefused(with("options", 3), "options");
  expectRefused(with("prior", {{"compass", {{"heading", 1}}}}), "prior.compass.tolerance");
  expectRefused(with("prior", {{"near", {{"x", "a"}, {"y", 1}, {"radius", 1}}}}), "prior.near.x");
  expectRefused(with("prior", {{"near", {{"x", 1}, {"y", 1}, {"radius", -1}}}}),
                "prior.near.radius");
  expectRefused(with("kinds", "hh"), "");
  expectRefused(with("ranges", "text"), "ranges");
  expectRefused(with("polygon", json::array()), "options.method");
  json ranges = good["ranges"];
  ranges[7] = "far";
  expectRefused(with("ranges", ranges), "ranges[7]");
  ranges[7] = 1e300;
  expectRefused(with("ranges", ranges), "ranges[7]");
  expectRefused(with("ranges", std::vector<double>(1'000'000, 1.0)), "ranges");
  expectRefused(post("localize", json::object()), "ranges");
  expectRefused(post("localize", json::array()), "");
  expectRefused(post("localize", 5), "");
  expectRefused(post("simulate", {{"pose", {{"x", 1}, {"y", 2}}}, {"laser", {{"beams", 0}}}}),
                "laser.beams");
  expectRefused(post("simulate", {{"pose", {{"x", 1}, {"y", 2}}},
                                  {"changes", {{"discs", {{{"x", 1}, {"y", 1}, {"radius", 0}}}}}}}),
                "changes.discs[0].radius");
}

TEST_F(ViewApi, WhatIsNoJsonIsRefused) {
  for (const char* text : {"", "{", "NaN", "{\"ranges\":[NaN]}", "{\"ranges\":[1e999]}",
                           "{\"ranges\":[Infinity]}", "\xff\xfe", "[[[[[[[[[[[["}) {
    EXPECT_EQ(postText("localize", text).status, 400) << text;
  }
  const std::string deep(100'000, '[');
  EXPECT_EQ(postText("localize", deep).status, 400);
  // The polygon of exact localization: not star-shaped.
  const json odd = {{"polygon", {{1, 1}, {2, 2}, {3, 1}}}, {"options", {{"method", "exact"}}}};
  EXPECT_EQ(post("localize", odd).status, 400);
}

TEST_F(ViewApi, OnlyJsonIsTaken) {
  auto result = client().Post("/api/v1/localize", "{}", "text/plain");
  EXPECT_EQ(answerOf(result).status, 415);
}

TEST_F(ViewApi, OtherPathsAndMethods) {
  EXPECT_EQ(get("nothing").status, 404);
  EXPECT_EQ(answerOf(client().Get("/api/v2/health")).status, 404);
  EXPECT_EQ(answerOf(client().Get("/../../etc/passwd")).status, 404);
  EXPECT_EQ(answerOf(client().Get("/%2e%2e/%2e%2e/etc/passwd")).status, 404);
  EXPECT_EQ(get("localize").status, 404);
  EXPECT_TRUE(get("nothing").body.contains("error"));
  const auto root = client().Get("/");
  ASSERT_TRUE(root);
  EXPECT_EQ(root->status, 200);
  EXPECT_NE(root->body.find("polyloc"), std::string::npos);
  EXPECT_NE(root->get_header_value("Content-Security-Policy").find("default-src 'self'"),
            std::string::npos);
}

TEST_F(ViewApi, ForeignPagesAreRefused) {
  const auto with = [&](const httplib::Headers& headers) {
    return answerOf(client().Get("/api/v1/health", headers)).status;
  };
  const std::string host = "127.0.0.1:" + std::to_string(server_->port());
  EXPECT_EQ(with({{"Host", host}}), 200);
  EXPECT_EQ(with({{"Host", "localhost:1"}}), 200);
  EXPECT_EQ(with({{"Host", "rebound.example"}}), 403);
  EXPECT_EQ(with({{"Host", "127.0.0.1.example"}}), 403);
  EXPECT_EQ(with({{"Host", "192.168.1.5"}}), 403);
  EXPECT_EQ(with({{"Host", host}, {"Origin", "http://" + host}}), 200);
  EXPECT_EQ(with({{"Host", host}, {"Origin", "http://example.org"}}), 403);
  EXPECT_EQ(with({{"Host", host}, {"Origin", "http://127.0.0.1:1"}}), 403);
  EXPECT_EQ(with({{"Host", host}, {"Origin", "null"}}), 403);
}

TEST_F(ViewApi, SixtyFourClientsAtOnceGetTheSame) {
  json request = scanFrom(2.8, 1.0, 0.7);
  request["search"] = json::object();
  const std::string first = post("simulate", request).body["result"]["hypotheses"].dump();
  std::vector<std::string> answers(64);
  std::vector<std::thread> clients;
  for (std::string& answer : answers) {
    clients.emplace_back([&] {
      const Answer got = post("simulate", request);
      answer =
          got.status == 200 ? got.body["result"]["hypotheses"].dump() : std::to_string(got.status);
    });
  }
  for (std::thread& thread : clients) thread.join();
  for (const std::string& answer : answers) EXPECT_EQ(answer, first);
}

/// A connection that sends a text and then nothing.
int silentClient(int port, const std::string& text) {
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  ::inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
  EXPECT_EQ(::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(::send(fd, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  return fd;
}

TEST_F(ViewApi, ClientsThatSendNothingDoNotStopOthers) {
  std::vector<int> silent;
  for (int i = 0; i < 40; ++i) silent.push_back(silentClient(server_->port(), ""));
  silent.push_back(silentClient(server_->port(), "POST /api/v1/localize HTTP/1.1\r\n"));
  silent.push_back(silentClient(server_->port(),
                                "POST /api/v1/localize HTTP/1.1\r\nHost: 127.0.0.1\r\n"
                                "Content-Type: application/json\r\nContent-Length: 50\r\n\r\n{"));
  EXPECT_EQ(get("health").status, 200);
  // They are closed in the end: a read sees the end, at most after an answer that says so.
  for (const int fd : silent) {
    timeval patience{30, 0};
    ::setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    char buffer[4096];
    ssize_t got = 1;
    while (got > 0) got = ::recv(fd, buffer, sizeof buffer, 0);
    EXPECT_EQ(got, 0);
    ::close(fd);
  }
}

TEST_F(ViewApi, AHundredMegabytesAreRefusedAndNotKept) {
  const std::size_t before = server_->peakMemory();
  const std::string large(100U << 20U, ' ');
  auto sender = client();
  const auto refused = sender.Post("/api/v1/localize", large, "application/json");
  // Closed while we were sending, or told.
  EXPECT_TRUE(!refused || refused->status == 413);
  // Without a length: in pieces.
  auto chunked = client();
  const auto in_pieces = chunked.Post(
      "/api/v1/localize",
      [&](std::size_t, httplib::DataSink& sink) {
        for (int i = 0; i < 100; ++i) {
          if (!sink.write(large.data(), 1U << 20U)) return false;
        }
        sink.done();
        return true;
      },
      "application/json");
  EXPECT_TRUE(!in_pieces || in_pieces->status == 413);
  EXPECT_EQ(get("health").status, 200);
  EXPECT_LT(server_->peakMemory(), before + (70U << 20U));
}

TEST_F(ViewApi, ANewerRequestOfAJobTakesThePlaceOfTheOlder) {
  // Many of one job at once: each either is answered or was overtaken, and the last is answered.
  json request = scanFrom(2.8, 1.0, 0.7);
  request["search"] = json::object();
  request["job"] = "page-1";
  std::vector<int> statuses(32, 0);
  std::vector<std::thread> clients;
  for (int& status : statuses)
    clients.emplace_back([&] { status = post("simulate", request).status; });
  for (std::thread& thread : clients) thread.join();
  for (const int status : statuses) EXPECT_TRUE(status == 200 || status == 409) << status;
  EXPECT_EQ(post("simulate", request).status, 200);
  EXPECT_GE(std::count(statuses.begin(), statuses.end(), 200), 1);
}

}  // namespace
}  // namespace mrpt_polyloc::test
