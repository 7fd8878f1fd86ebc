#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/GuardedStream.h>
#include <mrpt_polyloc/io/mrpt_archive.h>

#include <mrpt/serialization/CArchive.h>

#include <new>

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

void readObjects(
    const std::string& path, bool strict, Notes* notes,
    const std::function<void(const mrpt::serialization::CSerializable::Ptr&, std::size_t)>& take) {
  using AtCut = GzInputStream::AtCut;
  GzInputStream stream(path, strict ? AtCut::refuse : AtCut::end);
  std::string cut = stream.cut();
  std::size_t index = 0;
  while (!stream.atEnd()) {
    mrpt::serialization::CSerializable::Ptr object;
    try {
      object = readObject(stream, index);
    } catch (const FormatError&) {
      if (strict || index == 0 || !stream.atEnd()) throw;
      if (cut.empty()) cut = "object " + std::to_string(index) + ": the file ends inside it";
      break;
    }
    take(object, index++);
  }
  if (cut.empty()) return;
  addNote(notes, "it is cut short (" + cut + "): the " + std::to_string(index) +
                     " objects before that are used (--strict refuses it)");
}

mrpt::serialization::CSerializable::Ptr readObject(GzInputStream& stream, std::size_t index) {
  const std::string place = "object " + std::to_string(index);
  if (stream.atEnd()) throw FormatError(stream.path(), place, "the file ends before it");
  GuardedStream guarded(stream);
  auto archive = mrpt::serialization::archiveFrom<mrpt::io::CStream>(guarded);
  try {
    return archive.ReadObject();
  } catch (const FormatError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw FormatError(stream.path(), place, "asks for more memory than there is: damaged");
  } catch (const std::exception& error) {
    if (!guarded.refusal().empty()) throw FormatError(stream.path(), place, guarded.refusal());
    if (stream.atEnd()) throw FormatError(stream.path(), place, "the file ends inside it");
    throw FormatError(stream.path(), place, "not a readable MRPT object: " + plainMessage(error));
  }
}

}  // namespace mrpt_polyloc
