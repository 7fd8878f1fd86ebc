#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/mrpt_archive.h>

#include <mrpt/serialization/CArchive.h>

namespace mrpt_polyloc {

std::string plainMessage(const std::exception& error) {
  const std::string what = error.what();
  const std::string head = "Message:";
  const auto start = what.find(head);
  std::string message = start == std::string::npos ? what : what.substr(start + head.size());
  message = message.substr(0, message.find("Location:"));
  std::string line;
  for (const char c : message) {
    // A damaged class name is quoted in the message, and may hold anything.
    const auto byte = static_cast<unsigned char>(c);
    const bool printable = byte > 0x20 && byte < 0x7f;
    if (printable) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  if (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

mrpt::serialization::CSerializable::Ptr readObject(GzInputStream& stream, std::size_t index) {
  const std::string place = "object " + std::to_string(index);
  if (stream.atEnd()) throw FormatError(stream.path(), place, "the file ends before it");
  auto archive = mrpt::serialization::archiveFrom<mrpt::io::CStream>(stream);
  try {
    return archive.ReadObject();
  } catch (const FormatError&) {
    throw;
  } catch (const std::exception& error) {
    if (stream.atEnd()) throw FormatError(stream.path(), place, "the file ends inside it");
    throw FormatError(stream.path(), place, "not a readable MRPT object: " + plainMessage(error));
  }
}

}  // namespace mrpt_polyloc
