#include "ApiError.h"
#include "endpoint_json.h"
#include "endpoints.h"
#include <mrpt_polyloc/localization/inspection/leaf_bands.h>

namespace mrpt_polyloc::apps {

Json answerLeaf(const Services& services, const RequestField& request, Jobs::Ticket& ticket) {
  request.allowOnly({"x", "y", "job"});
  const TPoint2D point = readPoint(request);
  const MapIndex::Ptr index = services.session.index(ticket.cancelled());
  ticket.enter();
  const auto leaf = leafBandsAt(*index, point);
  if (!leaf) throw ApiError(422, "not_free", "", "no leaf of the search holds this point");
  Json near = Json::array(), wall = Json::array(), gaps = Json::array();
  for (const LeafBands::Bin& bin : leaf->bins) {
    near.push_back(bin.near);
    wall.push_back(finiteOrNull(bin.wall));
    if (bin.gap_high > bin.gap_low) {
      gaps.push_back({bin.gap_low, bin.gap_high});
    } else {
      gaps.push_back(nullptr);
    }
  }
  return {{"leaf", leaf->leaf},       {"polygon", flatPoints(leaf->polygon)},
          {"bin_width", leaf->width}, {"bins_a_window", 2},
          {"near", std::move(near)},  {"wall", std::move(wall)},
          {"gaps", std::move(gaps)}};
}

}  // namespace mrpt_polyloc::apps
