#include "ApiError.h"
#include "endpoints.h"
#include "search_answer.h"

namespace mrpt_polyloc::apps {

Json answerLocalize(const Services& services, const RequestField& request, Jobs::Ticket& ticket) {
  request.allowOnly({"ranges", "start_angle", "angle_step", "max_range", "min_range", "bearings",
                     "kinds", "sensor", "stamp", "label", "scans", "odometry", "polygon", "prior",
                     "options", "job"});
  const SearchRequest search = readSearch(request);
  if (request.has("polygon")) {
    if (search.method != Method::exact) {
      throw ApiError(400, "bad_request", "options.method",
                     "options.method: a polygon is searched for by the method exact alone");
    }
    const auto view = readPoints(request.member("polygon"), kMostPolygonVertices);
    ticket.enter();
    return searchAnswer(services, view, search);
  }
  if (request.has("scans")) return searchAnswer(services, readScanSet(request), search, ticket);
  return searchAnswer(services, ScanSet(readScan(request)), search, ticket);
}

}  // namespace mrpt_polyloc::apps
