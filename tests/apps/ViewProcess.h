#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace mrpt_polyloc::test {

/// A running polyloc-view, on a port of its own; ended when this is destroyed.
class ViewProcess {
 public:
  /// \param arguments those of the program, without --port
  /// \throws std::runtime_error if it does not say within some seconds that it listens
  explicit ViewProcess(std::vector<std::string> arguments, int port = 0);
  ~ViewProcess();
  ViewProcess(const ViewProcess&) = delete;
  ViewProcess& operator=(const ViewProcess&) = delete;

  int port() const { return port_; }
  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_); }
  /// Sends a signal and waits for the end. \returns the exit code, or -1 if it was killed
  int end(int signal);
  /// Greatest memory in use so far [bytes].
  std::size_t peakMemory() const;

 private:
  pid_t child_ = -1;
  int port_ = 0;
};

}  // namespace mrpt_polyloc::test
