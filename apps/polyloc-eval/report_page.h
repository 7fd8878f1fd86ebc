#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace mrpt_polyloc::apps {

/// The report as one page that needs no other file and no network: report.html beside this file,
/// with the data in it. The same data, the same page.
std::string reportPage(const nlohmann::ordered_json& data);

}  // namespace mrpt_polyloc::apps
