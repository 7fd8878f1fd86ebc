#include "ViewPage.h"
#include "view_maps.h"

#include <string>

/// What hands do on the page of polyloc-view beside the robot, and what it does when nobody looks.
namespace mrpt_polyloc::test {
namespace {

class ViewHand : public ViewPage {
 protected:
  void take(const std::string& tool) {
    browser().run("document.querySelector('[name=tool][value=" + tool + "]').click()");
  }
  /// Sum of all ranges of the scan that is shown [m].
  double seen() {
    return browser().run("return polyloc.data.answer.scan.ranges.reduce((a, b) => a + b, 0)");
  }
};

TEST_F(ViewHand, ObjectsAreDroppedAndWallsAreMovedByTheMouse) {
  const ViewProcess server({kFlat});
  open(server, "x=8&y=7&deg=0&sigma=0");
  const double before = seen();
  take("disc");
  const auto [px, py] = onPage(9.8, 7.0);
  browser().click(px, py);
  ASSERT_TRUE(settled());
  EXPECT_NE(state("discs"), "");
  EXPECT_NEAR(state("x").get<double>(), 8.0, 1e-9);  // the robot stays
  EXPECT_LT(seen(), before - 1.0);
  browser().run("document.getElementById('tidy').click()");
  ASSERT_TRUE(settled());
  EXPECT_EQ(state("discs"), "");
  EXPECT_NEAR(seen(), before, 1e-6);

  // The wall that is nearest to where the drag begins: the flat's upper one.
  take("wall");
  const auto from = onPage(8.0, 7.9), to = onPage(8.0, 7.5);
  browser().drag({from, {from.first, 0.5 * (from.second + to.second)}, to});
  ASSERT_TRUE(settled());
  EXPECT_NE(state("walls"), "");
  EXPECT_LT(seen(), before - 1.0);
  EXPECT_EQ(browser().run("return document.querySelector('[name=tool]:checked').value"), "robot");
  browser().press("u");
  ASSERT_TRUE(settled());
  EXPECT_NEAR(seen(), before, 1e-6);
}

TEST_F(ViewHand, KeysMoveTheWallAhead) {
  const ViewProcess server({kFlat});
  open(server, "x=8&y=7&deg=90&sigma=0");
  const std::string count = "return polyloc.state.walls.split(';').filter(Boolean).length";
  const double before = seen();
  browser().press("w");
  ASSERT_TRUE(settled());
  EXPECT_EQ(browser().run(count), 1);
  const double pushed = seen();
  EXPECT_GT(pushed, before + 1.0);
  browser().press("w");  // the same on
  ASSERT_TRUE(settled());
  EXPECT_EQ(browser().run(count), 1);
  EXPECT_GT(seen(), pushed + 1.0);
  browser().press("w", kShiftKey);
  ASSERT_TRUE(settled());
  EXPECT_NEAR(seen(), pushed, 1e-3);
  browser().press("u");
  ASSERT_TRUE(settled());
  EXPECT_NEAR(seen(), before, 1e-6);
}

TEST_F(ViewHand, TwoFingersZoom) {
  const ViewProcess server({kFlat});
  open(server, "x=2.8&y=1");
  const double zoom = browser().run("return polyloc.camera.zoom");
  const auto [px, py] = onPage(8.0, 6.0);
  browser().pinch(px, py, 60, 180);
  EXPECT_NEAR(browser().run("return polyloc.camera.zoom").get<double>() / zoom, 3.0, 0.3);
  const auto still = onPage(8.0, 6.0);
  EXPECT_NEAR(still.first, px, 12);
  EXPECT_NEAR(still.second, py, 12);
  EXPECT_NEAR(state("x").get<double>(), 2.8, 1e-9);
}

TEST_F(ViewHand, InTheBackgroundItAsksForNothing) {
  const ViewProcess server({kFlat});
  open(server, "x=2.8&y=1");
  // As the browser tells a page that is hidden; requests are counted.
  const std::string hide =
      "Object.defineProperty(document, 'hidden', { configurable: true, get: () => globalThis.away "
      "});"
      "dispatchEvent(new Event('visibilitychange'));";
  browser().run(
      "globalThis.asked = 0; const real = fetch;"
      "globalThis.fetch = (...what) => { ++globalThis.asked; return real(...what); };"
      "globalThis.away = true;" +
      hide);
  browser().run("await new Promise((done) => setTimeout(done, 7000)); globalThis.first = asked;");
  browser().run("await new Promise((done) => setTimeout(done, 7000))");
  EXPECT_EQ(browser().run("return asked - first"), 0);
  EXPECT_LE(browser().run("return first").get<int>(), 1);  // one may have been under way
  browser().run("globalThis.away = false;" + hide);
  EXPECT_TRUE(browser().waitFor("asked > first"));
  browser().press("q");
  ASSERT_TRUE(settled());
  expectFirst(2.8, 1.0, 5);
}

}  // namespace
}  // namespace mrpt_polyloc::test
