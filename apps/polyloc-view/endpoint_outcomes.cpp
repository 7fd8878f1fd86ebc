#include "endpoints.h"
#include <mrpt_polyloc/base/Stopwatch.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace mrpt_polyloc::apps {
namespace {

constexpr double kSeconds = 0.5;  ///< then what is known is told, so that others get their turn

}  // namespace

Json answerOutcomes(const Services& services, const RequestField& request, Jobs::Ticket& ticket) {
  request.allowOnly({"first", "count", "stop_at_miss", "search", "job"});
  const LogSession& log = requireLog(services);
  const std::size_t rows = log.scans().size();
  const std::size_t first = request.member("first").count(0, rows - 1);
  const std::size_t count = request.member("count").count(1, 1'000'000);
  const auto stop_field = request.find("stop_at_miss");
  const bool stops = stop_field && stop_field->boolean();
  SearchRequest search;
  if (const auto field = request.find("search")) {
    field->allowOnly({"prior", "options"});
    search = readSearch(*field);
  }
  services.session.index(ticket.cancelled());
  ticket.enter();

  const Stopwatch watch;
  Json outcomes = Json::array(), miss = nullptr;
  const std::size_t last = std::min(rows, first + count);
  std::size_t row = first;
  while (row < last && miss.is_null() && (row == first || watch.seconds() < kSeconds)) {
    const LocalizationResult result =
        services.session.localize(ScanSet(log.scans().scan(row)), search, ticket.cancelled());
    ticket.check();
    const std::string outcome = log.outcome(row, result);
    Json one = {{"row", row}, {"outcome", outcome}, {"pose", nullptr}};
    if (!result.hypotheses.empty()) {
      one["pose"] = poseJson(result.hypotheses.front().pose_map_robot);
    }
    outcomes.push_back(std::move(one));
    if (stops && log.isMiss(outcome)) miss = row;
    ++row;
  }
  return {{"outcomes", std::move(outcomes)},
          {"next", row < rows ? Json(row) : Json(nullptr)},
          {"miss", std::move(miss)}};
}

}  // namespace mrpt_polyloc::apps
