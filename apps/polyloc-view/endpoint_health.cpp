#include "endpoints.h"
#include <mrpt_polyloc/io/result_json.h>
#include <mrpt_polyloc/version.h>

namespace mrpt_polyloc::apps {

Json answerHealth(const Services& services) {
  const MapSession::IndexState state = services.session.indexState();
  Json json = {{"api", kApiVersion},
               {"version", kVersion},
               {"state", state.is_ready        ? "ready"
                         : state.error.empty() ? "indexing"
                                               : "failed"},
               {"progress", state.progress},
               {"map", services.session.name()},
               {"map_hash", hashText(services.session.hash())}};
  if (!state.error.empty()) json["error"] = state.error;
  return json;
}

}  // namespace mrpt_polyloc::apps
