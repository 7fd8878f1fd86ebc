#pragma once

#include <mrpt_polyloc/base/export.h>

#include <mrpt/io/CStream.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace mrpt_polyloc {

/// Whether a file that begins so is compressed by gzip or zstd.
POLYLOC_EXPORT bool isCompressed(const std::string& head);

/// A file to read, compressed by gzip or zstd or plain (told by its first bytes, whatever its
/// name), as a stream for MRPT's archives and for lines of text.
///
/// MRPT's own CFileGZInputStream takes a truncated or damaged gzip file for one that ends early, so
/// half a file passes for a whole one. Here a compressed file is decompressed once at construction
/// to check that it is complete and its checksums are right (zstd may have none), before anything
/// is made of its content: a damaged length could make a parser allocate at random.
///
/// Files that end too early are refused, or read up to there (AtCut): what comes before a cut is
/// right, unlike what comes after damage.
class POLYLOC_EXPORT GzInputStream : public mrpt::io::CStream {
 public:
  /// What to do where a compressed file ends too early.
  enum class AtCut { refuse, end };

  /// \throws FormatError if the file does not exist, is not a regular file, cannot be read, is
  /// empty, or is a compressed file that is damaged or followed by something else, or truncated:
  /// with AtCut::end only if no content comes before the cut. The place is a byte of the file.
  explicit GzInputStream(const std::string& path, AtCut at_cut = AtCut::refuse);
  ~GzInputStream() override;
  GzInputStream(const GzInputStream&) = delete;
  GzInputStream& operator=(const GzInputStream&) = delete;

  const std::string& path() const { return path_; }

  /// Whether all of the content has been read.
  bool atEnd();
  /// Where and why the content ends too early, as "byte N: the compressed data is truncated"; empty
  /// if it does not. Known from construction on.
  const std::string& cut() const { return cut_; }
  /// Whether the line that was read last had its end, "\n".
  bool lineHadEnd() const { return line_had_end_; }
  /// The next line without its end ("\n" or "\r\n"); false at the end of the file.
  bool readLine(std::string& line);
  /// All of the content from here on.
  /// \throws FormatError before anything is read, if the content is more than kMaxWholeFile
  std::string readAll();

  /// Reads `count` bytes, fewer only at the end of the file.
  std::size_t Read(void* buffer, std::size_t count) override;
  /// Throws std::logic_error: the stream is read only.
  std::size_t Write(const void* buffer, std::size_t count) override;
  /// Throws std::logic_error: the stream is read from beginning to end.
  std::uint64_t Seek(std::int64_t offset, CStream::TSeekOrigin origin) override;
  /// Size of the file on the disk [bytes].
  std::uint64_t getTotalBytesCount() const override;
  /// Bytes of content (decompressed) read so far.
  std::uint64_t getPosition() const override;

 private:
  class Source;

  std::string path_;
  std::string cut_;
  std::uint64_t content_bytes_ = 0;  ///< decompressed
  bool line_had_end_ = false;
  std::unique_ptr<Source> source_;
};

}  // namespace mrpt_polyloc
