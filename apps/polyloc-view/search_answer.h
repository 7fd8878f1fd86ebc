#pragma once

#include "endpoints.h"

#include <nlohmann/json.hpp>

namespace mrpt_polyloc::apps {

/// A search and its answer: toJson(LocalizationResult) with map_hash and ms. Waits for the index
/// and for its turn, which `ms` leaves out.
Json searchAnswer(const Services& services, const ScanSet& scans, const SearchRequest& search,
                  Jobs::Ticket& ticket);

/// The same of a polygon that is seen without noise, in the robot's frame [m].
Json searchAnswer(const Services& services, const std::vector<TPoint2D>& view,
                  const SearchRequest& search);

}  // namespace mrpt_polyloc::apps
