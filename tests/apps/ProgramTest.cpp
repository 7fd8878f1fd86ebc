#include "ProgramTest.h"

#include <algorithm>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

namespace mrpt_polyloc::test {
namespace fs = std::filesystem;
namespace {

/// In the child: never returns.
[[noreturn]] void become(const std::string& program, const std::vector<std::string>& arguments,
                         const fs::path& folder, const fs::path& out, const fs::path& err) {
  const auto redirect = [](const char* path, int flags, int descriptor) {
    const int file = ::open(path, flags, 0600);
    if (file < 0 || ::dup2(file, descriptor) < 0) ::_exit(126);
  };
  redirect("/dev/null", O_RDONLY, STDIN_FILENO);
  redirect(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
  redirect(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
  if (::chdir(folder.c_str()) != 0) ::_exit(126);
  std::vector<char*> argv;
  argv.push_back(const_cast<char*>(program.c_str()));
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  ::execv(program.c_str(), argv.data());
  ::_exit(127);
}

fs::path makeTemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "polyloc-test-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  return name;
}

}  // namespace

std::string readFile(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

ProgramTest::ProgramTest() : folder_(makeTemporaryFolder()) {}

ProgramTest::~ProgramTest() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string ProgramTest::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
  return path(name);
}

std::vector<std::string> ProgramTest::files(const std::string& subfolder) const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_ / subfolder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Outcome ProgramTest::run(const std::string& program,
                         const std::vector<std::string>& arguments) const {
  const fs::path streams = makeTemporaryFolder();
  const fs::path out = streams / "out", err = streams / "err";
  const pid_t child = ::fork();
  if (child == 0) {
    become(std::string(POLYLOC_PROGRAM_DIR) + "/" + program, arguments, folder_, out, err);
  }
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child) throw std::runtime_error("no process");
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(out), readFile(err)};
  fs::remove_all(streams);
  return outcome;
}

std::string ProgramTest::roomFile() const {
  return write("room.wkt",
               "POLYGON ((0 0, 8 0, 8 3, 6 3, 6 5, 2.5 5, 2.5 6.2, 1 6.2, 1 5, 0 5, 0 0), "
               "(4 1, 4 2.2, 5.5 1.6, 4 1))\n");
}

void ProgramTest::simulate(const std::string& subfolder,
                           const std::vector<std::string>& more) const {
  std::vector<std::string> arguments = {"--map", roomFile(), "-n",   "12", "--seed",
                                        "7",     "--sigma",  "0.01", "-o", path(subfolder)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = run("polyloc-simulate", arguments);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
}

}  // namespace mrpt_polyloc::test
