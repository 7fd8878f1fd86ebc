#pragma once

#include "Jobs.h"
#include "RequestGuard.h"
#include "endpoints.h"

#include <atomic>
#include <memory>
#include <string>

namespace httplib {
class Server;
}

namespace mrpt_polyloc::apps {

/// The HTTP side: which request goes where, what is refused, how errors are told. Writes nothing,
/// and reads no path that a request names.
class ViewServer {
 public:
  static constexpr std::size_t kMostBytes = 16U << 20U;  ///< of a request's body
  /// Connections that are served at once; those that send nothing are closed after some seconds.
  static constexpr std::size_t kConnections = 128;
  static constexpr int kReadSeconds = 5;

  /// Keeps the references. \param address to listen on
  ViewServer(const Services& services, const std::string& address);
  ~ViewServer();

  /// Takes the port; 0: any that is free. \returns the port
  /// \throws std::runtime_error saying why not
  int bind(int port);
  /// Answers until stop() is called.
  void serve();
  /// From another thread than serve()'s, which must be running or about to: cancels what is being
  /// computed, and ends it.
  void stop();

 private:
  void addPage();
  void addAnswers();

  std::string address_;
  RequestGuard guard_;
  Services services_;
  Jobs jobs_;
  std::unique_ptr<httplib::Server> server_;
  std::atomic<bool> has_ended_{false};
  int listening_ = -1;  ///< socket of the server, which is its owner
};

}  // namespace mrpt_polyloc::apps
