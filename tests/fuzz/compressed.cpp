#include "fuzz_target.h"
#include <mrpt_polyloc/io/GzInputStream.h>

POLYLOC_FUZZ_TARGET(compressed, bytes) {
  const std::string path = inputFile("input", bytes);
  const std::string content = GzInputStream(path, GzInputStream::AtCut::end).readAll();
  must(!content.empty(), "nothing is refused");
  must(isCompressed(bytes) || content == bytes, "what is plain is read as it is");
}
