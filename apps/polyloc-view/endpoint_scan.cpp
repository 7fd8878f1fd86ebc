#include "ApiError.h"
#include "endpoints.h"
#include "search_answer.h"
#include <mrpt_polyloc/io/scan_json.h>

namespace mrpt_polyloc::apps {

const LogSession& requireLog(const Services& services) {
  if (services.log != nullptr) return *services.log;
  throw ApiError(422, "no_log", "", "no log is served: polyloc-view --scans FILE");
}

Json poseJson(const mrpt::math::TPose2D& pose) {
  return {{"x", pose.x}, {"y", pose.y}, {"phi", pose.phi}};
}

Json answerScan(const Services& services, const RequestField& request, Jobs::Ticket& ticket) {
  request.allowOnly({"row", "search", "job"});
  const LogSession& log = requireLog(services);
  const std::size_t row = request.member("row").count(0, log.scans().size() - 1);
  const RangeScan scan = log.scans().scan(row);
  Json json = {{"row", row}, {"scan", toJson(scan)}, {"truth", nullptr}};
  if (const auto truth = log.truth(row)) json["truth"] = poseJson(*truth);
  const auto search_field = request.find("search");
  if (!search_field) return json;
  search_field->allowOnly({"prior", "options"});
  json["result"] = searchAnswer(services, ScanSet(scan), readSearch(*search_field), ticket);
  return json;
}

}  // namespace mrpt_polyloc::apps
