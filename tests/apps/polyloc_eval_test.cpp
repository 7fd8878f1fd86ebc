#include "ProgramTest.h"
#include <mrpt_polyloc/io/rawlog_writer.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace mrpt_polyloc::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class PolylocEval : public ProgramTest {
 protected:
  Outcome evaluate(const std::vector<std::string>& more,
                   const std::string& truth = "sim/truth.tum") const {
    std::vector<std::string> arguments = {
        "--map",   roomFile(),  "--scans", path("sim/scans.rawlog"),
        "--truth", path(truth), "-o",      path("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("polyloc-eval", arguments);
  }

  json summary() const { return json::parse(readFile(path("out/summary.json"))); }

  static std::vector<std::string> keysOf(const json& object) {
    std::vector<std::string> keys;
    for (const auto& item : object.items()) keys.push_back(item.key());
    return keys;
  }
};

TEST_F(PolylocEval, CleanScansOfAnAsymmetricRoomAreAllRight) {
  simulate("sim");
  const Outcome outcome = evaluate({});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(files("out"), ElementsAre("scans.csv", "summary.json"));
  const json result = summary();
  EXPECT_EQ(result["scans"], 12);
  for (const char* key : {"top1", "top5", "top20", "in_list"}) EXPECT_EQ(result[key], 1.0) << key;
  EXPECT_EQ(result["unique_right"], 1.0);
  EXPECT_LT(result["median_error_m"].get<double>(), 0.02);
  EXPECT_LT(result["median_error_deg"].get<double>(), 0.5);
  EXPECT_EQ(result["status"]["no_match"], 0);
  EXPECT_EQ(result["status"]["too_few_beams"], 0);
  EXPECT_FALSE(result.contains("good"));
  EXPECT_THAT(linesOf(readFile(path("out/scans.csv"))), SizeIs(13));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("top 1"), HasSubstr("100.0 %")));
}

TEST_F(PolylocEval, SummaryHasTheKeysOfTheDesign) {
  simulate("sim");
  write("good.txt", "# rows that agree with the map\n0\n3\n11\n");
  ASSERT_EQ(evaluate({"--good", path("good.txt")}).code, 0);
  const json result = summary();
  const std::vector<std::string> figures = {
      "scans",        "top1",   "top5",      "top20",          "in_list",
      "unique_right", "status", "ms_median", "median_error_m", "median_error_deg",
      "ms_p90",       "ms_max", "in_ellipse"};
  std::vector<std::string> all = figures;
  for (const char* key : {"index_build_s", "index_mb", "cold_start_s", "map", "good"})
    all.push_back(key);
  EXPECT_THAT(keysOf(result), testing::UnorderedElementsAreArray(all));
  EXPECT_THAT(keysOf(result["good"]), testing::UnorderedElementsAreArray(figures));
  EXPECT_THAT(keysOf(result["status"]),
              testing::UnorderedElementsAre("unique", "ambiguous", "no_match", "too_few_beams"));
  EXPECT_EQ(result["good"]["scans"], 3);
  EXPECT_EQ(result["map"]["vertices"], 13);
  EXPECT_GT(result["index_mb"].get<double>(), 0.0);
}

TEST_F(PolylocEval, ToleranceDecidesWhatIsRight) {
  simulate("sim");
  ASSERT_EQ(evaluate({"--tolerance", "0.000001,0.000001"}).code, 0);
  const json result = summary();
  EXPECT_EQ(result["top1"], 0.0);
  EXPECT_TRUE(result["median_error_m"].is_null());
}

TEST_F(PolylocEval, FiguresDoNotDependOnThreads) {
  simulate("sim", {"--short", "0.3"});
  const auto figures = [&](const char* threads) {
    EXPECT_EQ(evaluate({"--threads", threads}).code, 0);
    json result = summary();
    EXPECT_GT(result["cold_start_s"], result["index_build_s"]);
    for (const char* time : {"ms_median", "ms_p90", "ms_max", "index_build_s", "cold_start_s"}) {
      result.erase(time);
    }
    return result;
  };
  EXPECT_EQ(figures("1"), figures("2"));
}

TEST_F(PolylocEval, CellsFindTheSame) {
  simulate("sim");
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--method", "cells"},
        std::vector<std::string>{"--method", "cells", "--range", "3", "--threads", "2"}}) {
    const Outcome outcome = evaluate(more);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json result = summary();
    EXPECT_EQ(result["scans"], 12);
    for (const char* key : {"top1", "top20", "unique_right"}) EXPECT_EQ(result[key], 1.0) << key;
    EXPECT_LT(result["median_error_m"].get<double>(), 0.02);
    EXPECT_GT(result["index_mb"].get<double>(), 0.0);
  }
}

TEST_F(PolylocEval, TruthThatDoesNotMatchFails) {
  simulate("sim");
  const std::vector<std::string> lines = linesOf(readFile(path("sim/truth.tum")));
  std::string short_truth, doubled_truth;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i + 1 < lines.size()) short_truth += lines[i] + "\n";
    doubled_truth += lines[i] + "\n" + (i == 4 ? lines[i] + "\n" : "");
  }
  write("short.tum", short_truth);
  write("doubled.tum", doubled_truth);
  write("broken.tum", "1000000000.0 1 2\n");
  write("empty.tum", "");
  for (const char* truth : {"short.tum", "doubled.tum", "broken.tum", "empty.tum", "missing.tum"}) {
    const Outcome outcome = evaluate({}, truth);
    EXPECT_EQ(outcome.code, 1) << truth;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("polyloc-eval: "), HasSubstr(truth)));
    EXPECT_FALSE(std::filesystem::exists(path("out"))) << truth;
  }
  EXPECT_THAT(evaluate({}, "broken.tum").err, HasSubstr("line 1"));
}

TEST_F(PolylocEval, BadRowsOfGoodFileFail) {
  simulate("sim");
  const auto expectFailure = [&](const char* text, const char* place) {
    write("good.txt", text);
    const Outcome outcome = evaluate({"--good", path("good.txt")});
    EXPECT_EQ(outcome.code, 1) << text;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("good.txt"), HasSubstr(place)));
  };
  expectFailure("0\n12\n", "line 2");
  expectFailure("x\n", "line 1");
  expectFailure("1\n2\n1\n", "line 3");
}

TEST_F(PolylocEval, UnwritableFolderFails) {
  simulate("sim");
  write("out", "a file");
  const Outcome outcome = evaluate({});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr(path("out")));
}

TEST_F(PolylocEval, AMissingMapFails) {
  simulate("sim");
  const Outcome outcome =
      run("polyloc-eval", {"--map", "gone.yaml", "--scans", path("sim/scans.rawlog"), "--truth",
                           path("sim/truth.tum"), "-o", path("out")});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("gone.yaml"), HasSubstr("no such file")));
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

}  // namespace
}  // namespace mrpt_polyloc::test
