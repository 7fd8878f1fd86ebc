#pragma once

#include "DriveStore.h"
#include "Jobs.h"
#include "LogSession.h"
#include "MapSession.h"
#include "RequestField.h"

#include <nlohmann/json_fwd.hpp>

/// The answers of the API, a file each; README.md says what they hold. Each throws ApiError, or
/// what the library throws of bad parameters.
namespace mrpt_polyloc::apps {

/// The version in the paths and in `health`.
constexpr int kApiVersion = 1;

struct Services {
  const MapSession& session;
  DriveStore& drives;
  const LogSession* log = nullptr;  ///< if one is looked through
};

using Json = nlohmann::ordered_json;

/// What is served, and whether the index is ready.
Json answerHealth(const Services& services);

/// The map's lines, simplified by a tolerance [m].
Json answerMap(const Services& services, double tolerance);

/// The visibility cells and the critical segments of the whole map.
Json answerCells(const Services& services, Jobs::Ticket& ticket);

/// A scan, or a polygon that is seen without noise, to all its poses.
Json answerLocalize(const Services& services, const RequestField& request, Jobs::Ticket& ticket);

/// A scan from a pose in the map, and, if asked for, all poses that explain it.
Json answerSimulate(const Services& services, const RequestField& request, Jobs::Ticket& ticket);

/// A scan held against the map at a pose.
Json answerCompare(const Services& services, const RequestField& request, Jobs::Ticket& ticket);

/// The visibility polygon and the skeleton at a point.
Json answerView(const Services& services, const RequestField& request, Jobs::Ticket& ticket);

/// The leaf of the search at a point, with its bands.
Json answerLeaf(const Services& services, const RequestField& request, Jobs::Ticket& ticket);

/// The log that is looked through: how many scans, and the way of its truth.
Json answerLog(const Services& services);

/// A scan of the log, and, if asked for, all poses that explain it.
Json answerScan(const Services& services, const RequestField& request, Jobs::Ticket& ticket);

/// What the answers to many scans of the log came to, for half a second's worth of them at most.
Json answerOutcomes(const Services& services, const RequestField& request, Jobs::Ticket& ticket);

/// A simulated robot that drives until it knows where it is, a step of it.
Json answerTravel(const Services& services, const RequestField& request, Jobs::Ticket& ticket);

/// Where a real robot is to drive next, from what it has seen.
Json answerPlan(const Services& services, const RequestField& request, Jobs::Ticket& ticket);

/// \throws ApiError if there is none
const LogSession& requireLog(const Services& services);

/// {x, y, phi}
Json poseJson(const mrpt::math::TPose2D& pose);

}  // namespace mrpt_polyloc::apps
