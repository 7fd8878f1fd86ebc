#pragma once

#include <mrpt_polyloc/base/errors.h>

#include <string>

namespace mrpt_polyloc::test {

/// What the check of the parameters complains about, "" if nothing.
template <class Params>
std::string complaintOf(const Params& params) {
  try {
    params.check();
  } catch (const InvalidParamsError& error) {
    return error.what();
  }
  return "";
}

}  // namespace mrpt_polyloc::test
