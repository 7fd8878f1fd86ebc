#include "driven_room.h"
#include "eval_list.h"
#include <mrpt_polyloc/evaluation/stretches.h>
#include <mrpt_polyloc/evaluation/truth.h>

#include <gmock/gmock.h>

#include <map>

namespace mrpt_polyloc::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;
using testing::SizeIs;

TEST_F(PolylocEvalList, RunsMethodsAndBaselinesOnAllSets) {
  const Outcome outcome =
      evaluate({list("certified, {name: few, method: cells, range: 6, max_hypotheses: 3}, "
                     "{name: field, method: likelihood_lattice, step: 0.5}, correlative"),
                "-o", path("out")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(files("out"),
              ElementsAre("estimates", "parts", "report.html", "scans.csv", "summary.json"));
  const json result = summary("out");
  ASSERT_THAT(result["results"], SizeIs(16));
  ASSERT_THAT(result["all"], SizeIs(4));
  EXPECT_EQ(result["results"][0]["dataset"], "files");
  EXPECT_EQ(result["results"][0]["good"]["scans"], 3);
  EXPECT_EQ(result["results"][4]["dataset"], "plan-box");
  EXPECT_EQ(result["results"][8]["dataset"], "plan-hall-2");
  EXPECT_EQ(result["results"][12]["scans"], 3);  // every third of nine
  for (const auto& of_method : result["all"]) {
    EXPECT_EQ(of_method["scans"], 12 + 2 * 5 + 3);
    EXPECT_GE(of_method["top1"], 0.75) << of_method["method"];
    EXPECT_LE(of_method["interval"]["top1"][0], of_method["top1"]);
    EXPECT_GE(of_method["interval"]["top1"][1], of_method["top1"]);
  }
  EXPECT_EQ(result["all"][2]["status"]["unique"], 0);  // baselines do not know
  // What a set by itself gives is what it gives in a list.
  const Outcome alone =
      evaluate({"--map", path("room.wkt"), "--scans", path("sim/scans.rawlog"), "--truth",
                path("sim/truth.tum"), "--good", path("good.txt"), "-o", path("alone")});
  ASSERT_EQ(alone.code, 0) << alone.err;
  const json one = summary("alone"), listed = result["results"][0];
  for (const char* key : {"scans", "top1", "top5", "top20", "in_list", "in_ellipse", "unique_right",
                          "median_error_m", "status", "map", "index_mb"}) {
    EXPECT_EQ(one[key], listed[key]) << key;
  }
  EXPECT_THAT(linesOf(readFile(path("out/scans.csv"))), SizeIs(1 + 4 * 25));
  EXPECT_THAT(linesOf(estimates("out")), SizeIs(12));
  EXPECT_THAT(linesOf(readFile(path("out/estimates/files.tum"))), SizeIs(12));
}

TEST_F(PolylocEvalList, ADriveIsTakenByScanSetsAndByTheParticleFilter) {
  const Drive drive = driveThroughRoom(30);
  writeActionLog(path("drive.rawlog"), drive);
  write("truth.tum", tumTruth(drive));
  roomFile();
  const auto listOf = [&](const std::string& name, const std::string& filter) {
    return write(name, "datasets:\n  - {name: drive, map: room.wkt, scans: drive.rawlog, truth: " +
                           std::string("truth.tum, every: 5}\nmethods: [certified, {name: set, ") +
                           "method: certified, accumulate: 2}, {name: filter, method: " + filter +
                           "}]\n");
  };
  const std::string file = listOf("list.yaml", "particle_filter, drive: 3, particles: 5000");
  ASSERT_EQ(evaluate({file, "-o", path("out")}).code, 0);
  const json result = summary("out")["results"];
  EXPECT_EQ(result[1]["scans"], 6);
  EXPECT_EQ(result[1]["top1"], 1.0);
  EXPECT_GE(result[2]["top1"], 0.5);  // what it makes of its first rows is luck
  EXPECT_EQ(result[2]["status"]["unique"], 0);
  // A set of scans costs other than its last alone; the first row is the same scan by itself.
  std::map<std::string, std::vector<std::string>> costs;
  for (const std::string& line : linesOf(readFile(path("out/scans.csv")))) {
    const std::vector<std::string> fields = fieldsOf(line);
    costs[fields[1]].push_back(fields[9]);
  }
  ASSERT_THAT(costs["set"], SizeIs(6));
  EXPECT_EQ(costs["set"].front(), costs["certified"].front());
  EXPECT_NE(costs["set"].back(), costs["certified"].back());
  // Threads, kills and shares change nothing.
  ASSERT_EQ(evaluate({file, "-o", path("threads"), "--threads", "2"}).code, 0);
  EXPECT_EQ(timeless("threads"), timeless("out"));
  EXPECT_EQ(readFile(path("threads/estimates/drive@filter.tum")),
            readFile(path("out/estimates/drive@filter.tum")));
  // Without a drive it has the row's scan alone, and other answers.
  const std::string alone = listOf("alone.yaml", "particle_filter, drive: 0, particles: 5000");
  ASSERT_EQ(evaluate({alone, "-o", path("alone")}).code, 0);
  EXPECT_NE(readFile(path("alone/estimates/drive@filter.tum")),
            readFile(path("out/estimates/drive@filter.tum")));
  const Outcome simulated = evaluate({list("particle_filter"), "-o", path("bad")});
  EXPECT_EQ(simulated.code, 1);
  EXPECT_THAT(simulated.err, HasSubstr("simulated ones are no drive"));
}

TEST_F(PolylocEvalList, StretchesAreOfTheWholeDriveWhateverRowsAreEvaluated) {
  // To and fro by 0.9 m, then a slow way off. The rows of every second scan seem to stand still,
  // and then to go half the way.
  constexpr std::size_t kRows = 60;
  ASSERT_EQ(run("polyloc-simulate", {"--map", roomFile(), "-n", std::to_string(kRows), "--seed",
                                     "1", "-o", path("sim")})
                .code,
            0);
  std::vector<StampedPose> truth;
  std::vector<mrpt::math::TPose2D> drive;
  for (std::size_t i = 0; i < kRows; ++i) {
    const double x = i < 40 ? (i % 2 == 0 ? 1.0 : 1.9) : 1.0 + 0.3 * static_cast<double>(i - 40);
    drive.emplace_back(x, 2.0, 0.0);
    truth.push_back({1e9 + static_cast<double>(i), drive.back()});
  }
  write("truth.tum", toTum(truth));
  const std::string file =
      write("list.yaml",
            "datasets:\n"
            "  - {name: all, map: room.wkt, scans: sim/scans.rawlog, truth: truth.tum, "
            "tolerance: \"2,90\"}\n"
            "  - {name: some, map: room.wkt, scans: sim/scans.rawlog, truth: truth.tum, "
            "tolerance: \"2,90\", every: 2}\n"
            "methods: [certified]\n");
  const Outcome outcome = evaluate({file, "-o", path("out")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;

  const std::vector<std::size_t> whole = stretchesOf(drive);
  std::vector<mrpt::math::TPose2D> evaluated;
  std::vector<std::size_t> expected;
  for (std::size_t i = 0; i < kRows; i += 2) {
    evaluated.push_back(drive[i]);
    expected.push_back(whole[i]);
  }
  ASSERT_GE(whole.back(), 3u);
  ASSERT_LT(stretchesOf(evaluated).back(), whole.back());  // what must not come out
  const auto kept = [&](const std::string& name) {
    return json::parse(readFile(path("out/parts/" + name + ".map.json")))["stretches"]
        .get<std::vector<std::size_t>>();
  };
  EXPECT_EQ(kept("all"), whole);
  EXPECT_EQ(kept("some"), expected);

  // And the interval is over them: some scans are right by luck.
  std::vector<bool> right;
  for (const std::string& line : linesOf(readFile(path("out/scans.csv")))) {
    const std::vector<std::string> fields = fieldsOf(line);
    if (fields[0] == "some") right.push_back(fields[5] == "1");
  }
  ASSERT_THAT(right, AllOf(SizeIs(kRows / 2), Contains(true), Contains(false)));
  const ShareInterval interval = shareInterval(right, expected);
  const json some = summary("out")["results"][1];
  EXPECT_EQ(some["stretches"], whole.back() + 1);
  EXPECT_EQ(some["interval"]["top1"], json({interval.low, interval.high}));
}

TEST_F(PolylocEvalList, BadListsAreRefusedWithFileAndLine) {
  list();
  const auto expectFailure = [&](const std::string& text, const std::string& message) {
    const std::string file = write("bad.yaml", text);
    const Outcome outcome = evaluate({file, "-o", path("bad")});
    EXPECT_EQ(outcome.code, 1) << text;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("bad.yaml: "), HasSubstr(message))) << text;
    EXPECT_FALSE(fs::exists(path("bad"))) << text;
  };
  const std::string good_set =
      "datasets:\n  - {name: a, map: room.wkt, simulate: {n: 2, seed: 1}}\n";
  const std::string method = "methods: [certified]\n";
  expectFailure("datasets: [\n", "not a YAML text");
  expectFailure("- a\n", "line 1: keys are expected");
  expectFailure(method, "'datasets' must be a list");
  expectFailure(good_set, "'methods' must be a list");
  expectFailure(good_set + method + "more: 1\n", "line 4: unknown key 'more'");
  expectFailure(good_set + method + "methods: [cells]\n", "'methods' a second time");
  expectFailure(good_set + "methods: [certified, certified]\n", "the method 'certified' a second");
  expectFailure(good_set + "methods: [quick]\n", "unknown method 'quick'");
  expectFailure(good_set + "methods:\n  - {name: x, method: cells, speed: 3}\n",
                "line 4: unknown key 'speed'");
  expectFailure(good_set + "methods:\n  - {name: x, method: certified, range: 3}\n",
                "--range is that of visibility cells");
  expectFailure(good_set + "methods:\n  - {name: x, method: correlative, sigma: -1}\n", "--sigma");
  expectFailure("datasets:\n  - {name: ../a, map: room.wkt, simulate: {n: 2, seed: 1}}\n" + method,
                "line 2: the name '../a'");
  expectFailure("datasets:\n  - {name: a, map: gone.wkt, simulate: {n: 2, seed: 1}}\n" + method,
                "line 2: map: no such file");
  expectFailure(
      "datasets:\n  - {name: a, map: \"${NO_SUCH_THING}/m.wkt\", simulate: {n: 2, seed: 1}}\n" +
          method,
      "no variable NO_SUCH_THING");
  expectFailure(
      "datasets:\n  - {name: a, map: room.wkt, simulate: {n: 2, seed: 1, size: 3}}\n" + method,
      "unknown key 'size'");
  expectFailure("datasets:\n  - {name: a, map: room.wkt, simulate: {n: 2}}\n" + method, "--seed");
  expectFailure("datasets:\n  - {name: a, map: room.wkt, scans: sim/scans.rawlog}\n" + method,
                "'truth' is missing");
  expectFailure(
      "datasets:\n  - {name: a, map: room.wkt, map: room.wkt, simulate: {n: 2, seed: 1}}\n" +
          method,
      "'map' a second time");
  expectFailure("datasets:\n  - {name: a, plans: plans.tsv, scans: sim/scans.rawlog}\n" + method,
                "'plans' needs 'simulate'");
}

TEST_F(PolylocEvalList, WrongUsageIsTold) {
  const std::string file = list();
  for (const char* shard : {"0/3", "4/3", "1", "a/b", "1/0"}) {
    const Outcome outcome = evaluate({file, "--shard", shard, "-o", path("out")});
    EXPECT_EQ(outcome.code, 2) << shard;
    EXPECT_THAT(outcome.err, HasSubstr("--shard"));
  }
  EXPECT_EQ(evaluate({file}).code, 2);
  EXPECT_EQ(evaluate({"merge", "-o", path("out")}).code, 2);
  EXPECT_FALSE(fs::exists(path("out")));
}

TEST_F(PolylocEvalList, TheReportIsOnePageThatNeedsNothingElse) {
  ASSERT_EQ(evaluate({list(), "-o", path("out")}).code, 0);
  const std::string page = readFile(path("out/report.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("<!doctype html>"), HasSubstr("plan-hall-2"),
                          Not(HasSubstr("%DATA%"))));
  for (const char* other : {"src=\"", "src='", "<link rel=\"stylesheet", "@import", "url(http",
                            "fetch(", "XMLHttpRequest"}) {
    EXPECT_THAT(page, Not(HasSubstr(other))) << other;
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
