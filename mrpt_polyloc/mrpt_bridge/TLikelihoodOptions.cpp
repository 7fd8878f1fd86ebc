#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/mrpt_bridge/IniSection.h>
#include <mrpt_polyloc/mrpt_bridge/TLikelihoodOptions.h>

#include <mrpt/config/CConfigFileBase.h>

#include <ostream>

namespace mrpt_polyloc {

void TLikelihoodOptions::check() const {
  if (metric != "robust" && metric != "polar") {
    throw InvalidParamsError("metric is '" + metric + "', not 'robust' or 'polar'");
  }
  requirePositive("sigma", sigma);
  requirePositive("independent_beams", independent_beams);
  requireInRange("decimation", decimation, 1.0, 1e6);
  cost.check();
}

void TLikelihoodOptions::loadFromConfigFile(const mrpt::config::CConfigFileBase& source,
                                            const std::string& section) {
  const IniSection ini(source, section,
                       {"metric", "sigma", "decimation", "independent_beams", "tau_short",
                        "tau_long", "tau_open", "tau_none", "none_share"});
  metric = ini.text("metric", metric);
  const auto read = [&](const char* name, double& value) { value = ini.number(name, value); };
  decimation = static_cast<unsigned>(ini.number("decimation", decimation, 1.0, 1e6));
  read("sigma", sigma);
  read("independent_beams", independent_beams);
  read("tau_short", cost.tau_short);
  read("tau_long", cost.tau_long);
  read("tau_open", cost.tau_open);
  read("tau_none", cost.tau_none);
  read("none_share", cost.none_share);
  namingSection(section, [this] { check(); });
}

void TLikelihoodOptions::dumpToTextStream(std::ostream& out) const {
  out << "metric = " << metric
      << formatted(
             "\nsigma = %g\ndecimation = %u\nindependent_beams = %g\ntau_short = %g\ntau_long = %g"
             "\ntau_open = %g\ntau_none = %g\nnone_share = %g\n",
             sigma, decimation, independent_beams, cost.tau_short, cost.tau_long, cost.tau_open,
             cost.tau_none, cost.none_share);
}

}  // namespace mrpt_polyloc
