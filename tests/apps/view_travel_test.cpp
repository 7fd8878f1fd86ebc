#include "ProgramTest.h"
#include "ViewProcess.h"
#include "apps/polyloc-travel/TravelRun.h"
#include "apps/polyloc-travel/World.h"
#include "view_answers.h"
#include "view_maps.h"
#include <mrpt_polyloc/geometry/validation.h>
#include <mrpt_polyloc/io/wkt.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <httplib.h>
#include <string>
#include <thread>
#include <vector>

/// The second stage in the API of polyloc-view: `travel` and `plan`.
namespace mrpt_polyloc::test {
namespace {

using nlohmann::json;

constexpr const char* kCorridor = "POLYGON ((0 0, 12 0, 12 2, 0 2, 0 0))\n";
constexpr std::size_t kEnough = 60;  ///< steps, for these maps

class ViewTravel : public ProgramTest {
 protected:
  static Answer post(const ViewProcess& server, const std::string& path, const json& body) {
    httplib::Client client("127.0.0.1", server.port());
    client.set_read_timeout(300);
    return answerOf(client.Post("/api/v1/" + path, body.dump(), "application/json"));
  }
  static void expectRefused(const Answer& answer, const std::string& place, int status = 400) {
    ASSERT_EQ(answer.status, status) << answer.body;
    EXPECT_EQ(answer.body["error"]["place"], place) << answer.body;
    EXPECT_FALSE(answer.body["error"]["message"].get<std::string>().empty());
  }
  /// Goes on until the drive is over; the steps.
  static std::vector<json> toTheEnd(const ViewProcess& server, json request) {
    std::vector<json> steps;
    for (std::size_t step = 0; step < kEnough; ++step) {
      request["step"] = step;
      const Answer answer = post(server, "travel", request);
      EXPECT_EQ(answer.status, 200) << answer.body;
      if (answer.status != 200) return steps;
      EXPECT_EQ(answer.body["step"], step);
      steps.push_back(answer.body);
      if (!answer.body["outcome"].is_null()) return steps;
    }
    ADD_FAILURE() << "not over after " << kEnough << " steps";
    return steps;
  }
};

/// Deep in an outer niche of the niches map, where its twin looks alike.
json twinStart() {
  return {{"pose", {{"x", 4.5}, {"y", -3.25}, {"phi", kPi / 2}}},
          {"laser", {{"beams", 180}, {"sigma", 0.02}, {"seed", 3}}}};
}

/// What does not depend on the clock.
json withoutTimes(json answer) {
  answer["result"].erase("ms");
  if (answer["plan"].is_object()) answer["plan"].erase("planning_ms");
  return answer;
}

/// A place of the robot's frame in the map.
TPoint2D placedAt(const json& pose, double x, double y) {
  const double phi = pose["phi"], c = std::cos(phi), s = std::sin(phi);
  return {pose["x"].get<double>() + c * x - s * y, pose["y"].get<double>() + s * x + c * y};
}

TEST_F(ViewTravel, DrivesOutOfATwinNicheUntilItKnows) {
  const ViewProcess server({kNiches});
  const std::vector<json> steps = toTheEnd(server, twinStart());
  ASSERT_GE(steps.size(), 2U);
  const json& first = steps.front();
  EXPECT_EQ(first["result"]["status"], "ambiguous");
  ASSERT_EQ(first["result"]["hypotheses"].size(), 2U);
  EXPECT_EQ(first["plan"]["status"], "go");
  EXPECT_GT(first["plan"]["value"].get<double>(), 0.1);
  EXPECT_EQ(first["plan"]["falls"].size(), 2U);  // each by the other
  EXPECT_TRUE(first["fallen"].empty());
  EXPECT_EQ(first["travelled"], 0.0);

  const json& last = steps.back();
  EXPECT_EQ(last["outcome"], "localized");
  EXPECT_EQ(last["result"]["status"], "unique");
  EXPECT_TRUE(last["plan"].is_null());
  EXPECT_LT(last["error"]["m"].get<double>(), 0.3);
  EXPECT_EQ(last["collisions"], 0);
  EXPECT_EQ(last["scans"], steps.size());
  EXPECT_EQ(last["stops"].size(), steps.size());
  const json& found = last["result"]["hypotheses"][0];
  expectPose(found, last["pose"]["x"], last["pose"]["y"], last["pose"]["phi"]);
  // The twin fell, nine metres beside the way.
  ASSERT_FALSE(last["fallen"].empty());
  bool is_beside = false;
  for (const json& fallen : last["fallen"]) {
    is_beside |= std::abs(fallen["x"].get<double>() - last["pose"]["x"].get<double>() - 9) < 0.7;
    EXPECT_GE(fallen["step"].get<std::size_t>(), 1U);
  }
  EXPECT_TRUE(is_beside) << last["fallen"];
  // Asked beyond its end it is at its end.
  json beyond = twinStart();
  beyond["step"] = 150;
  EXPECT_EQ(post(server, "travel", beyond).body, last);
}

TEST_F(ViewTravel, TheSafeSetIsFreeUnderEachHypothesis) {
  const ViewProcess server({kNiches});
  const PolygonMap map = repairMap(parseWkt(readFile(kNiches), kNiches)).map;
  const json answer = post(server, "travel", twinStart()).body;
  ASSERT_FALSE(answer["safe"].empty());
  std::size_t corners = 0;
  for (const json& ring : answer["safe"]) {
    for (std::size_t i = 0; i + 1 < ring.size(); i += 2) {
      ++corners;
      for (const json& h : answer["result"]["hypotheses"]) {
        // A square's corner: 7 cm from its centre, which keeps the robot's radius from all walls.
        EXPECT_TRUE(map.contains(placedAt(h, ring[i], ring[i + 1])));
      }
    }
  }
  EXPECT_GT(corners, 8U);
  // The waypoint lies in it, for it is driven to.
  const json& stop = answer["plan"]["waypoint"];
  bool is_in = false;
  for (const json& ring : answer["safe"]) {
    const double x = stop["x"], y = stop["y"];
    for (std::size_t i = 0; i + 3 < ring.size(); i += 2) {
      const double ay = ring[i + 1], by = ring[i + 3];
      if ((ay > y) == (by > y)) continue;
      const double ax = ring[i], bx = ring[i + 2];
      if (x < ax + (y - ay) / (by - ay) * (bx - ax)) is_in = !is_in;
    }
  }
  EXPECT_TRUE(is_in);
}

TEST_F(ViewTravel, IsTheRunOfPolylocTravel) {
  const ViewProcess server({kNiches});
  const std::vector<json> steps = toTheEnd(server, twinStart());
  const PolygonMap map = repairMap(parseWkt(readFile(kNiches), kNiches)).map;
  const MapIndex::Ptr index = MapIndex::build(map);
  TravelPlannerParams params;
  SimulatorParams laser;
  laser.beams = 180;
  laser.sigma = 0.02;
  params.max_range = laser.max_range;
  const apps::World world(map, laser, 0, params.safe.robot_radius, 1);
  const apps::TravelRunResult run = apps::travel(
      TravelPlanner(index, params), GlobalLocalizer(index), world, {4.5, -3.25, kPi / 2}, {}, 3);
  EXPECT_EQ(steps.back()["outcome"], apps::toString(run.outcome));
  EXPECT_EQ(steps.size(), run.scans);
  EXPECT_DOUBLE_EQ(steps.back()["travelled"].get<double>(), run.travelled);
}

TEST_F(ViewTravel, AStepIsTheSameHoweverItIsAskedFor) {
  std::vector<json> steps;
  {
    const ViewProcess server({kNiches});
    steps = toTheEnd(server, twinStart());
    ASSERT_GE(steps.size(), 2U);
    // Back, from what is kept, and again when it is kept no longer.
    EXPECT_EQ(post(server, "travel", twinStart()).body, steps.front());
    for (int seed = 10; seed < 15; ++seed) {
      json other = twinStart();
      other["laser"]["seed"] = seed;
      EXPECT_EQ(post(server, "travel", other).status, 200);
    }
    EXPECT_EQ(withoutTimes(post(server, "travel", twinStart()).body), withoutTimes(steps.front()));
  }
  // At once, by a server that knows nothing of it, and by many clients.
  const ViewProcess server({kNiches});
  json request = twinStart();
  request["step"] = 1;
  std::vector<json> answers(12);
  std::vector<std::thread> clients;
  for (json& answer : answers) {
    clients.emplace_back([&] { answer = post(server, "travel", request).body; });
  }
  for (std::thread& client : clients) client.join();
  for (const json& answer : answers) EXPECT_EQ(withoutTimes(answer), withoutTimes(steps[1]));
}

TEST_F(ViewTravel, APriorMayDecideAtOnce) {
  const ViewProcess server({kNiches});
  json request = twinStart();
  request["prior"] = {{"near", {{"x", 4.5}, {"y", -3.25}, {"radius", 2.0}}}};
  const json answer = post(server, "travel", request).body;
  EXPECT_EQ(answer["outcome"], "localized");
  EXPECT_EQ(answer["step"], 0);
  EXPECT_TRUE(answer["plan"].is_null());
  EXPECT_TRUE(answer["safe"].empty());
  // A compass that is known does not tell these twins apart, and is carried along the drive.
  request["prior"] = {{"compass", {{"heading", kPi / 2}, {"tolerance", 0.1}}}};
  const std::vector<json> steps = toTheEnd(server, request);
  ASSERT_GE(steps.size(), 2U);
  EXPECT_EQ(steps.back()["outcome"], "localized");
}

TEST_F(ViewTravel, SaysWhatCannotBeTold) {
  const ViewProcess server({write("corridor.wkt", kCorridor)});
  const json request = {{"pose", {{"x", 3.0}, {"y", 1.0}, {"phi", 0.3}}},
                        {"laser", {{"max_range", 15.0}}}};
  const json last = toTheEnd(server, request).back();
  EXPECT_EQ(last["outcome"], "indistinguishable");
  EXPECT_EQ(last["plan"]["status"], "indistinguishable");
  EXPECT_TRUE(last["plan"]["waypoint"].is_null());
  EXPECT_GE(last["result"]["hypotheses"].size(), 2U);
}

TEST_F(ViewTravel, DrivesAroundWhatTheMapDoesNotHave) {
  const ViewProcess server({kNiches});
  json request = twinStart();
  const json free = post(server, "travel", request).body;
  request["changes"] = {{"discs", {{{"x", 4.8}, {"y", 0.8}, {"radius", 0.15}}}}};
  const json changed = post(server, "travel", request).body;
  EXPECT_LT(changed["plan"]["safe_area"].get<double>(),
            free["plan"]["safe_area"].get<double>() - 0.1);
  EXPECT_EQ(toTheEnd(server, request).back()["collisions"], 0);
}

TEST_F(ViewTravel, WrongInputIsToldWithItsPlace) {
  const ViewProcess server({kNiches});
  const auto with = [&](const char* name, const json& value) {
    json request = twinStart();
    request[name] = value;
    return post(server, "travel", request);
  };
  expectRefused(post(server, "travel", json::object()), "pose");
  expectRefused(post(server, "travel", 7), "");
  expectRefused(with("step", -1), "step");
  expectRefused(with("step", 1.5), "step");
  expectRefused(with("step", 1'000'000), "step");
  expectRefused(with("stepp", 1), "stepp");
  expectRefused(with("options", json::object()), "options");
  expectRefused(with("robot", {{"radius", 0}}), "robot.radius");
  expectRefused(with("robot", {{"radius", "wide"}}), "robot.radius");
  expectRefused(with("robot", {{"strategy", "best"}}), "robot.strategy");
  expectRefused(with("robot", {{"max_travel", -3}}), "robot.max_travel");
  expectRefused(with("robot", {{"odometry", {{"heading_per_metre", 2}}}}),
                "robot.odometry.heading_per_metre");
  expectRefused(with("robot", {{"speed", 1}}), "robot.speed");
  expectRefused(with("laser", {{"beams", 5000}}), "laser.beams");
  expectRefused(with("pose", {{"x", 400}, {"y", 0}}), "pose", 422);      // outside
  expectRefused(with("pose", {{"x", 4.5}, {"y", -3.85}}), "pose", 422);  // touching
  expectRefused(with("changes", {{"discs", {{{"x", 4.5}, {"y", -3.25}, {"radius", 0.1}}}}}), "pose",
                422);
}

/// A scan at a pose, as `plan` takes it.
json lookAt(const ViewProcess& server, double x, double y, double phi) {
  json request = twinStart();
  request["pose"] = {{"x", x}, {"y", y}, {"phi", phi}};
  httplib::Client client("127.0.0.1", server.port());
  client.set_read_timeout(120);
  return answerOf(client.Post("/api/v1/simulate", request.dump(), "application/json")).body["scan"];
}

TEST_F(ViewTravel, PlansForARealRobot) {
  const ViewProcess server({kNiches});
  json request = {{"looks", json::array({lookAt(server, 4.5, -3.25, kPi / 2)})}};
  const json plan = post(server, "plan", request).body;
  EXPECT_EQ(plan["status"], "go") << plan;
  EXPECT_EQ(plan["localization"], "ambiguous");
  ASSERT_EQ(plan["hypotheses"].size(), 2U);
  EXPECT_EQ(plan["falls"].size(), 2U);
  EXPECT_EQ(plan["map_hash"].get<std::string>().size(), 16U);
  // Out of the niche: ahead of a robot that looks up, in whatever niche it is.
  EXPECT_GT(plan["goal"]["x"].get<double>(), 0.5);
  EXPECT_GE(plan["path"].size(), plan["way"].size());
  // What is known decides; so do the scans of a drive into the hall.
  request["prior"] = {{"near", {{"x", 4.5}, {"y", -3.25}, {"radius", 2}}}};
  EXPECT_EQ(post(server, "plan", request).body["status"], "unique");
  json looks = json::array();
  for (const double y : {-3.25, -2.0, -0.75, 0.5, 1.5, 2.5}) {
    json look = lookAt(server, 4.5, y, kPi / 2);
    if (!looks.empty())
      look["moved"] = {{"x", y == -2.0 || y == -0.75 || y == 0.5 ? 1.25 : 1.0}, {"y", 0}};
    looks.push_back(look);
  }
  const json known = post(server, "plan", {{"looks", looks}}).body;
  EXPECT_EQ(known["status"], "unique") << known;
  expectPose(known["hypotheses"][0], 4.5, 2.5, kPi / 2);
}

TEST_F(ViewTravel, WrongLooksAreToldWithTheirPlace) {
  const ViewProcess server({kNiches});
  const json look = lookAt(server, 4.5, -3.25, kPi / 2);
  const auto with = [&](const char* name, const json& value) {
    json request = {{"looks", {look, look}}};
    request[name] = value;
    return post(server, "plan", request);
  };
  expectRefused(post(server, "plan", json::object()), "looks");
  expectRefused(with("looks", json::array()), "looks");
  expectRefused(with("looks", 3), "looks");
  expectRefused(with("looks", std::vector<int>(201, 1)), "looks");
  expectRefused(with("max_range", 0), "max_range");
  expectRefused(with("seed", -1), "seed");
  expectRefused(with("pose", {{"x", 1}, {"y", 1}}), "pose");
  json bad = look;
  bad["moved"] = {{"x", "far"}, {"y", 0}};
  expectRefused(with("looks", {look, bad}), "looks[1].moved.x");
  bad = look;
  bad["ranges"][3] = "near";
  expectRefused(with("looks", {look, bad}), "looks[1].ranges[3]");
  bad = look;
  bad["poses"] = 1;
  expectRefused(with("looks", json::array({bad})), "looks[0].poses");
  // A robot that sees nothing has nothing to drive by.
  bad = look;
  for (json& range : bad["ranges"]) range = nullptr;
  bad["kinds"] = std::string(180, 'i');
  // ... nor do its scans show how far it might see.
  expectRefused(post(server, "plan", {{"looks", json::array({bad})}}), "");
  const Answer blind = post(server, "plan", {{"looks", json::array({bad})}, {"max_range", 20}});
  EXPECT_EQ(blind.status, 200) << blind.body;
  EXPECT_EQ(blind.body["status"], "blocked");
  EXPECT_EQ(blind.body["localization"], "too_few_beams");
}

}  // namespace
}  // namespace mrpt_polyloc::test
