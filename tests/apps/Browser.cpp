#include "Browser.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <httplib.h>
#include <netinet/in.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace mrpt_polyloc::test {
namespace {

using nlohmann::json;

std::string programOf(const std::string& name) {
  for (const char* folder : {"/usr/bin/", "/usr/lib/chromium/", "/usr/local/bin/"}) {
    if (::access((folder + name).c_str(), X_OK) == 0) return folder + name;
  }
  return {};
}

void pause(int ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

/// A port that is free now.
int freePort() {
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* any = reinterpret_cast<sockaddr*>(&address);
  const bool is_known = ::bind(fd, any, size) == 0 && ::getsockname(fd, any, &size) == 0;
  ::close(fd);
  return is_known ? ntohs(address.sin_port) : 0;
}

std::string decoded(const std::string& base64) {
  std::string bytes;
  unsigned value = 0;
  int bits = 0;
  for (const char c : base64) {
    unsigned digit = 0;
    if (c >= 'A' && c <= 'Z')
      digit = static_cast<unsigned>(c - 'A');
    else if (c >= 'a' && c <= 'z')
      digit = static_cast<unsigned>(c - 'a') + 26;
    else if (c >= '0' && c <= '9')
      digit = static_cast<unsigned>(c - '0') + 52;
    else if (c == '+')
      digit = 62;
    else if (c == '/')
      digit = 63;
    else
      continue;
    value = (value << 6U) | digit;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>((value >> static_cast<unsigned>(bits)) & 255U);
  }
  return bytes;
}

}  // namespace

std::string Browser::missing() {
  if (programOf("chromedriver").empty()) return "no chromedriver (Debian: chromium-driver)";
  if (programOf("chromium").empty()) return "no chromium (Debian: chromium)";
  return {};
}

Browser::Browser() : port_(freePort()) {
  const std::string program = programOf("chromedriver");
  const std::string port = "--port=" + std::to_string(port_);
  driver_ = ::fork();
  if (driver_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    ::setpgid(0, 0);
    const int null = ::open("/dev/null", O_RDWR);
    ::dup2(null, STDOUT_FILENO);
    ::dup2(null, STDERR_FILENO);
    ::execl(program.c_str(), program.c_str(), port.c_str(), nullptr);
    ::_exit(127);
  }
  httplib::Client client("127.0.0.1", port_);
  client.set_read_timeout(5);
  for (int i = 0; i < 300 && !client.Get("/status"); ++i) pause(100);
  const json arguments = {"--headless=new", "--no-sandbox", "--disable-gpu",
                          "--disable-dev-shm-usage", "--hide-scrollbars"};
  const json wanted = {{"goog:loggingPrefs", {{"browser", "ALL"}}},
                       {"goog:chromeOptions", {{"args", arguments}}}};
  session_ = call("POST", "/session", {{"capabilities", {{"alwaysMatch", wanted}}}})["sessionId"];
}

Browser::~Browser() {
  try {
    if (!session_.empty()) call("DELETE", "/session/" + session_, nullptr);
  } catch (const std::exception&) {
    // It is ended below.
  }
  if (driver_ > 0) {
    ::kill(-driver_, SIGTERM);
    ::waitpid(driver_, nullptr, 0);
  }
}

json Browser::call(const std::string& method, const std::string& path, const json& body) {
  httplib::Client client("127.0.0.1", port_);
  client.set_read_timeout(120);
  const auto result = method == "POST"  ? client.Post(path, body.dump(), "application/json")
                      : method == "GET" ? client.Get(path)
                                        : client.Delete(path);
  if (!result) throw std::runtime_error("the browser's driver does not answer " + path);
  const json value = json::parse(result->body)["value"];
  if (value.is_object() && value.contains("error")) {
    throw std::runtime_error(path + ": " + value["message"].get<std::string>());
  }
  return value;
}

json Browser::ofSession(const std::string& path, const json& body) {
  return call("POST", "/session/" + session_ + path, body);
}

void Browser::emulate(int width, int height, bool dark) {
  ofSession(
      "/goog/cdp/execute",
      {{"cmd", "Emulation.setDeviceMetricsOverride"},
       {"params",
        {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}}}});
  const json scheme = {{"name", "prefers-color-scheme"}, {"value", dark ? "dark" : "light"}};
  ofSession("/goog/cdp/execute", {{"cmd", "Emulation.setEmulatedMedia"},
                                  {"params", {{"features", json::array({scheme})}}}});
}

void Browser::open(const std::string& url) {
  // Addresses that differ after the # alone would keep the page.
  ofSession("/url", {{"url", "about:blank"}});
  ofSession("/url", {{"url", url}});
}

void Browser::reload() {
  ofSession("/refresh", json::object());
}

void Browser::leave() {
  run("if (location.protocol === 'http:') { localStorage.clear(); sessionStorage.clear(); }");
  ofSession("/url", {{"url", "about:blank"}});
}

json Browser::run(const std::string& script) {
  return ofSession("/execute/sync", {{"script", "return (async () => {" + script + "})()"},
                                     {"args", json::array()}});
}

bool Browser::waitFor(const std::string& expression) {
  for (int i = 0; i < 600; ++i) {
    const json value = run("return Boolean(" + expression + ")");
    if (value == true) return true;
    pause(100);
  }
  return false;
}

void Browser::act(const json& sources) {
  ofSession("/actions", {{"actions", sources}});
}

void Browser::drag(const std::vector<std::pair<double, double>>& places) {
  json actions = json::array();
  for (const auto& [x, y] : places) {
    actions.push_back({{"type", "pointerMove"},
                       {"duration", actions.empty() ? 0 : 40},
                       {"origin", "viewport"},
                       {"x", static_cast<int>(x)},
                       {"y", static_cast<int>(y)}});
    if (actions.size() == 1) actions.push_back({{"type", "pointerDown"}, {"button", 0}});
  }
  actions.push_back({{"type", "pointerUp"}, {"button", 0}});
  act(json::array({{{"type", "pointer"}, {"id", "mouse"}, {"actions", actions}}}));
}

void Browser::pinch(double x, double y, double apart, double apart_at_last) {
  json fingers = json::array();
  for (const double side : {-0.5, 0.5}) {
    json actions = json::array();
    constexpr int kSteps = 4;
    for (int step = 0; step <= kSteps; ++step) {
      const double now = apart + (apart_at_last - apart) * step / kSteps;
      actions.push_back({{"type", "pointerMove"},
                         {"duration", step == 0 ? 0 : 40},
                         {"origin", "viewport"},
                         {"x", static_cast<int>(x + side * now)},
                         {"y", static_cast<int>(y)}});
      if (step == 0) actions.push_back({{"type", "pointerDown"}, {"button", 0}});
    }
    actions.push_back({{"type", "pointerUp"}, {"button", 0}});
    fingers.push_back({{"type", "pointer"},
                       {"id", side < 0 ? "left" : "right"},
                       {"parameters", {{"pointerType", "touch"}}},
                       {"actions", actions}});
  }
  act(fingers);
}

void Browser::wheel(double x, double y, int amount) {
  const json scroll = {{"type", "scroll"},         {"x", static_cast<int>(x)},
                       {"y", static_cast<int>(y)}, {"deltaX", 0},
                       {"deltaY", amount},         {"duration", 0},
                       {"origin", "viewport"}};
  act(json::array({{{"type", "wheel"}, {"id", "wheel"}, {"actions", json::array({scroll})}}}));
}

void Browser::press(const std::string& key, const std::string& held) {
  json actions = json::array();
  const auto add = [&](const char* type, const std::string& value) {
    if (!value.empty()) actions.push_back({{"type", type}, {"value", value}});
  };
  add("keyDown", held);
  add("keyDown", key);
  add("keyUp", key);
  add("keyUp", held);
  act(json::array({{{"type", "key"}, {"id", "keyboard"}, {"actions", actions}}}));
}

std::string Browser::screenshot() {
  return decoded(call("GET", "/session/" + session_ + "/screenshot", nullptr).get<std::string>());
}

std::vector<std::string> Browser::complaints() {
  std::vector<std::string> found;
  for (const json& entry : ofSession("/se/log", {{"type", "browser"}})) {
    // That a server has ended, or an answer was overtaken, is no fault of the page.
    const std::string message = entry["message"];
    const bool is_connection = message.find("net::ERR_") != std::string::npos ||
                               message.find("status of 409") != std::string::npos;
    if (entry["level"] == "SEVERE" && !is_connection) found.push_back(message);
  }
  return found;
}

}  // namespace mrpt_polyloc::test
