#pragma once

#include <mrpt_polyloc/base/export.h>

#include <cstddef>
#include <deque>

namespace mrpt_polyloc {

struct POLYLOC_EXPORT FilterMonitorParams {
  /// Healthy steps before the range counts as known; until then nothing is called lost.
  std::size_t least_steps = 10;
  std::size_t window = 100;  ///< healthy steps remembered: places differ, so the range follows
  /// A step is bad if its fit lies more than so many standard deviations below the median of the
  /// window. The usual 3: what it costs to be wrong is a search, see FilterRecovery.
  double deviations = 3.0;
  /// Least standard deviation assumed [log-likelihood per beam]: a robot that stands still repeats
  /// its fit almost exactly, and drives on into places that are mapped less well. Tuned, like the
  /// two numbers above and below, on fits as of filterFit() in four rawlogs (doc/mrpt.md).
  double least_deviation = 0.2;
  /// So many bad steps in a row mean lost; fewer are a passer-by.
  std::size_t patience = 3;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

enum class FilterHealth { learning, healthy, doubtful, lost };

/// Tells from the fit of each scan at the filter's estimate, its mean log-likelihood per beam,
/// whether the filter has lost the robot.
///
/// The range of healthy fits is measured on the filter's own healthy steps, so that it holds for
/// any map class, sensor and likelihood option: the median of the last ones, and 1.4826 times their
/// median absolute deviation (the standard deviation, were they normal; Rousseeuw and Croux 1993).
/// So a filter that starts wrong and stays wrong is *not* noticed: start it where a search says.
class POLYLOC_EXPORT FilterMonitor {
 public:
  /// \throws InvalidParamsError
  explicit FilterMonitor(const FilterMonitorParams& params = {});

  /// Takes the fit of the next step; one that is not finite counts as bad. O(window).
  FilterHealth update(double log_likelihood_per_beam);

  /// After a recovery: forgets the bad steps in a row, keeps the range.
  void recovered() { bad_steps_ = 0; }

  /// Below this a step is bad; -infinity while learning.
  double threshold() const;

 private:
  FilterMonitorParams params_;
  std::deque<double> healthy_;
  std::size_t bad_steps_ = 0;
};

}  // namespace mrpt_polyloc
