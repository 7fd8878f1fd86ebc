#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/limits.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>
#include <zlib.h>
#include <zstd.h>

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

enum class Compression { none, gzip, zstd };

Compression compressionOf(const char* head, std::size_t size) {
  const auto startsWith = [&](const char* magic, std::size_t length) {
    return size >= length && std::memcmp(head, magic, length) == 0;
  };
  if (startsWith("\x1f\x8b", 2)) return Compression::gzip;
  return startsWith("\x28\xb5\x2f\xfd", 4) ? Compression::zstd : Compression::none;
}

/// Input that is left.
struct Chunk {
  const unsigned char* next = nullptr;
  std::size_t left = 0;
};

/// Decompresses a stream of one or more members, piece by piece.
class Decoder {
 public:
  virtual ~Decoder() = default;
  /// Takes input, as much as makes at most `out`'s size of output, and shortens `out` to that.
  /// \return whether the end of a member was reached
  /// \throws std::runtime_error if the data is damaged
  virtual bool decode(Chunk& in, std::vector<unsigned char>& out) = 0;
};

[[noreturn]] void failDamaged(const char* why) {
  throw std::runtime_error("the compressed data is damaged" +
                           (why == nullptr ? "" : " (" + std::string(why) + ")"));
}

class GzipDecoder : public Decoder {
 public:
  GzipDecoder() {
    if (inflateInit2(&inflater_, kGzipWindowBits) != Z_OK) throw std::bad_alloc();
  }
  ~GzipDecoder() override { inflateEnd(&inflater_); }
  GzipDecoder(const GzipDecoder&) = delete;
  GzipDecoder& operator=(const GzipDecoder&) = delete;

  bool decode(Chunk& in, std::vector<unsigned char>& out) override {
    inflater_.next_in = const_cast<unsigned char*>(in.next);  // zlib does not write there
    inflater_.avail_in = static_cast<unsigned>(in.left);
    inflater_.next_out = out.data();
    inflater_.avail_out = static_cast<unsigned>(out.size());
    const int result = inflate(&inflater_, Z_NO_FLUSH);
    in = {inflater_.next_in, inflater_.avail_in};
    out.resize(out.size() - inflater_.avail_out);
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    if (result == Z_STREAM_END) {
      inflateReset(&inflater_);  // gzip files may be concatenated
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      failDamaged(inflater_.msg);
    }
    return result == Z_STREAM_END;
  }

 private:
  z_stream inflater_{};
};

class ZstdDecoder : public Decoder {
 public:
  ZstdDecoder() : stream_(ZSTD_createDStream(), ZSTD_freeDStream) {
    if (!stream_) throw std::bad_alloc();
  }

  bool decode(Chunk& in, std::vector<unsigned char>& out) override {
    ZSTD_inBuffer input{in.next, in.left, 0};
    ZSTD_outBuffer output{out.data(), out.size(), 0};
    const std::size_t result = ZSTD_decompressStream(stream_.get(), &output, &input);
    if (ZSTD_isError(result) != 0) failDamaged(ZSTD_getErrorName(result));
    in = {in.next + input.pos, in.left - input.pos};
    out.resize(output.pos);
    return result == 0;
  }

 private:
  std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream_;
};

std::unique_ptr<Decoder> makeDecoder(Compression compression) {
  if (compression == Compression::gzip) return std::make_unique<GzipDecoder>();
  if (compression == Compression::zstd) return std::make_unique<ZstdDecoder>();
  return nullptr;
}

}  // namespace

bool isCompressed(const std::string& head) {
  return compressionOf(head.data(), head.size()) != Compression::none;
}

/// Content of the file, chunk by chunk.
class GzInputStream::Source {
 public:
  Source(const std::string& path, AtCut at_cut)
      : path_(path), at_cut_(at_cut), file_(path, std::ios::binary) {
    if (!file_) throw FormatError(path_, "", "cannot be opened");
    fillInput();
    if (in_.left == 0) throw FormatError(path_, "", "empty file");
    decoder_ = makeDecoder(compressionOf(reinterpret_cast<const char*>(in_.next), in_.left));
  }

  bool isCompressed() const { return decoder_ != nullptr; }
  const std::string& cut() const { return cut_; }
  std::uint64_t position() const { return position_; }

  /// Makes unread content available; false at the end of it.
  bool fill() {
    while (next_ == output_.size() && !done_) {
      output_.clear();
      next_ = 0;
      decoder_ ? decodeChunk() : copyChunk();
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
  std::string place() const { return "byte " + std::to_string(consumed_ - in_.left); }

  void fillInput() {
    file_.read(reinterpret_cast<char*>(input_.data()), static_cast<std::streamsize>(kChunk));
    if (file_.bad()) throw FormatError(path_, "", "cannot be read");
    in_ = {input_.data(), static_cast<std::size_t>(file_.gcount())};
    consumed_ += in_.left;
  }

  void copyChunk() {
    output_.assign(in_.next, in_.next + in_.left);
    fillInput();
    done_ = in_.left == 0;
  }

  void decodeChunk() {
    if (in_.left == 0) fillInput();
    if (in_.left == 0) {
      if (!between_members_) endTooEarly();
      done_ = true;
      return;
    }
    output_.resize(kChunk);
    try {
      between_members_ = decoder_->decode(in_, output_);
    } catch (const std::runtime_error& error) {
      throw FormatError(path_, place(), error.what());
    }
  }

  void endTooEarly() {
    const std::string reason = "the compressed data is truncated";
    if (at_cut_ == AtCut::refuse || position_ == 0) throw FormatError(path_, place(), reason);
    cut_ = place() + ": " + reason;
  }

  const std::string& path_;
  AtCut at_cut_;
  std::string cut_;
  std::ifstream file_;
  std::unique_ptr<Decoder> decoder_;  ///< null for a plain file
  bool between_members_ = false;
  bool done_ = false;
  std::array<unsigned char, kChunk> input_{};
  Chunk in_;
  std::uint64_t consumed_ = 0;  ///< bytes read from the file
  std::vector<unsigned char> output_;
  std::size_t next_ = 0;
  std::uint64_t position_ = 0;
};

GzInputStream::GzInputStream(const std::string& path, AtCut at_cut) : path_(path) {
  requireRegularFile(path_);
  Source check(path_, at_cut);
  content_bytes_ = std::filesystem::file_size(path_);
  if (check.isCompressed()) {
    while (check.fill()) check.skip(check.unreadCount());
    if (check.position() == 0) throw FormatError(path_, "", "empty file (nothing was compressed)");
    content_bytes_ = check.position();
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
  if (content_bytes_ > kMaxWholeFile) {
    throw FormatError(path_, "",
                      "more than " + std::to_string(kMaxWholeFile >> 20U) + " MiB of content");
  }
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
