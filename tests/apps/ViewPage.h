#pragma once

#include "Browser.h"
#include "ProgramTest.h"
#include "ViewProcess.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace mrpt_polyloc::test {

/// The page of polyloc-view in a real browser. Skipped, by name, where there is none.
class ViewPage : public ProgramTest {
 protected:
  void SetUp() override {
    if (!Browser::missing().empty()) GTEST_SKIP() << Browser::missing();
    // One for all tests of a process: its start takes as long as many a test.
    static Browser browser;
    browser_ = &browser;
    browser_->emulate(1200, 760);
  }
  void TearDown() override {
    if (!browser_) return;
    const std::vector<std::string> complaints = browser_->complaints();
    EXPECT_TRUE(complaints.empty() || expects_complaints_) << nlohmann::json(complaints).dump(1);
    browser_->leave();
  }

  Browser& browser() { return *browser_; }

  /// Opens the page at a state and waits for its answer.
  void open(const ViewProcess& server, const std::string& state) {
    browser().open(server.url() + "/#" + state);
    ASSERT_TRUE(settled());
  }
  bool settled() {
    return browser().waitFor("globalThis.polyloc?.data.answer && !polyloc.isBusy()");
  }
  nlohmann::json state(const std::string& key) {
    return browser().run("return polyloc.state." + key);
  }
  nlohmann::json result() { return browser().run("return polyloc.data.answer.result"); }
  /// Where a place of the map is on the page [pixels].
  std::pair<double, double> onPage(double x, double y) {
    const nlohmann::json at = browser().run(
        "const box = document.getElementById('map').getBoundingClientRect();"
        "const [px, py] = polyloc.camera.toScreen(" +
        std::to_string(x) + "," + std::to_string(y) + "); return [box.left + px, box.top + py]");
    return {at[0].get<double>(), at[1].get<double>()};
  }
  void expectFirst(double x, double y, double deg) {
    const nlohmann::json first = result()["hypotheses"][0];
    EXPECT_NEAR(first["x"].get<double>(), x, 0.15);
    EXPECT_NEAR(first["y"].get<double>(), y, 0.15);
    EXPECT_LT(std::abs(std::remainder(first["phi"].get<double>() * 180 / M_PI - deg, 360)), 4.0);
  }

  bool expects_complaints_ = false;

 private:
  Browser* browser_ = nullptr;
};

}  // namespace mrpt_polyloc::test
