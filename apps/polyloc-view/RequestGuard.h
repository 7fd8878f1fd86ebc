#pragma once

#include <optional>
#include <string>

namespace mrpt_polyloc::apps {

/// Keeps pages of other sites away from the server, which answers whoever reaches it: a browser
/// lets any page send requests to 127.0.0.1, and a name that is suddenly resolved to it (DNS
/// rebinding) makes such a page one of our own.
class RequestGuard {
 public:
  /// \param address that is listened on
  explicit RequestGuard(std::string address) : address_(std::move(address)) {}

  /// Why a request is refused; nothing if it is not. The Host must be this machine by number or
  /// as localhost; where others are let in by --listen, any number, or the address itself. An
  /// Origin, if there is one, must be that very host.
  /// \param host, origin the headers as they were sent; empty: none
  std::optional<std::string> refusal(const std::string& host, const std::string& origin) const;

 private:
  std::string address_;
};

/// Whether an address means this machine alone: 127.0.0.0/8, ::1 or localhost.
bool isLoopback(const std::string& address);

/// Whether a text is an address by number, IPv4 or IPv6 (in brackets or not).
bool isNumericAddress(const std::string& text);

}  // namespace mrpt_polyloc::apps
