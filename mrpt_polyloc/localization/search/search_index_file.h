#pragma once

#include <mrpt_polyloc/localization/search/SearchTree.h>
#include <mrpt_polyloc/visibility/VisibleEdgeIndex.h>

#include <cstdint>
#include <istream>
#include <ostream>
#include <string>

namespace mrpt_polyloc {

/// What the certified search prepares for a map.
struct SearchIndex {
  VisibleEdgeIndex::Lists edges;
  SearchTree::Data tree;
};

/// Writes the index: magic, version, hash of the map, hash of the layout of its walls, the arrays
/// with their sizes, and a checksum over all before it. Little-endian. Whether that went well the
/// stream says.
void writeIndex(std::ostream& out, const VisibleEdgeIndex::Lists& edges,
                const SearchTree::Data& tree, std::uint64_t map_hash);

/// Reads it, array by array: nothing is held twice, and no more memory is taken than the stream
/// fills. \param file its name, for messages \param map_hash PolygonMap::hash()
/// \throws FormatError naming the file and the byte: not an index, another version, of another map,
/// cut short, too long, or damaged
SearchIndex readIndex(std::istream& in, const std::string& file, std::uint64_t map_hash);

}  // namespace mrpt_polyloc
