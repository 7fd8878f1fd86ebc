#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/GzInputStream.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>
#include <zlib.h>

namespace mrpt_polyloc {

namespace {

constexpr std::size_t kChunk = 1U << 16U;
constexpr int kGzipWindowBits = 15 + 16;  // the largest window; a gzip header is expected

void requireRegularFile(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw FormatError(path, "", "no such file");
  if (std::filesystem::is_directory(status)) {
    throw FormatError(path, "", "is a directory, not a file");
  }
  if (!std::filesystem::is_regular_file(status)) throw FormatError(path, "", "not a regular file");
}

}  // namespace

/// Content of the file, chunk by chunk.
class GzInputStream::Source {
 public:
  Source(const std::string& path, AtCut at_cut)
      : path_(path), at_cut_(at_cut), file_(path, std::ios::binary) {
    if (!file_) throw FormatError(path_, "", "cannot be opened");
    fillInput();
    if (inflater_.avail_in == 0) throw FormatError(path_, "", "empty file");
    gzipped_ = inflater_.avail_in >= 2 && input_[0] == 0x1f && input_[1] == 0x8b;
    if (gzipped_ && inflateInit2(&inflater_, kGzipWindowBits) != Z_OK) throw std::bad_alloc();
  }
  ~Source() {
    if (gzipped_) inflateEnd(&inflater_);
  }
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  bool gzipped() const { return gzipped_; }
  const std::string& cut() const { return cut_; }
  std::uint64_t position() const { return position_; }

  /// Makes unread content available; false at the end of it.
  bool fill() {
    while (next_ == output_.size() && !done_) {
      output_.clear();
      next_ = 0;
      gzipped_ ? inflateChunk() : copyChunk();
    }
    return next_ < output_.size();
  }
  const unsigned char* unread() const { return output_.data() + next_; }
  std::size_t unreadCount() const { return output_.size() - next_; }
  void skip(std::size_t count) {
    next_ += count;
    position_ += count;
  }

 private:
  std::string place() const { return "byte " + std::to_string(consumed_ - inflater_.avail_in); }
  [[noreturn]] void fail(const std::string& reason) const {
    throw FormatError(path_, place(), reason);
  }

  void fillInput() {
    file_.read(reinterpret_cast<char*>(input_.data()), static_cast<std::streamsize>(kChunk));
    if (file_.bad()) throw FormatError(path_, "", "cannot be read");
    inflater_.next_in = input_.data();
    inflater_.avail_in = static_cast<unsigned>(file_.gcount());
    consumed_ += inflater_.avail_in;
  }

  void copyChunk() {
    output_.assign(inflater_.next_in, inflater_.next_in + inflater_.avail_in);
    fillInput();
    done_ = inflater_.avail_in == 0;
  }

  void inflateChunk() {
    if (inflater_.avail_in == 0) fillInput();
    if (inflater_.avail_in == 0) {
      if (!between_members_) {
        const std::string reason = "the compressed data is truncated";
        if (at_cut_ == AtCut::refuse || position_ == 0) fail(reason);
        cut_ = place() + ": " + reason;
      }
      done_ = true;
      return;
    }
    between_members_ = false;
    output_.resize(kChunk);
    inflater_.next_out = output_.data();
    inflater_.avail_out = kChunk;
    const int result = inflate(&inflater_, Z_NO_FLUSH);
    output_.resize(kChunk - inflater_.avail_out);
    if (result == Z_STREAM_END) {
      between_members_ = true;
      inflateReset(&inflater_);  // gzip files may be concatenated
    } else if (result == Z_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      fail("the compressed data is damaged" +
           (inflater_.msg == nullptr ? "" : " (" + std::string(inflater_.msg) + ")"));
    }
  }

  const std::string& path_;
  AtCut at_cut_;
  std::string cut_;
  std::ifstream file_;
  bool gzipped_ = false;
  bool between_members_ = false;
  bool done_ = false;
  z_stream inflater_{};
  std::array<unsigned char, kChunk> input_{};
  std::uint64_t consumed_ = 0;  ///< bytes read from the file
  std::vector<unsigned char> output_;
  std::size_t next_ = 0;
  std::uint64_t position_ = 0;
};

GzInputStream::GzInputStream(const std::string& path, AtCut at_cut) : path_(path) {
  requireRegularFile(path_);
  Source check(path_, at_cut);
  if (check.gzipped()) {
    while (check.fill()) check.skip(check.unreadCount());
    if (check.position() == 0) throw FormatError(path_, "", "empty file (nothing was compressed)");
    cut_ = check.cut();
  }
  source_ = std::make_unique<Source>(path_, at_cut);
}

GzInputStream::~GzInputStream() = default;

bool GzInputStream::atEnd() {
  return !source_->fill();
}

bool GzInputStream::readLine(std::string& line) {
  line.clear();
  line_had_end_ = false;
  if (atEnd()) return false;
  while (source_->fill()) {
    const auto* begin = source_->unread();
    const auto* end = begin + source_->unreadCount();
    const auto* newline = std::find(begin, end, static_cast<unsigned char>('\n'));
    line.append(begin, newline);
    const bool found = newline != end;
    source_->skip(static_cast<std::size_t>(newline - begin) + (found ? 1U : 0U));
    line_had_end_ = found;
    if (found) break;
  }
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return true;
}

std::string GzInputStream::readAll() {
  std::string content;
  while (source_->fill()) {
    content.append(source_->unread(), source_->unread() + source_->unreadCount());
    source_->skip(source_->unreadCount());
  }
  return content;
}

std::size_t GzInputStream::Read(void* buffer, std::size_t count) {
  auto* out = static_cast<unsigned char*>(buffer);
  std::size_t done = 0;
  while (done < count && source_->fill()) {
    const std::size_t step = std::min(count - done, source_->unreadCount());
    std::memcpy(out + done, source_->unread(), step);
    source_->skip(step);
    done += step;
  }
  return done;
}

std::size_t GzInputStream::Write(const void* /*buffer*/, std::size_t /*count*/) {
  throw std::logic_error("GzInputStream is read only");
}

std::uint64_t GzInputStream::Seek(std::int64_t /*offset*/, CStream::TSeekOrigin /*origin*/) {
  throw std::logic_error("GzInputStream cannot seek");
}

std::uint64_t GzInputStream::getTotalBytesCount() const {
  return std::filesystem::file_size(path_);
}

std::uint64_t GzInputStream::getPosition() const {
  return source_->position();
}

}  // namespace mrpt_polyloc
