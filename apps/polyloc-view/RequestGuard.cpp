#include "RequestGuard.h"

#include <algorithm>
#include <arpa/inet.h>
#include <cctype>

namespace mrpt_polyloc::apps {
namespace {

std::string withoutBrackets(const std::string& text) {
  const bool has = text.size() > 2 && text.front() == '[' && text.back() == ']';
  return has ? text.substr(1, text.size() - 2) : text;
}

/// `NAME[:PORT]` without its port, in small letters.
std::string nameOf(const std::string& host) {
  std::string name = host;
  const auto bracket = name.rfind(']');
  const auto colon = name.rfind(':');
  const bool is_bare_ipv6 = bracket == std::string::npos && name.find(':') != colon;
  if (colon != std::string::npos && !is_bare_ipv6 &&
      (bracket == std::string::npos || colon > bracket)) {
    name.erase(colon);
  }
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return withoutBrackets(name);
}

}  // namespace

bool isNumericAddress(const std::string& text) {
  unsigned char bytes[16];
  const std::string address = withoutBrackets(text);
  return ::inet_pton(AF_INET, address.c_str(), bytes) == 1 ||
         ::inet_pton(AF_INET6, address.c_str(), bytes) == 1;
}

bool isLoopback(const std::string& address) {
  unsigned char bytes[4];
  if (::inet_pton(AF_INET, address.c_str(), bytes) == 1) return bytes[0] == 127;
  return address == "::1" || address == "localhost";
}

std::optional<std::string> RequestGuard::refusal(const std::string& host,
                                                 const std::string& origin) const {
  const std::string name = nameOf(host);
  const bool is_own = isLoopback(name) || name == address_;
  const bool is_let_in = !isLoopback(address_) && isNumericAddress(name);
  if (!is_own && !is_let_in) return "this server is not called that: header Host";
  if (!origin.empty() && origin != "http://" + host) {
    return "pages of other sites are not answered: header Origin";
  }
  return std::nullopt;
}

}  // namespace mrpt_polyloc::apps
