#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/ranking/HypothesisParams.h>
#include <mrpt_polyloc/travel/ExpectedReadings.h>
#include <mrpt_polyloc/travel/SafeSet.h>

#include <cstddef>
#include <optional>
#include <string>

namespace mrpt_polyloc {

/// How the next place is chosen among those whose scan is expected to tell hypotheses apart.
enum class TravelStrategy {
  greedy,    ///< most weight told apart per metre
  nearest,   ///< the nearest that tells any two apart (Dudek, Romanik, Whitesides)
  majority,  ///< the nearest in the majority-rule map that tells half of what can be told (in the
             ///< spirit of Koenig, Mitchell, Mudgal and Tovey)
  random     ///< any place within reach: what the others are compared with
};

POLYLOC_EXPORT const char* toString(TravelStrategy strategy);
POLYLOC_EXPORT std::optional<TravelStrategy> travelStrategyFrom(const std::string& name);

struct POLYLOC_EXPORT TravelPlannerParams {
  TravelStrategy strategy = TravelStrategy::greedy;
  SafeSetParams safe;
  ExpectedReadingsParams readings;
  HypothesisParams evidence;  ///< as scans are judged by
  /// Beams of the laser that are looked at: enough for the gaps of doors at some metres.
  std::size_t most_beams = 120;
  /// Maximum range of the laser [m]; 0: that of the scan (see LaserModel::of()).
  double max_range = 0.0;
  std::size_t most_places = 200;  ///< candidates, spread evenly over what is reached
  /// Hypotheses that are compared; those behind the heaviest so many bound only the safe set.
  std::size_t most_hypotheses = 20;
  double least_weight = 1e-3;  ///< a hypothesis below this share is not compared
  /// Two hypotheses count as told apart where PairEvidence::tells() reaches this.
  double least_telling = 0.9;
  /// Metres that a stop with a scan is worth: keeps a near place of little value from being taken
  /// before a far one of much.
  double stop_cost = 0.5;
  /// No stop is farther away than this along the way [m]: hypotheses are held together by scans.
  double longest_leg = 2.0;
  /// Where there is little room (SafeSetParams::comfort) a leg ends after this [m]: wheels must not
  /// go astray between two looks by more than the margin.
  double longest_tight_leg = 0.7;
  /// A robot that would turn by more than this [rad] and then drive far turns and looks first:
  /// wheels lose the heading in turns, and a wrong heading leads into walls.
  double most_turn = 0.5;
  /// Before nothing is said to be told apart, places so far apart are looked at [m].
  double dense_spacing = 0.3;
  std::size_t most_dense_places = 4000;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

}  // namespace mrpt_polyloc
