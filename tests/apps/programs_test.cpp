// What all programs have in common: help, version, usage errors.

#include "ProgramTest.h"

#include <gmock/gmock.h>

namespace mrpt_polyloc::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class EveryProgram : public ProgramTest, public testing::WithParamInterface<const char*> {};

TEST_P(EveryProgram, HelpGoesToStdout) {
  for (const char* flag : {"-h", "--help"}) {
    const Outcome outcome = run(GetParam(), {flag});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.out, HasSubstr(std::string("Usage: ") + GetParam()));
    EXPECT_THAT(outcome.err, IsEmpty());
  }
}

TEST_P(EveryProgram, VersionIsThePackages) {
  const Outcome outcome = run(GetParam(), {"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, std::string(GetParam()) + " " + POLYLOC_VERSION + "\n");
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_P(EveryProgram, NoArgumentsIsAUsageError) {
  const Outcome outcome = run(GetParam(), {});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, StartsWith(std::string(GetParam()) + ": "));
  EXPECT_THAT(outcome.err, HasSubstr("is required"));
  EXPECT_THAT(outcome.out, IsEmpty());
}

TEST_P(EveryProgram, UnknownFlagIsAUsageError) {
  const Outcome outcome = run(GetParam(), {"--no-such-flag"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--no-such-flag"));
}

INSTANTIATE_TEST_SUITE_P(Programs, EveryProgram,
                         testing::Values("polyloc-map", "polyloc-localize", "polyloc-eval",
                                         "polyloc-simulate", "polyloc-calibrate", "polyloc-dataset",
                                         "polyloc-travel"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           name[name.find('-')] = '_';
                           return name;
                         });

/// A command line that cannot be obeyed, and what the message must say. Files need not exist: usage
/// is checked first.
struct BadUsage {
  const char* name;
  const char* program;
  std::vector<std::string> arguments;
  const char* message;
};

void PrintTo(const BadUsage& usage, std::ostream* out) {
  *out << usage.name;
}

class UsageErrors : public ProgramTest, public testing::WithParamInterface<BadUsage> {};

TEST_P(UsageErrors, ExitWithTwoAndSayWhy) {
  const BadUsage& usage = GetParam();
  const Outcome outcome = run(usage.program, usage.arguments);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr(usage.message));
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(files(), IsEmpty());
}

BadUsage localize(const char* name, std::vector<std::string> more, const char* message) {
  std::vector<std::string> arguments = {"--map", "a.wkt", "--scans", "a.rawlog"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return {name, "polyloc-localize", arguments, message};
}

BadUsage evaluate(const char* name, std::vector<std::string> more, const char* message) {
  std::vector<std::string> arguments = {"--map",   "a.wkt", "--scans", "a.rawlog",
                                        "--truth", "a.tum", "-o",      "out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return {name, "polyloc-eval", arguments, message};
}

BadUsage simulation(const char* name, std::vector<std::string> more, const char* message) {
  std::vector<std::string> arguments = {"--map", "a.wkt", "--seed", "1", "-o", "out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return {name, "polyloc-simulate", arguments, message};
}

INSTANTIATE_TEST_SUITE_P(
    Map, UsageErrors,
    testing::Values(
        BadUsage{"map_two_inputs", "polyloc-map", {"a.wkt", "b.wkt"}, "b.wkt"},
        BadUsage{"map_range_alone", "polyloc-map", {"a.wkt", "--range", "5"}, "requires --cells"},
        BadUsage{"map_empty_input", "polyloc-map", {""}, "empty"},
        BadUsage{"map_output_without_name", "polyloc-map", {"a.wkt", "-o"}, "-o"}),
    [](const auto& tested) { return tested.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Localize, UsageErrors,
    testing::Values(
        BadUsage{"no_scans", "polyloc-localize", {"--map", "a.wkt"}, "--scans is required"},
        localize("range_alone", {"--range", "5"}, "it needs --method cells"),
        localize("range_zero", {"--method", "cells", "--range", "0"}, "'0'"),
        localize("unknown_method", {"--method", "best"}, "unknown method 'best'"),
        localize("index", {"--method", "cells", "--index", "a.idx"},
                 "--index needs --method certified"),
        localize("calibration_exact", {"--method", "exact", "--calibration", "c.json"},
                 "does not go with --method exact"),
        localize("time_budget", {"--method", "exact", "--time-budget", "50"},
                 "--time-budget needs --method certified"),
        localize("search_metric", {"--method", "cells", "--search-metric", "polar"},
                 "--search-metric needs --method certified"),
        localize("unknown_metric", {"--search-metric", "euclid"}, "unknown metric 'euclid'"),
        localize("compass_nan", {"--compass", "nan"}, "'nan' is not a finite number"),
        localize("compass_word", {"--compass", "north"}, "'north'"),
        localize("tolerance_alone", {"--compass-tolerance", "5"}, "requires --compass"),
        localize("tolerance_negative", {"--compass", "5", "--compass-tolerance", "-1"}, "'-1'"),
        localize("tolerance_too_large", {"--compass", "5", "--compass-tolerance", "181"}, "'181'"),
        localize("near_two_numbers", {"--near", "1,2"}, "'1,2' is not X,Y,R"),
        localize("near_zero_radius", {"--near", "1,2,0"}, "'1,2,0' is not X,Y,R"),
        localize("near_infinite", {"--near", "inf,2,1"}, "'inf,2,1' is not X,Y,R"),
        localize("near_empty", {"--near", ""}, "'' is not X,Y,R"),
        localize("rows_backwards", {"--rows", "1,5-3"}, "'5-3' is neither"),
        localize("rows_negative", {"--rows", "-3"}, "'-3' is neither"),
        localize("rows_word", {"--rows", "first"}, "'first' is neither"),
        localize("rows_empty_part", {"--rows", "1,,2"}, "'' is neither"),
        localize("fov_zero", {"--laser-fov", "0"}, "'0' is not"),
        localize("fov_too_large", {"--laser-fov", "361"}, "'361' is not"),
        localize("no_hypotheses", {"--max-hypotheses", "0"}, "--max-hypotheses: '0'"),
        localize("no_threads", {"--threads", "0"}, "--threads: '0'"),
        localize("threads_fraction", {"--threads", "1.5"}, "--threads: '1.5'"),
        localize("maps_index", {"--map", "b.wkt", "--index", "a.idx"}, "are of one map")),
    [](const auto& tested) { return tested.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Eval, UsageErrors,
    testing::Values(evaluate("eval_method", {"--method", "best"}, "unknown method"),
                    evaluate("eval_map_twice", {"--map", "b.wkt"}, "--map"),
                    evaluate("eval_tolerance_one", {"--tolerance", "0.3"}, "'0.3' is not M,DEG"),
                    evaluate("eval_tolerance_zero", {"--tolerance", "0,5"}, "'0,5' is not M,DEG"),
                    evaluate("eval_tolerance_turn", {"--tolerance", "1,181"}, "'1,181' is not"),
                    BadUsage{"eval_no_output",
                             "polyloc-eval",
                             {"--map", "a.wkt", "--scans", "a.rawlog", "--truth", "a.tum"},
                             "-o is required"}),
    [](const auto& tested) { return tested.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Simulate, UsageErrors,
    testing::Values(simulation("no_count", {}, "-n is required"),
                    simulation("count_zero", {"-n", "0"}, "-n: '0'"),
                    simulation("count_negative", {"-n", "-5"}, "-n: '-5'"),
                    simulation("beams_zero", {"-n", "1", "--beams", "0"}, "--beams: '0'"),
                    simulation("wide", {"-n", "1", "--fov", "400"}, "--fov: '400'"),
                    simulation("sigma_negative", {"-n", "1", "--sigma", "-0.1"}, "--sigma: '-0.1'"),
                    simulation("range_zero", {"-n", "1", "--max-range", "0"}, "--max-range: '0'"),
                    simulation("dropout_above_one", {"-n", "1", "--dropout", "1.5"}, "'1.5'"),
                    simulation("short_negative", {"-n", "1", "--short", "-1"}, "--short: '-1'"),
                    simulation("clearance_inf", {"-n", "1", "--clearance", "inf"}, "'inf'"),
                    simulation("seed_word", {"-n", "1", "--seed", "x"}, "--seed")),
    [](const auto& tested) { return tested.param.name; });

BadUsage calibration(const char* name, std::vector<std::string> more, const char* message) {
  std::vector<std::string> arguments = {"sets.txt", "-o", "out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return {name, "polyloc-calibrate", arguments, message};
}

INSTANTIATE_TEST_SUITE_P(
    Calibrate, UsageErrors,
    testing::Values(
        BadUsage{"calibrate_no_output", "polyloc-calibrate", {"sets.txt"}, "-o is required"},
        calibration("lost_too_large", {"--lost", "0.6"}, "--lost: '0.6'"),
        calibration("lost_word", {"--lost", "few"}, "--lost: 'few'"),
        calibration("unique_negative", {"--unique-right", "-1"}, "--unique-right: '-1'"),
        calibration("weightless_clutter", {"--clutter-weight", "0"}, "--clutter-weight: '0'"),
        calibration("no_foreign", {"--foreign", "0"}, "--foreign: '0'"),
        calibration("no_own", {"--own", "0"}, "--own: '0'"),
        calibration("calibrate_threads", {"--threads", "0"}, "--threads: '0'"),
        evaluate("empty_calibration", {"--calibration", ""}, "--calibration: the text is empty")),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace mrpt_polyloc::test
