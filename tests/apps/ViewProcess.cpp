#include "ViewProcess.h"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <poll.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace mrpt_polyloc::test {
namespace {

/// The first line that comes through a pipe; empty if none comes in time.
std::string firstLine(int pipe) {
  constexpr int kPatience = 60'000;  // [ms], for machines under load
  std::string line;
  for (char c = 0; c != '\n';) {
    pollfd waited{pipe, POLLIN, 0};
    if (::poll(&waited, 1, kPatience) <= 0 || ::read(pipe, &c, 1) != 1) return {};
    line += c;
  }
  return line;
}

}  // namespace

ViewProcess::ViewProcess(std::vector<std::string> arguments, int port) {
  arguments.insert(arguments.end(), {"--port", std::to_string(port)});
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  const std::string program = std::string(POLYLOC_PROGRAM_DIR) + "/polyloc-view";
  child_ = ::fork();
  if (child_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::dup2(ends[1], STDOUT_FILENO);
    ::close(ends[0]);
    ::close(ends[1]);
    std::vector<char*> argv = {const_cast<char*>(program.c_str())};
    for (const std::string& text : arguments) argv.push_back(const_cast<char*>(text.c_str()));
    argv.push_back(nullptr);
    ::execv(program.c_str(), argv.data());
    ::_exit(127);
  }
  ::close(ends[1]);
  const std::string line = child_ > 0 ? firstLine(ends[0]) : "";
  ::close(ends[0]);
  const std::string head = "listening on http://127.0.0.1:";
  if (line.compare(0, head.size(), head) == 0) port_ = std::atoi(line.c_str() + head.size());
  if (port_ == 0) {
    end(SIGKILL);
    throw std::runtime_error("polyloc-view does not listen, it says: " + line);
  }
}

ViewProcess::~ViewProcess() {
  if (child_ > 0) end(SIGTERM);
}

int ViewProcess::end(int signal) {
  if (child_ <= 0) return -1;
  ::kill(child_, signal);
  int status = 0;
  ::waitpid(child_, &status, 0);
  child_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::size_t ViewProcess::peakMemory() const {
  std::ifstream in("/proc/" + std::to_string(child_) + "/status");
  const std::string key = "VmHWM:";
  for (std::string line; std::getline(in, line);) {
    if (line.compare(0, key.size(), key) == 0) {
      return 1024 * std::strtoull(line.c_str() + key.size(), nullptr, 10);
    }
  }
  return 0;
}

}  // namespace mrpt_polyloc::test
