#pragma once

#include <mrpt_polyloc/base/notes.h>
#include <mrpt_polyloc/io/ScanLog.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>

#include <mrpt/math/TPose2D.h>

#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// The log that is looked through, with its truth if there is one.
class LogSession {
 public:
  /// \param truth a TUM file; empty: none
  /// \throws FormatError as ScanLog, loadTum() and matchTruth()
  LogSession(const std::string& path, const ScanFileOptions& options, const std::string& truth,
             Notes* notes);

  const ScanLog& scans() const { return scans_; }
  bool hasTruth() const { return !truth_.empty(); }
  std::optional<mrpt::math::TPose2D> truth(std::size_t row) const;

  /// What an answer came to: with a truth `right`, `wrong` or, if it is none, its status; without
  /// one its status.
  std::string outcome(std::size_t row, const LocalizationResult& result) const;
  /// Whether such an outcome is one to look at: not `right`, or, without a truth, not `unique`.
  bool isMiss(const std::string& outcome) const;

 private:
  ScanLog scans_;
  std::vector<mrpt::math::TPose2D> truth_;  ///< of each row
};

}  // namespace mrpt_polyloc::apps
