#pragma once

#include <mrpt_polyloc/localization/search/SearchTree.h>
#include <mrpt_polyloc/visibility/VisibleEdgeIndex.h>

#include <cstdint>
#include <string>

namespace mrpt_polyloc {

/// What the certified search prepares for a map.
struct SearchIndex {
  VisibleEdgeIndex::Lists edges;
  SearchTree::Data tree;
};

/// The index as the content of a file: magic, version, hash of the map, the arrays with their
/// sizes, and a checksum over all before it. Little-endian.
std::string serializeIndex(const VisibleEdgeIndex::Lists& edges, const SearchTree::Data& tree,
                           std::uint64_t map_hash);

/// \param file its name, for messages \param map_hash PolygonMap::hash()
/// \throws FormatError naming the file and the byte: not an index, another version, of another map,
/// cut short, too long, or damaged
SearchIndex parseIndex(const std::string& content, const std::string& file, std::uint64_t map_hash);

}  // namespace mrpt_polyloc
