#include "fuzz_target.h"

#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <unistd.h>

namespace mrpt_polyloc::fuzz {

namespace {

/// A folder of this process, removed with all in it when the process ends as it should.
class OwnFolder {
 public:
  OwnFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("polyloc_fuzz_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~OwnFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

  std::filesystem::path path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

std::map<std::string, TargetFunction>& targets() {
  static std::map<std::string, TargetFunction> all;
  return all;
}

void feed(TargetFunction target, const std::string& bytes) {
  try {
    target(bytes);
  } catch (const FormatError& error) {
    must(error.what()[0] != '\0', "a FormatError says something");
  } catch (const InvalidMapError&) {
  } catch (const InvalidParamsError&) {
  } catch (const std::exception& error) {
    std::fprintf(stderr, "another exception than those of bad input: %s\n", error.what());
    std::abort();
  }
}

std::string inputFile(const std::string& name, const std::string& bytes) {
  static const OwnFolder folder;
  const std::string path = (folder.path() / name).string();
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  must(static_cast<bool>(file.flush()), "the input file is written");
  return path;
}

}  // namespace mrpt_polyloc::fuzz

#ifdef POLYLOC_LIBFUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto& [name, target] = *mrpt_polyloc::fuzz::targets().begin();
  mrpt_polyloc::fuzz::feed(target, std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
#endif

// A file may ask for more memory than there is. Machines differ in how they say so; here as little
// as half a gigabyte is refused, as an exception, in the one way that C++ has. What is taken in
// other ways, as MRPT takes the readings of a scan, address sanitizer refuses as much of; without
// it a limit of the process does, see replay.cpp.
extern "C" const char* __asan_default_options() {
  return "max_allocation_size_mb=512:allocator_may_return_null=1:detect_leaks=0";
}

namespace {
constexpr std::size_t kMostBytes = std::size_t{1} << 29U;

void* allocate(std::size_t size) {
  void* memory = size > kMostBytes ? nullptr : std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace

void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new[](std::size_t size) {
  return allocate(size);
}
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return size > kMostBytes ? nullptr : std::malloc(size == 0 ? 1 : size);
}
void* operator new[](std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return size > kMostBytes ? nullptr : std::malloc(size == 0 ? 1 : size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}
void operator delete(void* memory, const std::nothrow_t& /*tag*/) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, const std::nothrow_t& /*tag*/) noexcept {
  std::free(memory);
}
