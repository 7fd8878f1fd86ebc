#pragma once

#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <sys/types.h>
#include <vector>

namespace mrpt_polyloc::test {

/// Keys as WebDriver writes them, where they are no characters.
inline const std::string kEnterKey = "\uE007";
inline const std::string kShiftKey = "\uE008";
inline const std::string kEscapeKey = "\uE00C";
inline const std::string kLeftKey = "\uE012";

/// A headless Chromium, steered through its driver (https://www.w3.org/TR/webdriver2/).
class Browser {
 public:
  /// The reason why there can be no browser here; empty if there can.
  static std::string missing();

  Browser();
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// Size of the page in pixels, and light or dark, as if the device was so.
  void emulate(int width, int height, bool dark = false);
  void open(const std::string& url);
  void reload();
  /// Closes the page, with all that it has stored.
  void leave();
  /// Runs the body of a function in the page; a promise is waited for.
  nlohmann::json run(const std::string& script);
  /// Waits until an expression is true. \returns whether that was within a minute
  bool waitFor(const std::string& expression);
  /// Presses at the first place, goes through the others, and lets go; in pixels of the page.
  void drag(const std::vector<std::pair<double, double>>& places);
  void click(double x, double y) { drag({{x, y}}); }
  /// Two fingers beside a place, so far apart [pixels] at first and at last.
  void pinch(double x, double y, double apart, double apart_at_last);
  void wheel(double x, double y, int amount);
  /// A key as WebDriver writes it, with the key held down meanwhile if one is given.
  void press(const std::string& key, const std::string& held = "");
  std::string screenshot();  ///< a PNG
  /// What went wrong in the page since the last call: errors of scripts, resources not found.
  std::vector<std::string> complaints();

 private:
  nlohmann::json call(const std::string& method, const std::string& path,
                      const nlohmann::json& body);
  nlohmann::json ofSession(const std::string& path, const nlohmann::json& body);
  void act(const nlohmann::json& sources);

  pid_t driver_ = -1;
  int port_ = 0;
  std::string session_;
};

}  // namespace mrpt_polyloc::test
