#include "ProgramTest.h"
#include "driven_room.h"
#include <mrpt_polyloc/evaluation/calibration_files.h>
#include <mrpt_polyloc/evaluation/stretches.h>
#include <mrpt_polyloc/evaluation/truth.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
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

/// Lists of a small room: one set of files, one simulated, one of several plans.
class PolylocEvalList : public ProgramTest {
 protected:
  std::string list(const std::string& methods = "certified") const {
    simulate("sim", {"--short", "0.3"});
    write("good.txt", "0\n3\n11\n");
    write("plans.tsv",
          "box\tPOLYGON ((0 0, 5 0, 5 3, 2 3, 2 4, 0 4, 0 0))\n"
          "hall 2\tPOLYGON ((0 0, 9 0, 9 3, 7 3, 7 5, 0 5, 0 0))\n");
    return write("list.yaml",
                 "datasets:\n"
                 "  - {name: files, map: room.wkt, scans: sim/scans.rawlog, truth: sim/truth.tum, "
                 "good: good.txt}\n"
                 "  - {name: plan, plans: plans.tsv, simulate: {n: 5, seed: 3, short: 0.2}}\n"
                 "  - {name: every, map: room.wkt, simulate: {n: 9, seed: 1, fov: 180, wing_scale: "
                 "0.01}, every: 3, max_range: 12}\n"
                 "methods: [" +
                     methods + "]\n");
  }
  Outcome evaluate(const std::vector<std::string>& arguments) const {
    return run("polyloc-eval", arguments);
  }
  json summary(const std::string& folder) const {
    return json::parse(readFile(path(folder + "/summary.json")));
  }
  /// What must not hang on how it was run: no times, no memory, no date.
  json timeless(const std::string& folder) const {
    json result = summary(folder);
    result.erase("run");
    for (const char* key : {"results", "all"}) {
      for (json& entry : result[key]) {
        const auto forget = [](json& figures) {
          for (const char* time : {"ms_median", "ms_p90", "ms_max"}) figures.erase(time);
        };
        forget(entry);
        if (entry.contains("good")) forget(entry["good"]);
        for (const char* time : {"index_build_s", "cold_start_s"}) entry.erase(time);
      }
    }
    return result;
  }
  /// All files below a folder, with what they hold.
  std::map<std::string, std::string> contents(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(path(folder))) {
      if (entry.is_regular_file()) files[entry.path().string()] = readFile(entry.path());
    }
    return files;
  }
  /// The whole lines of a file, one of them without a field, as a version before it wrote them.
  void forgetField(const std::string& file, std::size_t number, const std::string& field) const {
    std::vector<std::string> lines = linesOf(readFile(path(file)));
    json line = json::parse(lines.at(number - 1));
    ASSERT_EQ(line.erase(field), 1u);
    lines[number - 1] = line.dump();
    std::string text;
    for (const std::string& whole : lines) text += whole + "\n";
    write(file, text);
  }
  /// The estimates, which evo would read.
  std::string estimates(const std::string& folder) const {
    return readFile(path(folder + "/estimates/files@certified.tum"));
  }
};

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

TEST_F(PolylocEvalList, AKilledRunGoesOnAndCountsNothingTwice) {
  const std::string file = list("certified, correlative");
  ASSERT_EQ(evaluate({file, "-o", path("whole")}).code, 0);
  ASSERT_EQ(evaluate({file, "-o", path("out")}).code, 0);
  // As kills leave it: results not written, some parts cut anywhere, some not begun.
  for (const double share : {0.0, 0.1, 0.45, 0.8, 0.999}) {
    for (const char* name : {"summary.json", "scans.csv", "report.html"}) {
      fs::remove(path(std::string("out/") + name));
    }
    std::size_t number = 0;
    for (const auto& entry : fs::directory_iterator(path("out/parts"))) {
      if (entry.path().extension() != ".jsonl") continue;
      const auto size = static_cast<double>(fs::file_size(entry.path()));
      if (++number % 3 == 0) {
        fs::remove(entry.path());
      } else {
        fs::resize_file(entry.path(), static_cast<std::uintmax_t>(share * size));
      }
    }
    write("out/.tmp-1-0-summary.json", "half");
    const Outcome outcome = evaluate({file, "-o", path("out"), "--resume", "--threads", "2"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(timeless("out"), timeless("whole")) << share;
    EXPECT_EQ(estimates("out"), estimates("whole"));
    EXPECT_FALSE(fs::exists(path("out/.tmp-1-0-summary.json")));
  }
}

TEST_F(PolylocEvalList, GoesOnOnlyWithTheSameRun) {
  const std::string file = list();
  ASSERT_EQ(evaluate({file, "-o", path("out")}).code, 0);
  Outcome outcome = evaluate({file, "-o", path("out")});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr(path("out")), HasSubstr("--resume")));
  outcome = evaluate({list("{name: certified, method: certified, max_hypotheses: 4}"), "-o",
                      path("out"), "--resume"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("differs in methods"));
  // The same list, but other scans in its files.
  simulate("sim", {"--short", "0.1"});
  write("list.yaml", readFile(file));
  const std::string again = list();
  simulate("sim", {"--short", "0.1"});
  outcome = evaluate({again, "-o", path("out"), "--resume"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("differs in inputs_hash"));
}

TEST_F(PolylocEvalList, GoesOnOnlyWithTheSameOptionsOfSetsAndCalibration) {
  list();
  const auto listOf = [&](const std::string& tolerance) {
    return write("list.yaml", "datasets:\n  - {name: files, map: room.wkt, scans: " +
                                  std::string("sim/scans.rawlog, truth: sim/truth.tum, ") +
                                  "tolerance: \"" + tolerance +
                                  "\", calibration: own.json}\nmethods: [certified]\n");
  };
  write("own.json", calibrationJson(Calibration{}).dump());
  const std::string file = listOf("0.3,5");
  ASSERT_EQ(evaluate({file, "-o", path("out")}).code, 0);
  const auto before = contents("out");
  const auto expectRefusal = [&](const std::string& field) {
    const Outcome outcome = evaluate({file, "-o", path("out"), "--resume"});
    EXPECT_EQ(outcome.code, 1) << field;
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("files@certified.jsonl"), HasSubstr("differs in " + field)));
    EXPECT_EQ(contents("out"), before) << field;
  };
  listOf("0.5,5");
  expectRefusal("dataset_options");
  listOf("0.3,5");
  Calibration other;
  other.least_match_probability = 0.4;
  write("own.json", calibrationJson(other).dump());
  expectRefusal("calibration_hash");
}

TEST_F(PolylocEvalList, FoldersOfAnotherVersionAreRefusedAndLeftAsTheyAre) {
  const std::string file = list();
  const auto makeFolders = [&] {
    for (const char* folder : {"out", "share1", "share2", "bad"}) fs::remove_all(path(folder));
    ASSERT_EQ(evaluate({file, "-o", path("out")}).code, 0);
    for (const std::string i : {"1", "2"}) {
      ASSERT_EQ(evaluate({file, "--shard", i + "/2", "-o", path("share" + i)}).code, 0);
    }
  };
  const auto expectRefusal = [&](const std::string& folder, const std::vector<std::string>& words) {
    const auto before = contents(folder);
    std::vector<std::string> arguments = {file, "--resume", "-o", path("out")};
    if (folder != "out") arguments = {"merge", path("share1"), path("share2"), "-o", path("bad")};
    const Outcome outcome = evaluate(arguments);
    EXPECT_EQ(outcome.code, 1) << words.front();
    for (const std::string& word : words) EXPECT_THAT(outcome.err, HasSubstr(word));
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("another version of polyloc-eval"),
                                   HasSubstr("another folder"), Not(HasSubstr("exception"))));
    EXPECT_EQ(contents(folder), before) << words.front();
    EXPECT_FALSE(fs::exists(path("bad")));
  };
  for (const std::string folder : {"out", "share2"}) {
    makeFolders();
    json run = json::parse(readFile(path(folder + "/parts/run.json")));
    run["format"] = 1;
    write(folder + "/parts/run.json", run.dump() + "\n");
    expectRefusal(folder, {folder + "/parts/run.json: ", "format 1, not "});
    run.erase("format");
    write(folder + "/parts/run.json", run.dump() + "\n");
    expectRefusal(folder, {folder + "/parts/run.json: ", "has no 'format'"});
  }
  // A part may be of a version that counted formats as this one does: of a copied file, say.
  makeFolders();
  const std::string part = "/parts/plan-hall-2@certified.jsonl";  // not the first of the run
  forgetField("out" + part, 3, "in_ellipse");
  expectRefusal("out", {"out" + part + ": line 3: ", "has no 'in_ellipse'"});
  for (const std::string share : {"share1", "share2"}) {
    if (readFile(path(share + part)).empty()) continue;
    forgetField(share + part, 2, "traits");
    expectRefusal(share, {share + part + ": line 2: ", "has no 'traits'"});
    makeFolders();
  }
  forgetField("share2/parts/files.map.json", 1, "stretches");
  expectRefusal("share2", {"share2/parts/files.map.json: ", "has no 'stretches'"});
  // Of the folder of a run it is written anew, for it is made from the inputs alone.
  forgetField("out/parts/files.map.json", 1, "stretches");
  EXPECT_EQ(evaluate({file, "--resume", "-o", path("out")}).code, 0);
}

TEST_F(PolylocEvalList, SharesPutTogetherAreTheWhole) {
  const std::string file = list("certified, correlative");
  ASSERT_EQ(evaluate({file, "-o", path("whole")}).code, 0);
  std::vector<std::string> merge = {"merge"};
  for (const std::string i : {"1", "2", "3"}) {
    const Outcome outcome = evaluate({file, "--shard", i + "/3", "-o", path("share" + i)});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_FALSE(fs::exists(path("share" + i + "/summary.json")));
    merge.push_back(path("share" + i));
  }
  std::vector<std::string> arguments = merge;
  arguments.insert(arguments.end(), {"-o", path("merged")});
  const Outcome outcome = evaluate(arguments);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(timeless("merged"), timeless("whole"));
  EXPECT_EQ(estimates("merged"), estimates("whole"));

  const auto expectFailure = [&](const std::vector<std::string>& shares, const char* message) {
    std::vector<std::string> bad_merge = {"merge"};
    for (const std::string& share : shares) bad_merge.push_back(path(share));
    bad_merge.insert(bad_merge.end(), {"-o", path("bad")});
    const Outcome bad = evaluate(bad_merge);
    EXPECT_EQ(bad.code, 1);
    EXPECT_THAT(bad.err, HasSubstr(message));
    EXPECT_FALSE(fs::exists(path("bad")));
  };
  expectFailure({"share1", "share3"}, "a share of the run is not there");
  expectFailure({"share1", "share2", "share2", "share3"}, "is there a second time");
  expectFailure({"share1", "sim"}, "no run of polyloc-eval");
  std::string run = readFile(path("share2/parts/run.json"));
  const std::string version = POLYLOC_VERSION;
  run.replace(run.find("\"" + version + "\""), version.size() + 2, "\"0.0.0\"");
  write("share2/parts/run.json", run);
  expectFailure({"share1", "share2", "share3"}, "differs in version");
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

TEST_F(PolylocEvalList, AFullDiskIsToldAndTheRunGoesOnAfterwards) {
  const std::string file = list();
  // The shell's limit on the size of a file stands in for a disk that is full: 2 blocks of 512.
  const std::string shell = "../../../../../../../../../../bin/sh";
  const std::string program = std::string(POLYLOC_PROGRAM_DIR) + "/polyloc-eval";
  const Outcome outcome = run(shell, {"-c", "trap '' XFSZ; ulimit -f 2; exec '" + program + "' '" +
                                                file + "' -o '" + path("out") + "'"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("cannot be written"));
  EXPECT_FALSE(fs::exists(path("out/summary.json")));
  ASSERT_EQ(evaluate({file, "-o", path("out"), "--resume"}).code, 0);
  ASSERT_EQ(evaluate({file, "-o", path("whole")}).code, 0);
  EXPECT_EQ(timeless("out"), timeless("whole"));
}

TEST_F(PolylocEvalList, APartThatIsNoFileIsRefused) {
  const std::string file = list();
  fs::create_directories(path("out/parts/files@certified.jsonl"));
  const Outcome outcome = evaluate({file, "-o", path("out")});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("files@certified.jsonl"), HasSubstr("no regular file")));
}

}  // namespace
}  // namespace mrpt_polyloc::test
