#include "eval_list.h"
#include <mrpt_polyloc/evaluation/calibration_files.h>

#include <gmock/gmock.h>

#include <fstream>
#include <map>

namespace mrpt_polyloc::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Runs of lists that ended early, or in several shares, and what is kept of them.
class PolylocEvalResume : public PolylocEvalList {
 protected:
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
};

TEST_F(PolylocEvalResume, AKilledRunGoesOnAndCountsNothingTwice) {
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

TEST_F(PolylocEvalResume, GoesOnOnlyWithTheSameRun) {
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

TEST_F(PolylocEvalResume, GoesOnOnlyWithTheSameOptionsOfSetsAndCalibration) {
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

TEST_F(PolylocEvalResume, FoldersOfAnotherVersionAreRefusedAndLeftAsTheyAre) {
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

TEST_F(PolylocEvalResume, SharesPutTogetherAreTheWhole) {
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

TEST_F(PolylocEvalResume, AFullDiskIsToldAndTheRunGoesOnAfterwards) {
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

TEST_F(PolylocEvalResume, APartThatIsNoFileIsRefused) {
  const std::string file = list();
  fs::create_directories(path("out/parts/files@certified.jsonl"));
  const Outcome outcome = evaluate({file, "-o", path("out")});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("files@certified.jsonl"), HasSubstr("no regular file")));
}

}  // namespace
}  // namespace mrpt_polyloc::test
