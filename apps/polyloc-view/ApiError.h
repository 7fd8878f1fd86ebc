#pragma once

#include <stdexcept>
#include <string>

namespace mrpt_polyloc::apps {

/// An answer that is an error: what goes into its JSON.
class ApiError : public std::runtime_error {
 public:
  /// \param status of HTTP \param code a word for programs \param place in the request, as
  /// `options.method`; may be empty
  ApiError(int http_status, std::string error_code, std::string error_place,
           const std::string& message)
      : std::runtime_error(message),
        status(http_status),
        code(std::move(error_code)),
        place(std::move(error_place)) {}

  int status;
  std::string code;
  std::string place;
};

/// A newer request of the same job has come, or the server ends: nobody waits for this answer.
inline ApiError superseded() {
  return {409, "superseded", "", "a newer request of the same job has taken its place"};
}

}  // namespace mrpt_polyloc::apps
