#include "search_answer.h"

#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/io/result_json.h>

namespace mrpt_polyloc::apps {
namespace {

Json finished(const Services& services, const LocalizationResult& result, const Stopwatch& watch) {
  Json json = toJson(result);
  json["map_hash"] = hashText(services.session.hash());
  json["ms"] = 1e3 * watch.seconds();
  return json;
}

}  // namespace

Json searchAnswer(const Services& services, const ScanSet& scans, const SearchRequest& search,
                  Jobs::Ticket& ticket) {
  services.session.index(ticket.cancelled());
  ticket.enter();
  const Stopwatch watch;
  const LocalizationResult result = services.session.localize(scans, search, ticket.cancelled());
  ticket.check();
  return finished(services, result, watch);
}

Json searchAnswer(const Services& services, const std::vector<TPoint2D>& view,
                  const SearchRequest& search) {
  const Stopwatch watch;
  return finished(services, services.session.localizeExact(view, search), watch);
}

}  // namespace mrpt_polyloc::apps
